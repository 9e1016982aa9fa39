// The frozen world that motion planning asks.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <span>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/geometry/corners.h"
#include "engine/sim/configuration_checker.h"
#include "engine/sim/convex.h"
#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

Shape sphere(double radius) {
  Shape shape;
  shape.kind = ShapeKind::sphere;
  shape.radius = radius;
  return shape;
}

Transform random_pose(Random& random, double reach) {
  const Quaternion turn(random.normal(), random.normal(), random.normal(), random.normal());
  return make_transform({random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)},
                        turn.normalized());
}

// Distance of a point to a box, exactly.
double distance_to_box(const Vector3& point, const Vector3& half) {
  return (point.cwiseAbs() - half).cwiseMax(0.0).norm();
}

}  // namespace

TEST_CASE("a sphere and a box are as far apart as geometry says", "[sim]") {
  Random random(RandomKey("sphere and box"));
  const Convex ball(sphere(0.05)), box(box_shape({0.2, 0.1, 0.3}));
  for (int i = 0; i < 2000; ++i) {
    const Transform world_from_box = random_pose(random, 0.1), world_from_ball = random_pose(random, 0.4);
    const double gap =
        distance_to_box(world_from_box.inverse() * world_from_ball.translation(), {0.1, 0.05, 0.15}) - 0.05;
    CHECK(closer_than(ball, world_from_ball, box, world_from_box, gap + 1e-7));
    if (gap > 1e-6) CHECK_FALSE(closer_than(box, world_from_box, ball, world_from_ball, gap - 1e-7));
  }
}

TEST_CASE("a box and the hull of its corners agree", "[sim]") {
  Random random(RandomKey("box and hull"));
  Shape hull_shape;
  hull_shape.kind = ShapeKind::hull;
  for (const Vector3& corner : box_corners({-0.1, -0.05, -0.15}, {0.1, 0.05, 0.15}))
    hull_shape.points.push_back(corner);
  const Convex hull(hull_shape), box(box_shape({0.2, 0.1, 0.3}));
  Shape rod;
  rod.kind = ShapeKind::cylinder;
  rod.radius = 0.05;
  rod.length = 0.3;
  for (const ShapeKind kind : {ShapeKind::cylinder, ShapeKind::cone, ShapeKind::capsule, ShapeKind::box}) {
    rod.kind = kind;
    rod.size = {0.1, 0.1, 0.3};
    const Convex other(rod);
    int near = 0;
    for (int i = 0; i < 2000; ++i) {
      const Transform a = random_pose(random, 0.2), b = random_pose(random, 0.2);
      const bool one = closer_than(box, a, other, b, 0.01);
      near += one;
      CHECK(one == closer_than(hull, a, other, b, 0.01));
      CHECK(one == closer_than(other, b, hull, a, 0.01));
    }
    CHECK(near > 200);
    CHECK(near < 1990);
  }
}

TEST_CASE("the arm is free at home, and meets what is put in its way", "[sim]") {
  Scene scene = table_scene(3);
  World world(shared(scene));
  CollisionState state = world.collision_state();
  const JointVector home = world.arm().home();
  CHECK(state.free(home));
  CHECK_FALSE(state.first_contact(home));
  const int cube = body_index(world, "cube2");
  state.move_body(cube, world.world_from_tip() * translation(0, 0, -0.05));  // in the palm
  CHECK_FALSE(state.free(home));
  const auto pair = state.first_contact(home);
  REQUIRE(pair);
  CHECK(pair->other == PartRef{cube, 0});
  CHECK(pair->robot_part.body == -1);
  state.allow({cube, 0});
  CHECK_FALSE(state.free(home));  // the fingers may touch it, the palm may not
  // Between open fingers there is room for it; between closed ones there is not.
  state.move_body(cube, world.world_from_tip());
  state.set_opening(0.08);
  CHECK(state.free(home));
  state.set_opening(0.02);
  CHECK(state.free(home));
  state.clear_allowed();
  CHECK_FALSE(state.free(home));
}

TEST_CASE("of a part that the hand holds only the touched shapes do not count, wherever it moves", "[sim]") {
  Scene scene = table_scene(0);
  Body door = box_body("door", Vector3::Constant(0.01), {2, 0, 1}, 0);
  door.parts[0].shapes.push_back(box_shape({0.02, 0.3, 0.3}));
  door.parts[0].shapes.back().part_from_shape = translation(0.2, 0, 0);
  add_body(scene, door);
  World world(shared(scene));
  CollisionState state = world.collision_state();
  const JointVector home = world.arm().home();
  const int body = body_index(world, "door");
  state.set_opening(0.008);
  state.move_body(body, world.world_from_tip());
  CHECK_FALSE(state.free(home));
  state.allow_touched({body, 0}, home);
  CHECK(state.free(home));
  state.move_part({body, 0}, translation(-0.2, 0, 0));  // the panel where the hand is
  CHECK_FALSE(state.free(home));
}

TEST_CASE("padding is a distance: the table is met where the lowest point says", "[sim]") {
  World world(shared(table_scene(0)));
  CollisionState state = world.collision_state();
  state.set_opening(0);
  // The lowest points of a hand that points down are the finger boxes, 0.0584 + 0.0545 m beyond the hand's frame.
  const double lowest_below_tip = 0.0584 + 0.04525 + 0.00925 - 0.1034;
  double padding = 0;
  const auto free_at = [&](double gap) {
    return state.free(solve(world, tip_down(0.5, 0.1, lowest_below_tip + gap), world.arm().home()), padding);
  };
  CHECK(free_at(0.001));
  CHECK_FALSE(free_at(-0.001));
  padding = 0.02;
  CHECK(free_at(0.021));
  CHECK_FALSE(free_at(0.019));
}

TEST_CASE("a held body collides in the arm's stead", "[sim]") {
  World world(shared(table_scene(2)));
  CollisionState state = world.collision_state();
  const int held = body_index(world, "cube1"), other = body_index(world, "cube2");
  const JointVector q = solve(world, tip_down(0.5, 0.3, 0.1), world.arm().home());
  CHECK(state.free(q));
  state.hold(held, translation(0, 0, 0.09));  // hangs below the tip: its lowest face is 1 cm into the table
  CHECK(state.held() == held);
  const auto pair = state.first_contact(q);
  REQUIRE(pair);
  CHECK(pair->robot_part == PartRef{held, 0});
  CHECK(pair->other == PartRef{0, 0});
  state.allow({0, 0});
  CHECK(state.free(q));
  state.clear_allowed();
  state.hold(held, translation(0, 0, 0.02));
  CHECK(state.free(q));
  state.move_body(other, translation(0.5, 0.3, 0.08));
  CHECK_FALSE(state.free(q));
  state.release();
  CHECK_FALSE(state.held());
}

TEST_CASE("what rests in or on a thing goes with it", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, chest({0.6, 0, 0.05}));
  for (const double height : {0.10, 0.15}) {  // one in the drawer, one on that
    Body block = box_body(height < 0.12 ? "lower" : "upper", Vector3::Constant(0.04), {0.6, 0, height}, 0.1);
    block.free = true;
    add_body(scene, block);
  }
  Body stray = box_body("stray", Vector3::Constant(0.04), {0.3, 0.3, 0.03}, 0.1);
  stray.free = true;
  add_body(scene, stray);
  World world(shared(scene));
  CHECK(loads(world).empty());  // nothing has touched yet
  run(world, 0.5);
  const int lower = body_index(world, "lower"), upper = body_index(world, "upper"),
            furniture = body_index(world, "chest");
  const PartRef drawer{furniture, 1};
  CHECK(borne_by(world.scene(), loads(world), drawer) == std::vector<int>{lower, upper});
  CHECK(borne_by(world.scene(), loads(world), {lower, 0}) == std::vector<int>{upper});
  CHECK(borne_by(world.scene(), loads(world), {upper, 0}).empty());
  CHECK(borne_by(world.scene(), loads(world), {furniture, 0}) == std::vector<int>{lower, upper});

  // Where the block was is room once the drawer is out, and where it has gone to there is none.
  const int probe = body_index(world, "stray");
  const Transform there = world.world_from_part({lower, 0}), away = translation(0, 0.5, 0) * there;
  CollisionState state = world.collision_state();
  state.move_part(drawer, translation(0, 0.5, 0));
  CHECK_FALSE(state.body_free(probe, away, 0));
  CHECK_FALSE(state.body_free(probe, translation(0, 0, 0.04) * away, 0));
  state.move_part({furniture, 0}, translation(0, 0, 5));  // and all that is left of the chest
  CHECK(state.body_free(probe, there, 0));
  CollisionState held = world.collision_state();
  held.remove(drawer);
  held.move_part({furniture, 0}, translation(0, 0, 5));
  CHECK(held.body_free(probe, there, 0));
  held = world.collision_state();
  held.hold(lower, Transform::Identity());
  CHECK_FALSE(world.collision_state().body_free(probe, world.world_from_part({upper, 0}), 0));
  CHECK(held.body_free(probe, world.world_from_part({upper, 0}), 0));
}

TEST_CASE("an arm folded into itself is not free", "[sim]") {
  World world(shared(table_scene(0)));
  CollisionState state = world.collision_state();
  // Elbow bent to its limit with the forearm turned: the hand ends in the upper arm.
  const JointVector folded = (JointVector(7) << 0, -1.7, 0, -3.05, 0, 0.0, 0).finished();
  const auto pair = state.first_contact(folded);
  REQUIRE(pair);
  CHECK(pair->robot_part.body == -1);
  CHECK(pair->other.body == -1);
}

TEST_CASE("the checker agrees with Bullet's own contacts", "[sim]") {
  // A cube on the table is touched by the pressing hand exactly when the state, frozen then, says so.
  World world(shared(table_scene(1)));
  grip(world, 0);
  const Vector3 cube = world.world_from_part({1, 0}).translation();
  move_to(world, solve(world, tip_down(cube.x(), cube.y(), 0.08), world.arm().home()), 2);
  CHECK(world.collision_state().free(world.arm_position()));
  move_line(world, tip_down(cube.x(), cube.y(), 0.045), 1);
  const auto pair = world.collision_state().first_contact(world.arm_position(), 0.001);
  REQUIRE(pair);
  CHECK(pair->other == PartRef{1, 0});
}

TEST_CASE("a free place may have something below, but nothing beside or within", "[sim]") {
  World world(shared(table_scene(2)));
  CollisionState state = world.collision_state();
  const int cube = body_index(world, "cube1"), other = body_index(world, "cube2");
  const Vector3 neighbour = world.world_from_part({other, 0}).translation();
  CHECK(state.body_free(cube, translation(0.5, 0.3, 0.02), 0));
  CHECK(state.body_free(cube, translation(0.5, 0.3, 0.02), 0.02));  // padding does not count against the table
  CHECK_FALSE(state.body_free(cube, translation(0.5, 0.3, 0.01), 0));
  CHECK(state.body_free(cube, translation(neighbour + Vector3(0.041, 0, 0)), 0));
  CHECK_FALSE(state.body_free(cube, translation(neighbour + Vector3(0.041, 0, 0)), 0.005));
  CHECK(state.body_free(cube, translation(neighbour + Vector3(0, 0, 0.04)), 0.005));         // on top of it
  CHECK_FALSE(state.body_free(cube, world.world_from_tip() * translation(0, 0, -0.05), 0));  // in the palm
}

TEST_CASE("what the state says of random poses, the world's own contacts say too", "[sim]") {
  // A cube is put into or beside the hand at random; one step later Bullet tells what presses against what. Pairs that
  // are within half a millimetre of touching are left out. One cube only: two that overlap push each other off the
  // hand.
  World world(shared(table_scene(1)));
  Random random(RandomKey("contacts"));
  int met = 0, apart = 0;
  for (int round = 0; round < 240; ++round) {
    world.apply(operation::Place{body_index(world, "cube1"), translation(0.5, 0.5, 0.02)});
    run(world, 0.25);  // the arm that it struck comes to rest: it would leave what it touches
    world.apply(operation::Place{body_index(world, "cube1"), world.world_from_tip() * random_pose(random, 0.12)});
    world.apply(operation::Boundary{});
    const CollisionState state = world.collision_state();
    const JointVector q = world.arm_position();
    const auto of_state = state.contacts(q), nearly = state.contacts(q, 0.0005);
    world.step();
    world.close_window();
    const auto pressed = [&](const CollisionPair& pair) {
      return std::any_of(world.contacts().begin(), world.contacts().end(), [&](const Contact& contact) {
        return contact.a.body == -1 &&
               contact.b == pair.other;  // of several parts that touch it, one may do the pushing
      });
    };
    const auto among = [](const std::vector<CollisionPair>& pairs, PartRef a, PartRef b) {
      return std::any_of(pairs.begin(), pairs.end(),
                         [&](const CollisionPair& pair) { return pair.robot_part == a && pair.other == b; });
    };
    for (const CollisionPair& pair : of_state) {
      INFO("round " << round << ": part " << pair.robot_part.part << " and body " << pair.other.body);
      CHECK(pressed(pair));
      ++met;
    }
    for (const Contact& contact : world.contacts()) {
      if (contact.a.body != -1) continue;
      INFO("round " << round << ": part " << contact.a.part << " and body " << contact.b.body);
      CHECK(among(nearly, contact.a, contact.b));
    }
    apart += of_state.empty();
  }
  CHECK(met > 50);
  CHECK(apart > 5);
}

TEST_CASE("many configurations in one call get the answers of one call each", "[sim]") {
  World world(shared(table_scene(3)));
  CollisionState state = world.collision_state();
  state.hold(body_index(world, "cube1"), translation(0, 0, 0.02));
  Random random(RandomKey("many"));
  std::vector<JointVector> all;
  for (int k = 0; k < 400; ++k) {
    JointVector q(world.arm().joints());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const JointLimits& limits = world.arm().limits()[static_cast<std::size_t>(j)];
      q[j] = random.between(limits.lower, limits.upper);
    }
    all.push_back(q);
  }
  int touching = 0;
  for (std::size_t begin = 0; begin < all.size();) {
    const std::size_t free = state.first_touching(std::span(all).subspan(begin), 0.003);
    for (std::size_t i = begin; i < begin + free; ++i) REQUIRE(state.free(all[i], 0.003));
    begin += free;
    if (begin == all.size()) break;
    REQUIRE_FALSE(state.free(all[begin], 0.003));
    REQUIRE(state.first_contact(all[begin], 0.003));
    REQUIRE_FALSE(state.contacts(all[begin], 0.003).empty());
    ++touching;
    ++begin;
  }
  CHECK(touching > 20);
  CHECK(touching < 390);
}

TEST_CASE("many places in one call get the answers of one call each, and a copy is a state of its own", "[sim]") {
  World world(shared(table_scene(3)));
  const CollisionState state = world.collision_state();
  const int cube = body_index(world, "cube1");
  Random random(RandomKey("places"));
  std::vector<Transform> places;
  for (int k = 0; k < 200; ++k)
    places.push_back(translation(random.between(0.2, 0.8), random.between(-0.4, 0.4), 0.02));
  const std::vector<bool> free = state.places_free(cube, places, 0.005);
  for (std::size_t k = 0; k < places.size(); ++k) CHECK(free[k] == state.body_free(cube, places[k], 0.005));
  CHECK(std::count(free.begin(), free.end(), true) > 20);
  CHECK(std::count(free.begin(), free.end(), false) > 2);
  CollisionState moved = state;
  moved.move_body(cube, world.world_from_tip() * translation(0, 0, -0.05));
  CHECK(state.free(world.arm().home()));
  CHECK_FALSE(moved.free(world.arm().home()));
  CHECK(world.collision_state().free(world.arm().home()));
}

namespace {

// All kinds of shapes around the arm, a flat hull and a line among them.
Scene all_kinds(int count, Random& random) {
  Scene scene = table_scene(1);
  for (int i = 0; i < count; ++i) {
    Body body = box_body("thing" + std::to_string(i), {0.1, 0.06, 0.14}, {0, 0, 0}, 0);
    Shape& shape = body.parts[0].shapes[0];
    switch (i % 7) {
      case 1:
        shape = sphere(0.06);
        break;
      case 2:
      case 3:
      case 4:
        shape.kind = i % 7 == 2 ? ShapeKind::cylinder : i % 7 == 3 ? ShapeKind::capsule : ShapeKind::cone;
        shape.radius = 0.04;
        shape.length = 0.16;
        break;
      case 5:
      case 6:  // flat; all in a line
        shape.kind = ShapeKind::hull;
        for (int k = 0; k < 6; ++k)
          shape.points.push_back({random.between(-0.1, 0.1), i % 7 == 5 ? random.between(-0.1, 0.1) : 0, 0});
        break;
      default:
        break;
    }
    do {
      body.world_from_body = random_pose(random, 0.8);
      body.world_from_body.translation().z() = random.between(0.05, 1.0);
    } while (body.world_from_body.translation().head<2>().norm() < 0.3);
    add_body(scene, body);
  }
  return scene;
}

JointVector random_configuration(const Arm& arm, Random& random) {
  JointVector q(arm.joints());
  for (Eigen::Index j = 0; j < q.size(); ++j) {
    const JointLimits& limits = arm.limits()[static_cast<std::size_t>(j)];
    q[j] = random.between(limits.lower, limits.upper);
  }
  return q;
}

}  // namespace

TEST_CASE("many at once leave out no contact, whatever stands about and whatever is held", "[sim]") {
  Random random(RandomKey("together"));
  for (int round = 0; round < 12; ++round) {
    World world(shared(all_kinds(round == 11 ? 0 : 7, random)));
    CollisionState state = world.collision_state();
    if (round % 3 == 1) state.hold(body_index(world, "cube1"), translation(0, 0, 0.02));
    const double padding = round % 2 == 0 ? 0 : 0.005;
    int free_edges = 0, touching_edges = 0;
    for (int k = 0; k < 60; ++k) {
      const JointVector a = random_configuration(world.arm(), random);
      JointVector b = a;
      for (double& value : b) value += random.between(-0.4, 0.4);
      if (!state.free(a, padding)) continue;
      std::vector<JointVector> samples;
      const int count = static_cast<int>(std::ceil((b - a).cwiseAbs().maxCoeff() / 0.005));
      for (int i = 1; i <= count; ++i) samples.push_back(a + (static_cast<double>(i) / count) * (b - a));
      const auto touching =
          std::find_if(samples.begin(), samples.end(), [&](const JointVector& q) { return !state.free(q, padding); });
      CHECK(state.first_touching(samples, padding) == static_cast<std::size_t>(touching - samples.begin()));
      ConfigurationChecker checker(state);
      CHECK(checker.all_free(samples, std::vector<double>(samples.size(), padding)) == (touching == samples.end()));
      (touching == samples.end() ? free_edges : touching_edges) += 1;
    }
    CHECK(free_edges + touching_edges > 0);
  }
}

TEST_CASE("eight at once are answered as each alone, with AVX2 and without, each with its own padding", "[sim]") {
  const bool plain = GENERATE(false, true);
  if (plain) ::setenv("STAMPEDE_NO_AVX2", "1", 1);
  Random random(RandomKey("lanes"));
  int touching = 0, all = 0;
  for (int round = 0; round < 12; ++round) {
    World world(shared(all_kinds(10, random)));
    CollisionState state = world.collision_state();
    state.set_opening(round % 2 == 0 ? 0 : 0.08);
    if (round % 3 == 1) state.hold(body_index(world, "cube1"), random_pose(random, 0.05));
    if (round % 3 == 2)
      for (int body = 0; body < 5; ++body) state.allow({body, 0});
    ConfigurationChecker checker(state);
    for (int k = 0; k < 60; ++k) {
      std::vector<JointVector> some;
      std::vector<double> paddings;
      for (std::int64_t i = random.below(19); i >= 0; --i) {
        some.push_back(random_configuration(world.arm(), random));
        // A turn more is the same place.
        if (random.below(4) == 0) some.back()[0] += 2 * std::numbers::pi;
        paddings.push_back(std::max(0.0, random.between(-0.02, 0.03)));
      }
      std::size_t first = 0;
      while (first < some.size() && state.free(some[first], paddings[first])) ++first;
      REQUIRE(checker.first_touching(some, paddings) == first);
      REQUIRE(checker.all_free(some, paddings) == (first == some.size()));
      all += static_cast<int>(some.size());
      touching += first < some.size() ? 1 : 0;
    }
  }
  CHECK(touching > 100);
  CHECK(touching < all / 2);
  ::unsetenv("STAMPEDE_NO_AVX2");
}

TEST_CASE("the hand alone touches what it touches with the arm behind it", "[sim]") {
  Random random(RandomKey("hand"));
  int touching = 0, free = 0;
  for (int round = 0; round < 6; ++round) {
    World world(shared(all_kinds(14, random)));
    CollisionState state = world.collision_state();
    state.set_opening(0.01 * round);
    if (round % 2 == 1) state.allow({2, 0});
    const Robot& robot = world.scene().robot;
    const auto of_hand = [&](int part) {
      while (part >= 0 && part != robot.arm.back()) part = robot.body.parts[static_cast<std::size_t>(part)].parent;
      return part == robot.arm.back();
    };
    for (int k = 0; k < 200; ++k) {
      const JointVector q = random_configuration(world.arm(), random);
      const auto contacts = state.contacts(q, 0.004);
      const bool touches = std::any_of(contacts.begin(), contacts.end(), [&](const CollisionPair& pair) {
        return pair.other.body >= 0 && pair.robot_part.part != robot.arm.back() && of_hand(pair.robot_part.part);
      });
      REQUIRE(state.hand_free(world.arm().world_from_tip(q), 0.004) == !touches);
      (touches ? touching : free) += 1;
    }
  }
  CHECK(touching > 30);
  CHECK(free > 30);
}

TEST_CASE("what is held may be larger than the arm", "[sim]") {
  Scene scene = table_scene(0);
  add_body(scene, box_body("plank", {2.4, 0.2, 0.02}, {0, 1.5, 0.5}, 1));
  World world(shared(scene));
  CollisionState state = world.collision_state();
  state.hold(body_index(world, "plank"), translation(0, 0, 0.02));
  Random random(RandomKey("plank"));
  const JointVector home = world.arm().home();
  for (int k = 0; k < 40; ++k) {
    JointVector to = home;
    for (double& value : to) value += random.between(-0.3, 0.3);
    const double padding = k % 2 == 0 ? 0 : 0.01;
    CHECK((state.first_touching(std::span(&to, 1), padding) == 1) == state.free(to, padding));
  }
}

TEST_CASE("among a thousand things the answers are those for each alone", "[sim]") {
  Random random(RandomKey("thousand"));
  Scene scene = table_scene(0);
  for (int i = 0; i < 1000; ++i)
    add_body(scene, box_body("pebble" + std::to_string(i), Vector3::Constant(0.02),
                             {random.between(-0.9, 0.9), random.between(-0.9, 0.9), random.between(0.02, 1)}, 0));
  World world(shared(scene));
  const CollisionState state = world.collision_state();
  for (int k = 0; k < 20; ++k) {
    const JointVector a = random_configuration(world.arm(), random);
    const bool free = state.free(a);
    CHECK(free == state.contacts(a).empty());
    CHECK(state.first_touching(std::span(&a, 1)) == (free ? 1U : 0U));
  }
}

TEST_CASE("links that are near each other are told before they touch, the further apart on the arm the sooner",
          "[sim]") {
  const World world(shared(table_scene(0)));
  const CollisionState state = world.collision_state();
  const auto meets_itself = [&](const JointVector& q) {
    return std::ranges::any_of(state.contacts(q), [](const CollisionPair& pair) { return pair.other.body == -1; });
  };
  Random random(RandomKey("links"));
  int touching = 0, near = 0, apart = 0;
  for (int i = 0; i < 3000; ++i) {
    JointVector q(7);
    for (Eigen::Index j = 0; j < 7; ++j) {
      const JointLimits& own = world.arm().limits()[static_cast<std::size_t>(j)];
      q[j] = random.between(own.lower, own.upper);
    }
    const bool touches = state.links_within(q, 0);
    CHECK(touches == meets_itself(q));
    if (touches) CHECK(state.links_within(q, 0.003));
    touching += touches;
    near += !touches && state.links_within(q, 0.003);
    apart += !state.links_within(q, 0.003);
  }
  CHECK(touching > 100);
  CHECK(near > 20);
  CHECK(apart > 1000);
  CHECK_FALSE(state.links_within(world.arm().home(), 0.003));
}
