// A wrist sensor reads what the hand touches and holds, as Newton has it.
#include <catch2/catch.hpp>
#include <cmath>

#include "tests/engine/sim/sim_scenes.h"

using namespace stampede;
using namespace stampede::testing;

namespace {

// The mean over `seconds`, as a sensor of that period gives it.
Wrench mean_wrench(World& world, int part, double seconds) {
  const auto steps = static_cast<int>(std::llround(seconds / world.dt()));
  Wrench sum;
  for (int i = 0; i < steps; ++i) {
    world.step();
    if (world.step_count() % 12 == 0) world.close_window();
    const Wrench now = world.contact_wrench(part);
    sum.force += now.force / steps;
    sum.torque += now.torque / steps;
  }
  return sum;
}

}  // namespace

TEST_CASE("a held cube of 0.1 kg reads 0.98 N downwards, at any level of the arm", "[sim]") {
  World world(shared(table_scene(1)));
  const int cube = body_index(world, "cube1"), hand = world.scene().robot.tip_part;
  const Vector3 at = world.world_from_part({cube, 0}).translation();
  move_to(world, solve(world, tip_down(at.x(), at.y(), at.z() + 0.1), world.arm().home()), 2);
  const Wrench nothing = mean_wrench(world, hand, 0.1);
  CHECK(nothing.force.norm() == 0);  // an empty hand in the air: tared
  CHECK(nothing.torque.norm() == 0);
  move_line(world, tip_down(at.x(), at.y(), at.z()), 1);
  grip(world, 0);
  move_line(world, tip_down(at.x(), at.y(), at.z() + 0.2), 1);
  run(world, 1);
  REQUIRE(world.grasped() == PartRef{cube, 0});
  const double weight = 0.1 * 9.81;
  const Wrench wrench = mean_wrench(world, hand, 0.5);
  const Matrix3 world_from_hand = world.world_from_part({-1, hand}).linear();
  const Vector3 force = world_from_hand * wrench.force;
  CAPTURE(force.transpose(), wrench.torque.transpose());
  CHECK(force.z() == Approx(-weight).epsilon(0.03));  // what 20 N of grip leave over
  CHECK(force.head<2>().norm() < 0.05);
  CHECK(wrench.force.z() == Approx(weight).epsilon(0.03));  // the hand points down
  // A weight is a force alone: its moment about the hand is the lever to the cube's centre crossed with it.
  const Vector3 lever =
      world.world_from_part({cube, 0}).translation() - world.world_from_part({-1, hand}).translation();
  const Vector3 moment = world_from_hand * wrench.torque;
  CHECK((moment - lever.cross(Vector3(0, 0, -weight))).norm() < 0.01);
  // Seen from the flange the force is the same: nothing else touches the arm.
  const int link7 = world.scene().robot.body.part_index("link7");
  const Wrench flange = mean_wrench(world, link7, 0.5);
  CHECK((world.world_from_part({-1, link7}).linear() * flange.force).z() == Approx(-weight).epsilon(0.03));
}

TEST_CASE("a hand that presses on the table is pressed back as hard, and the table pays for it", "[sim]") {
  World world(shared(table_scene(0)));
  const int hand = world.scene().robot.tip_part;
  grip(world, 0);
  move_to(world, solve(world, tip_down(0.5, 0, 0.05), world.arm().home()), 2);
  world.apply(operation::Controller{ControllerKind::cartesian_impedance, 500});
  run(world, 0.5);
  move_line(world, tip_down(0.5, 0, -0.015), 2);  // below the table's top
  run(world, 2);
  const Wrench wrench = mean_wrench(world, hand, 0.05);
  const Vector3 force = world.world_from_part({-1, hand}).linear() * wrench.force;
  Vector3 on_hand = Vector3::Zero();  // by the contact list of the same window
  for (const Contact& contact : world.contacts()) {
    REQUIRE(contact.a.body == -1);
    on_hand += contact.force;
  }
  CAPTURE(force.transpose(), on_hand.transpose());
  CHECK((force - on_hand).norm() < 1e-4);  // the hand turns a little during the window
  // A spring of 500 N/m that is short by the depth it was asked to go.
  const double short_of = world.world_from_tip().translation().z() -
                          world.arm().world_from_tip(world.reference().position).translation().z();
  CHECK(force.z() == Approx(500 * short_of).epsilon(0.15));
  CHECK(force.z() > 2);
}

TEST_CASE("a wrench is of the last step alone, and a wrong part is refused", "[sim]") {
  World world(shared(table_scene(0)));
  CHECK(world.contact_wrench(0).force.norm() == 0);
  CHECK_THROWS_WITH(world.contact_wrench(99), Catch::Contains("no part 99"));
}
