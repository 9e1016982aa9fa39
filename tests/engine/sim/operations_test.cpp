#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/sim/world.h"

using namespace stampede;

namespace {

JointVector random_joints(Random& random) {
  JointVector q(7);
  for (Eigen::Index i = 0; i < 7; ++i) q[i] = random.normal();
  return q;
}

std::string round_trip(const Operation& operation) {
  const std::string bytes = operation_to_bytes(operation);
  return operation_to_bytes(operation_from_bytes(operation_kind(operation), bytes));
}

}  // namespace

TEST_CASE("every operation returns from its bytes with the same bits", "[sim]") {
  Random random(RandomKey("operations"));
  operation::Follow follow;
  for (int i = 0; i < 5; ++i)
    follow.trajectory.knots.push_back({i * 100, random_joints(random), random_joints(random), random_joints(random)});
  operation::Place place{3, Transform::Identity()};
  place.world_from_body = Eigen::AngleAxisd(0.7, Vector3(1, 2, 3).normalized());
  place.world_from_body.translation() = Vector3(0.1, -0.2, 1.0 / 3);
  const std::vector<Operation> all{operation::Boundary{},
                                   operation::Controller{ControllerKind::cartesian_impedance, 1.0 / 3},
                                   follow,
                                   operation::Hand{0.1 / 3, 17},
                                   operation::Setpoint{random_joints(random), random_joints(random)},
                                   place,
                                   operation::Servo{operation::Servo::Of::torque, random_joints(random)}};
  CHECK(all.size() == std::variant_size_v<Operation>);
  for (const Operation& operation : all) {
    CAPTURE(operation_kind(operation));
    const std::string bytes = operation_to_bytes(operation);
    CHECK(round_trip(operation) == bytes);
    for (std::size_t length = 0; length < bytes.size(); length += 7)
      CHECK_THROWS_AS(operation_from_bytes(operation_kind(operation), bytes.substr(0, length)), Error);
    CHECK_THROWS_AS(operation_from_bytes(operation_kind(operation), bytes + "x"), Error);
  }
  const auto read = std::get<operation::Place>(operation_from_bytes("place", operation_to_bytes(place)));
  CHECK(read.world_from_body.matrix() == place.world_from_body.matrix());
  CHECK_THROWS_AS(operation_from_bytes("teleport", std::string(1, '\1')), Error);
  CHECK_THROWS_AS(operation_from_bytes("boundary", std::string(1, '\2')), Error);  // another version
}

TEST_CASE("numbers are little-endian behind one byte of version", "[sim]") {
  const std::string bytes = operation_to_bytes(operation::Hand{1.0, 2.0});
  CHECK(bytes == std::string("\1\0\0\0\0\0\0\xf0\x3f\0\0\0\0\0\0\0\x40", 17));
}

TEST_CASE("controllers are named", "[sim]") {
  for (const auto kind :
       {ControllerKind::joint_position, ControllerKind::joint_impedance, ControllerKind::cartesian_impedance})
    CHECK(controller_from(to_string(kind)) == kind);
  CHECK_FALSE(controller_from("magic"));
}
