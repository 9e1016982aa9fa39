#include "engine/model/kinematics.h"

#include <Eigen/LU>
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/base/error.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

constexpr double pi = std::numbers::pi;

JointVector joints(std::initializer_list<double> values) {
  JointVector q(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), q.data());
  return q;
}

JointVector any_joints(const Arm& arm, Random& random) {
  JointVector q(arm.joints());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = random.between(arm.limits()[static_cast<std::size_t>(i)].lower,
                          arm.limits()[static_cast<std::size_t>(i)].upper);
  return q;
}

// The same arm by its modified Denavit-Hartenberg table: Rx(alpha) Tx(a) Rz(theta) Tz(d).
Transform flange_by_denavit_hartenberg(const JointVector& q) {
  constexpr double table[7][3] = {{0, 0.333, 0},       {0, 0, -pi / 2},           {0, 0.316, pi / 2},
                                  {0.0825, 0, pi / 2}, {-0.0825, 0.384, -pi / 2}, {0, 0, pi / 2},
                                  {0.088, 0, pi / 2}};
  Transform result = Transform::Identity();
  for (int i = 0; i < 7; ++i)
    result = result * rotation_rpy(table[i][2], 0, 0) * translation(table[i][0], 0, 0) * rotation_rpy(0, 0, q[i]) *
             translation(0, 0, table[i][1]);
  return result * translation(0, 0, 0.107);
}

Transform flange_from_tip() { return rotation_rpy(0, 0, -pi / 4) * translation(0, 0, 0.1034); }

}  // namespace

TEST_CASE("the Panda stands where its maker's check values say") {
  const Arm arm(panda_robot());
  const Transform zero = arm.base_from_tip(joints({0, 0, 0, 0, 0, 0, 0})) * flange_from_tip().inverse();
  CHECK((zero.translation() - Vector3(0.088, 0, 0.926)).norm() < 1e-9);
  const Transform ready = arm.base_from_tip(arm.home());
  CHECK((ready.translation() - Vector3(0.30689, 0, 0.48688)).norm() < 1e-5);  // published with five decimals
  CHECK((ready.linear() - Matrix3(Vector3(1, -1, -1).asDiagonal())).norm() < 1e-9);
}

TEST_CASE("forward kinematics agrees with the Denavit-Hartenberg table") {
  const Arm arm(panda_robot());
  Random random(RandomKey("dh"));
  for (int k = 0; k < 100; ++k) {
    const JointVector q = any_joints(arm, random);
    const Transform expected = flange_by_denavit_hartenberg(q) * flange_from_tip();
    REQUIRE((arm.base_from_tip(q).matrix() - expected.matrix()).cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("all parts and the tip agree, wherever the base stands") {
  const Robot robot = panda_robot(make_transform({0.3, -0.2, 0.75}, Quaternion(0.8, 0, 0, 0.6)));
  const Arm arm(robot);
  Random random(RandomKey("parts"));
  const JointVector q = any_joints(arm, random);
  std::vector<double> positions(robot.body.parts.size(), 0.0);
  for (std::size_t i = 0; i < 7; ++i)
    positions[static_cast<std::size_t>(robot.arm[i])] = q[static_cast<Eigen::Index>(i)];
  positions[static_cast<std::size_t>(robot.fingers[0])] = positions[static_cast<std::size_t>(robot.fingers[1])] = 0.03;
  std::vector<Transform> world;
  forward_kinematics(robot.body, robot.body.world_from_body, positions, world);
  const auto at = [&](int part) { return world[static_cast<std::size_t>(part)]; };
  const Transform tip = at(robot.tip_part) * robot.tip_part_from_tip;
  CHECK((tip.matrix() - arm.world_from_tip(q).matrix()).cwiseAbs().maxCoeff() < 1e-12);
  // Both fingers open by 3 cm along the tip's y: they are 6 cm apart, left in front.
  const Vector3 gap = at(robot.fingers[0]).translation() - at(robot.fingers[1]).translation();
  CHECK((tip.linear().transpose() * gap - Vector3(0, 0.06, 0)).norm() < 1e-12);
}

TEST_CASE("the Jacobian is the derivative of the tip") {
  const Arm arm(panda_robot(make_transform({0.1, 0.2, 0.3}, Quaternion(0.8, 0, 0.6, 0))));
  Random random(RandomKey("jacobian"));
  constexpr double h = 1e-6;
  for (int k = 0; k < 20; ++k) {
    const JointVector q = any_joints(arm, random);
    const auto jacobian = arm.jacobian(q);
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      JointVector high = q, low = q;
      high[i] += h;
      low[i] -= h;
      const Transform a = arm.world_from_tip(low), b = arm.world_from_tip(high);
      const Vector3 linear = (b.translation() - a.translation()) / (2 * h);
      const Eigen::AngleAxisd turn(Matrix3(b.linear() * a.linear().transpose()));
      REQUIRE((jacobian.col(i).head<3>() - linear).norm() < 1e-8);
      REQUIRE((jacobian.col(i).tail<3>() - turn.angle() / (2 * h) * turn.axis()).norm() < 1e-7);
    }
  }
}

TEST_CASE("the greatest speed of an arm is that of its tip, of an elbow, or of a link that turns on the spot") {
  const Arm arm(panda_robot());
  const JointVector q = arm.home();
  const auto speed = [&](std::initializer_list<double> velocity, double around) {
    return arm.greatest_speed(q, joints(velocity), around);
  };
  CHECK(speed({0, 0, 0, 0, 0, 0, 0}, 0.1) == 0);
  CHECK(speed({0, 0, 0, 0, 0, 0, 2}, 0.1) == Approx(0.2));  // the tip lies on the last axis
  CHECK(speed({0, 0, 0, 0, 0, 0, 2}, 0) == Approx(0).margin(1e-12));
  const JointVector turn = joints({1, 0, 0, 0, 0, 0, 0});
  CHECK(arm.greatest_speed(q, turn, 0) == Approx((arm.jacobian(q).topRows<3>() * turn).norm()));
  // The tip stands while the elbow goes: what seven joints can.
  const Eigen::MatrixXd jacobian = arm.jacobian(q);
  const Eigen::MatrixXd still = Eigen::FullPivLU<Eigen::MatrixXd>(jacobian).kernel();
  const JointVector aside = still.col(0).normalized();
  CHECK((jacobian * aside).norm() < 1e-9);
  CHECK(arm.greatest_speed(q, aside, 0) > 0.05);
}

TEST_CASE("limits include their ends, shrink by the margin, and refuse what is not a number") {
  const Arm arm(panda_robot());
  JointVector q = arm.home();
  q[3] = -0.0698;
  CHECK(arm.within_limits(q));
  CHECK_FALSE(arm.within_limits(q, 1e-3));
  q[3] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(arm.within_limits(q));
}

TEST_CASE("an arm that makes no chain is an error") {
  Robot robot = panda_robot();
  std::swap(robot.arm[0], robot.arm[1]);
  CHECK_THROWS_AS(Arm(robot), Error);
  robot = panda_robot();
  robot.home.pop_back();
  CHECK_THROWS_AS(Arm(robot), Error);
  robot = panda_robot();
  robot.tip_part = robot.arm[2];
  CHECK_THROWS_AS(Arm(robot), Error);
}
