// Nothing passes through anything: recorded frames measured anew, with geometry that is not the engine's.
#include <catch2/catch.hpp>

#include "tests/support/overlap.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

void check_solid(const std::string& task, int seed, const std::string& variation) {
  RunOptions options;
  options.seed = seed;
  const EpisodeRecord episode = run_task(task, variation, options);
  INFO(task << " " << seed << ": " << verdict(episode));
  CHECK_FALSE(episode.frames.empty());
  for (const Overlap& overlap : overlaps_of(episode)) FAIL_CHECK(to_text(overlap));
}

void check_solid(const std::string& task, int seed) { check_solid(task, seed, first_variation(task)); }

}  // namespace

TEST_CASE("the measure of overlaps knows what is known", "[solid]") {
  Shape box;
  box.size = Vector3(0.2, 0.1, 0.3);
  Shape pin;
  pin.kind = ShapeKind::cylinder;
  pin.radius = 0.01;
  pin.length = 0.1;
  CHECK(depth_of(box, translation(0, 0, 0), box, translation(0.19, 0, 0)) == Approx(0.01).margin(2e-5));
  CHECK(depth_of(box, translation(0, 0, 0), box, translation(0.201, 0, 0)) == 0);
  CHECK(depth_of(box, translation(0, 0, 0), pin, translation(0, 0.055, 0)) == Approx(0.005).margin(2e-5));
  CHECK(depth_of(pin, translation(0, 0, 0), pin, translation(0.012, 0.009, 0)) == Approx(0.005).margin(1e-4));
}

TEST_CASE("arm and furniture are solid in the tasks that open and shut things", "[solid]") {
  for (const char* task : {"open_microwave", "open_fridge", "close_laptop_lid", "open_washing_machine", "open_window",
                           "put_bottle_in_fridge", "slide_cabinet_open_and_place_cups", "turn_oven_on"})
    for (const int seed : {6, 7}) check_solid(task, seed);
}

TEST_CASE("what is pinched, turned or let fall does not sink in where it once did", "[solid]") {
  check_solid("setup_chess", 730003, "case=5,count=3");              // a pawn trembled between the fingers
  check_solid("open_window", 730002);                                // one side lost its only point of contact
  check_solid("reach_and_drag", 730002, "colour=maroon");            // all of them, along an axis of the world
  check_solid("place_shape_in_shape_sorter", 730008, "form=prism");  // one corner landed, then the others
  check_solid("take_plate_off_colored_dish_rack", 730007);
  check_solid("place_hanger_on_rack", 930000);   // knocked against the rail, it was pressed into the hand
  check_solid("open_window", 970018);            // contact lost for a step: a finger jumped
  check_solid("open_fridge", 970021);            // a bar in the rounded edge of the hand
  check_solid("take_tray_out_of_oven", 970009);  // a wrist did not follow: the fingers' force took all iterations
}

TEST_CASE("arm and furniture are solid in every task, first third", "[solid]") {
  for (const std::string& task : shipped_tasks(0, 3)) check_solid(task, 1);
}
TEST_CASE("arm and furniture are solid in every task, second third", "[solid]") {
  for (const std::string& task : shipped_tasks(1, 3)) check_solid(task, 1);
}
TEST_CASE("arm and furniture are solid in every task, last third", "[solid]") {
  for (const std::string& task : shipped_tasks(2, 3)) check_solid(task, 1);
}
