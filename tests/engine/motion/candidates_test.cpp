#include "engine/motion/candidates.h"

#include <catch2/catch.hpp>

#include "engine/geometry/corners.h"
#include "engine/motion/candidate_shapes.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

Shape make_shape(ShapeKind kind, double radius, double length, const Vector3& size) {
  Shape shape;
  shape.kind = kind;
  shape.radius = radius;
  shape.length = length;
  shape.size = size;
  if (kind == ShapeKind::hull)
    for (const Vector3& corner : box_corners(-size / 2, size / 2)) shape.points.push_back(corner);
  return shape;
}

}  // namespace

TEST_CASE("grasps of every kind of shape are antipodal: the fingers straddle it and the palm stays outside") {
  const Vector3 size(0.03, 0.05, 0.2);
  for (const ShapeKind kind :
       {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule, ShapeKind::cone, ShapeKind::hull}) {
    const Shape shape = make_shape(kind, 0.025, 0.1, size);
    const auto grasps = shape_grasps(shape, 0.08, 0.03, RandomKey("shape"));
    REQUIRE_FALSE(grasps.empty());
    int both_yaws = 0;
    for (const ShapeGrasp& grasp : grasps) {
      const Matrix3 tip = grasp.part_from_tip.linear();
      CHECK((tip.transpose() * tip - Matrix3::Identity()).norm() < 1e-9);
      CHECK(tip.determinant() == Approx(1));
      CHECK(grasp.width > 0);
      CHECK(grasp.width <= 0.08);
      const Vector3 origin = grasp.part_from_tip.translation(), into = tip.col(2);
      CHECK(origin.dot(into) + reach(shape, -into) <= 0.03 + 1e-9);
      for (const ShapeGrasp& other : grasps)
        if ((other.part_from_tip.translation() - origin).norm() < 1e-9 &&
            (other.part_from_tip.linear().col(1) + tip.col(1)).norm() < 1e-9 &&
            (other.part_from_tip.linear().col(2) - into).norm() < 1e-9)
          ++both_yaws;
    }
    CHECK(both_yaws >= static_cast<int>(grasps.size()));
  }
}

TEST_CASE("what is wider than the hand has no grasp") {
  CHECK(shape_grasps(make_shape(ShapeKind::sphere, 0.05, 0, Vector3::Zero()), 0.08, 0.03, RandomKey("a")).empty());
  CHECK(shape_grasps(make_shape(ShapeKind::box, 0, 0, {0.1, 0.1, 0.1}), 0.08, 0.03, RandomKey("a")).empty());
}

TEST_CASE("reach is the support function: a turned box reaches as far as its corners") {
  Random random(RandomKey("reach"));
  const Shape box = make_shape(ShapeKind::box, 0, 0, {0.1, 0.2, 0.3});
  const Shape hull = make_shape(ShapeKind::hull, 0, 0, {0.1, 0.2, 0.3});
  for (int k = 0; k < 100; ++k) {
    const Vector3 direction = Vector3(random.normal(), random.normal(), random.normal()).normalized();
    CHECK(reach(box, direction) == Approx(reach(hull, direction)));
  }
  CHECK(reach(make_shape(ShapeKind::cone, 0.1, 0.4, Vector3::Zero()), Vector3::UnitZ()) == Approx(0.2));
  CHECK(reach(make_shape(ShapeKind::cone, 0.1, 0.4, Vector3::Zero()), Vector3::UnitX()) == Approx(0.1));
}

TEST_CASE("a cube's grasps are reachable, free, repeatable, and the first comes from above") {
  const World world(std::make_shared<Scene>(table_scene(8)));
  for (const char* name : {"cube1", "cube4", "cube8"}) {
    const Object& cube = *world.scene().object(name);
    const CollisionState state = world.collision_state();
    const JointVector home = world.arm().home();
    const auto grasps = grasp_candidates({state, world, cube, home, RandomKey("cube")}, 4);
    REQUIRE_FALSE(grasps.empty());
    CHECK(grasps[0].world_from_tip.linear().col(2).z() < -0.99);
    const Vector3 centre = world_from_object(world, cube).translation();
    for (std::size_t k = 0; k < grasps.size(); ++k) {
      CHECK(grasps[k].index == static_cast<int>(k));
      CHECK(grasps[k].width == Approx(0.04));
      CHECK((grasps[k].world_from_tip.translation() - centre).norm() < 0.03);
      CHECK(world.arm().solve(grasps[k].world_from_tip, home, RandomKey("ik")));
      const Vector3 back = grasps[k].world_from_tip.inverse() * grasps[k].world_from_approach.translation();
      CHECK((back - Vector3(0, 0, -0.08)).norm() < 1e-9);
    }
    const auto again = grasp_candidates({state, world, cube, home, RandomKey("cube")}, 4);
    REQUIRE(again.size() == grasps.size());
    for (std::size_t k = 0; k < grasps.size(); ++k)
      CHECK(again[k].world_from_tip.matrix() == grasps[k].world_from_tip.matrix());
  }
}

TEST_CASE("authored grasps replace those from geometry") {
  const World world(std::make_shared<Scene>(table_scene(1)));
  Object cube = *world.scene().object("cube1");
  Grasp authored;
  authored.object_from_tip = rotation_rpy(3.14159265358979, 0, 0.3);
  authored.width = 0.041;
  authored.force = 33;
  authored.approach = 0.05;
  cube.grasps = {authored};
  const CollisionState state = world.collision_state();
  const auto grasps = grasp_candidates({state, world, cube, world.arm().home(), RandomKey("authored")}, 4);
  REQUIRE(grasps.size() == 1);
  CHECK(grasps[0].force == 33);
  CHECK(grasps[0].width == 0.041);
}

TEST_CASE("of two grasps that can both be reached, the one from above comes first") {
  const World world(std::make_shared<Scene>(table_scene(1)));
  Object cube = *world.scene().object("cube1");
  for (const double slant : {0.785, 0.0}) {
    Grasp grasp;
    grasp.object_from_tip = rotation_rpy(3.14159265358979, -slant, 0);
    cube.grasps.push_back(grasp);
  }
  const CollisionState state = world.collision_state();
  for (int k = 0; k < 10; ++k) {
    const auto grasps = grasp_candidates({state, world, cube, world.arm().home(), RandomKey("slant").with(k)}, 4);
    REQUIRE(grasps.size() == 2);
    CHECK(grasps[0].world_from_tip.linear().col(2).z() < -0.99);
    CHECK(grasps[1].world_from_tip.linear().col(2).z() > -0.8);
  }
}

TEST_CASE("free spots lie on the table, clear of the other cubes, and rest on it") {
  const World world(std::make_shared<Scene>(table_scene(12)));
  const CollisionState state = world.collision_state();
  const Scene& scene = world.scene();
  const auto spots = free_spots({state, world, *scene.object("cube1"), RandomKey("spots"), 50}, *scene.object("table"));
  REQUIRE(spots.size() == 50);
  double spread = 0;
  for (const Transform& spot : spots) {
    CHECK(spot.translation().z() == Approx(0.021).margin(1e-6));
    CHECK(std::abs(spot.translation().x() - 0.55) < 0.4 - 0.02);
    CHECK(std::abs(spot.translation().y()) < 0.6 - 0.02);
    for (int other = 2; other <= 12; ++other) {
      const PartRef cube{scene.body_index("cube" + std::to_string(other)), 0};
      CHECK((spot.translation() - world.world_from_part(cube).translation()).norm() > 0.04);
    }
    spread = std::max(spread, (spot.translation() - spots[0].translation()).norm());
  }
  CHECK(spread > 0.4);
}

TEST_CASE("a cube is stacked on the middle of another, with parallel sides") {
  const World world(std::make_shared<Scene>(table_scene(3)));
  const CollisionState state = world.collision_state();
  const Scene& scene = world.scene();
  const auto spots = stack_spots({state, world, *scene.object("cube1"), RandomKey("stack"), 4}, *scene.object("cube2"));
  REQUIRE(spots.size() == 4);
  const Transform below = world.world_from_part({scene.body_index("cube2"), 0});
  for (const Transform& spot : spots) {
    CHECK((spot.translation() - below.translation() - Vector3(0, 0, 0.041)).norm() < 1e-6);
    const Matrix3 relative = below.linear().transpose() * spot.linear();
    CHECK(relative.cwiseAbs().maxCoeff() == Approx(1));
    CHECK((relative.cwiseAbs().rowwise().maxCoeff() - Vector3::Ones()).norm() < 1e-6);
  }
}

TEST_CASE("region spots keep the object inside the region, on its lower face") {
  const World world(std::make_shared<Scene>(table_scene(1)));
  const CollisionState state = world.collision_state();
  Region region;
  region.name = "target";
  region.part_from_region = translation(0.6, 0.3, 0.05);
  region.size = Vector3(0.15, 0.12, 0.1);
  const auto spots = region_spots({state, world, *world.scene().object("cube1"), RandomKey("region"), 20}, region);
  REQUIRE(spots.size() == 20);
  for (const Transform& spot : spots) {
    CHECK(spot.translation().z() == Approx(0.021).margin(1e-6));
    for (int corner = 0; corner < 8; ++corner) {
      const Vector3 point = spot * Vector3(corner & 1 ? 0.02 : -0.02, corner & 2 ? 0.02 : -0.02, 0);
      CHECK(std::abs(point.x() - 0.6) <= 0.075);
      CHECK(std::abs(point.y() - 0.3) <= 0.06);
    }
  }
}

TEST_CASE("places that cannot be are told of where somebody asks, with what they touch, and nothing changes by that") {
  const World world(std::make_shared<Scene>(table_scene(12)));
  const CollisionState state = world.collision_state();
  const Scene& scene = world.scene();
  const Object &table = *scene.object("table"), &cube = *scene.object("cube1");
  std::vector<Looked> turned_down;
  const auto plain = free_spots({state, world, cube, RandomKey("spots"), 50}, table);
  const auto watched = free_spots({state, world, cube, RandomKey("spots"), 50, &turned_down}, table);
  REQUIRE(watched.size() == plain.size());
  for (std::size_t i = 0; i < plain.size(); ++i) CHECK(watched[i].matrix() == plain[i].matrix());

  turned_down.clear();
  Region region;
  region.part_from_region = translation(world.world_from_part({scene.body_index("cube2"), 0}).translation());
  region.size = Vector3(0.02, 0.02, 0.04);
  CHECK(region_spots({state, world, cube, RandomKey("region"), 4, &turned_down}, region).empty());
  REQUIRE(turned_down.size() > 10);
  for (const Looked& one : turned_down) {
    CHECK(one.fate == Looked::Fate::touches);
    CHECK(one.touched == "cube2");
    if (one.missed_m < 0) continue;
    // Not a cube's edge nearer to it, and so far that both cubes can stand side by side.
    CHECK((one.missed_m > 0.015 && one.missed_m <= 0.064));
  }
  const Looked* nearest = nearest_miss(turned_down);
  REQUIRE(nearest != nullptr);
  CHECK(miss_of(*nearest).starts_with("touches cube2 by "));
  CHECK(causes_of(turned_down).text() == std::to_string(turned_down.size()) + " touch cube2");
}

TEST_CASE("of grasps that cannot be it is known what keeps the hand, and by how much") {
  Scene scene = table_scene(2);
  scene.bodies[static_cast<std::size_t>(scene.body_index("cube1"))].world_from_body = translation(1.2, 0, 0.02);
  const World world(std::make_shared<Scene>(scene));
  const CollisionState state = world.collision_state();
  const JointVector home = world.arm().home();
  const auto far = look_at_grasps({state, world, *world.scene().object("cube1"), home, RandomKey("why")}, true);
  REQUIRE(far.size() > 10);
  for (const Looked& one : far) CHECK(one.fate != Looked::Fate::usable);
  const Looked* nearest = nearest_miss(far);
  REQUIRE(nearest != nullptr);
  CHECK(nearest->fate == Looked::Fate::out_of_reach);
  CHECK((nearest->missed_m > 0.1 && nearest->missed_m < 0.8));
  const auto near = look_at_grasps({state, world, *world.scene().object("cube2"), home, RandomKey("why")}, true);
  CHECK(std::any_of(near.begin(), near.end(), [](const Looked& one) { return one.fate == Looked::Fate::usable; }));
  const auto through_table = [](const Looked& one) {
    return one.fate == Looked::Fate::touches && one.touched == "table" && one.pose.linear().col(2).z() > 0.9;
  };
  CHECK(std::any_of(near.begin(), near.end(), through_table));  // from below
}
