#include "tests/support/panda.h"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <numbers>

#include "engine/model/kinematics.h"

using namespace stampede;

namespace {

bool inside(const Shape& shape, const Vector3& p) {
  switch (shape.kind) {
    case ShapeKind::box:
      return (p.cwiseAbs() - shape.size / 2).maxCoeff() <= 0;
    case ShapeKind::sphere:
      return p.norm() <= shape.radius;
    case ShapeKind::cylinder:
      return p.head<2>().norm() <= shape.radius && std::abs(p.z()) <= shape.length / 2;
    default:
      throw std::logic_error("the Panda has boxes, spheres and cylinders only");
  }
}

// Points through the whole solid, about 5 mm apart, its surface included.
std::vector<Vector3> filled(const Shape& shape) {
  const Vector3 half =
      shape.kind == ShapeKind::box ? Vector3(shape.size / 2) : Vector3(shape.radius, shape.radius, shape.length / 2);
  const Eigen::Vector3i steps = (half / 0.0025).array().ceil().cast<int>();
  std::vector<Vector3> points;
  for (int x = 0; x <= steps.x(); ++x)
    for (int y = 0; y <= steps.y(); ++y)
      for (int z = 0; z <= steps.z(); ++z) {
        const Vector3 unit(2.0 * x / steps.x() - 1, 2.0 * y / steps.y() - 1, 2.0 * z / steps.z() - 1);
        if (inside(shape, half.cwiseProduct(unit))) points.push_back(half.cwiseProduct(unit));
      }
  return points;
}

bool overlap(const Part& a, const Transform& world_from_a, const Part& b, const Transform& world_from_b) {
  for (const Shape& sa : a.shapes)
    for (const Shape& sb : b.shapes) {
      if (!sa.collides || !sb.collides) continue;
      const Transform b_from_a = (world_from_b * sb.part_from_shape).inverse() * world_from_a * sa.part_from_shape;
      for (const Vector3& point : filled(sa))
        if (inside(sb, b_from_a * point)) return true;
    }
  return false;
}

std::vector<Transform> poses(const Robot& robot, const std::vector<double>& q) {
  std::vector<double> positions(robot.body.parts.size(), 0.0);
  for (std::size_t i = 0; i < q.size(); ++i) positions[static_cast<std::size_t>(robot.arm[i])] = q[i];
  for (const int finger : robot.fingers) positions[static_cast<std::size_t>(finger)] = 0.04;
  std::vector<Transform> world;
  forward_kinematics(robot.body, robot.body.world_from_body, positions, world);
  return world;
}

int touching_pairs(const Robot& robot, const std::vector<double>& q) {
  const std::vector<Transform> world = poses(robot, q);
  int touching = 0;
  for (const auto& [a, b] : robot.checked_pairs) {
    const auto ia = static_cast<std::size_t>(a), ib = static_cast<std::size_t>(b);
    if (overlap(robot.body.parts[ia], world[ia], robot.body.parts[ib], world[ib])) {
      UNSCOPED_INFO(robot.body.parts[ia].name << " touches " << robot.body.parts[ib].name);
      ++touching;
    }
  }
  return touching;
}

}  // namespace

TEST_CASE("the Panda's file holds the published masses and limits") {
  const Robot robot = panda_robot();
  double moving = 0;
  for (const int part : robot.arm) moving += robot.body.parts[static_cast<std::size_t>(part)].mass;
  CHECK(moving == Approx(13.78593).epsilon(1e-9));
  CHECK(robot.body.parts[0].mass == 2.3966);
  CHECK(robot.body.parts.size() == 12);
  CHECK(robot.limits[3].lower == -3.0718);
  CHECK(robot.limits[4].velocity == 2.61);
  CHECK(robot.limits[0].effort == 87);
  for (const Part& part : robot.body.parts) {
    if (part.mass == 0) continue;
    const Vector3 moments = part.inertia.selfadjointView<Eigen::Lower>().eigenvalues();
    INFO(part.name);
    CHECK(moments.minCoeff() > 0);
  }
}

TEST_CASE("no checked pair of the Panda touches at home or on the way to the table") {
  const Robot robot = panda_robot();
  CHECK(touching_pairs(robot, robot.home) == 0);
  const Arm arm(robot);
  for (const double x : {0.35, 0.5, 0.65})
    for (const double y : {-0.3, 0.0, 0.3}) {
      const Transform target = translation(x, y, 0.01) * rotation_rpy(std::numbers::pi, 0, 0);
      const auto q = arm.solve(target, arm.home(), RandomKey("table"));
      REQUIRE(q);
      CHECK(touching_pairs(robot, {q->data(), q->data() + q->size()}) == 0);
      // With the tip 10 mm above the table nothing of the arm but its base reaches the table.
      const std::vector<Transform> world = poses(robot, {q->data(), q->data() + q->size()});
      double lowest = 1;
      for (std::size_t i = 1; i < world.size(); ++i)
        for (const Shape& shape : robot.body.parts[i].shapes)
          if (shape.collides)
            for (const Vector3& point : filled(shape))
              lowest = std::min(lowest, (world[i] * shape.part_from_shape * point).z());
      CHECK(lowest > 0);
    }
}

TEST_CASE("a Panda whose tip is inside its own base touches itself, so the pairs do check something") {
  const Robot robot = panda_robot();
  const Arm arm(robot);
  Random random(RandomKey("inside"));
  int tried = 0;
  for (int k = 0; k < 200000 && tried < 3; ++k) {
    JointVector q(7);
    for (Eigen::Index i = 0; i < 7; ++i)
      q[i] = random.between(arm.limits()[static_cast<std::size_t>(i)].lower,
                            arm.limits()[static_cast<std::size_t>(i)].upper);
    const Vector3 tip = arm.base_from_tip(q).translation();
    if (tip.head<2>().norm() > 0.05 || tip.z() < 0.02 || tip.z() > 0.3) continue;  // not in the base's column
    ++tried;
    CHECK(touching_pairs(robot, {q.data(), q.data() + q.size()}) > 0);
  }
  CHECK(tried == 3);
}

TEST_CASE("the hand's numbers: palm 37 mm above the tip, fingers 9.5 mm beyond it, 80 mm apart when open") {
  const Robot robot = panda_robot();
  const auto part = [&](const char* name) {
    return robot.body.parts[static_cast<std::size_t>(robot.body.part_index(name))];
  };
  CHECK(bounding_box(part("hand"))[1].z() == Approx(0.1034 - 0.037).margin(1e-9));
  CHECK(0.0584 + bounding_box(part("left_finger"))[1].z() == Approx(0.1034 + 0.0095).margin(1e-4));
  CHECK(2 * (0.04 + bounding_box(part("left_finger"))[0].y()) == Approx(0.08).margin(1e-4));
}

TEST_CASE("cubes of the table scene rest on the table apart from each other") {
  const Scene scene = table_scene(30);
  REQUIRE(scene.bodies.size() == 31);
  CHECK(scene.bodies[0].name == "table");
  for (std::size_t i = 1; i < scene.bodies.size(); ++i) {
    const Vector3 centre = scene.bodies[i].world_from_body.translation();
    CHECK(centre.z() == 0.02);
    for (std::size_t j = 1; j < i; ++j) CHECK((centre - scene.bodies[j].world_from_body.translation()).norm() > 0.0899);
  }
}
