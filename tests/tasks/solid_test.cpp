// Nothing passes through anything: recorded frames measured anew, with geometry that is not the engine's.
#include <catch2/catch.hpp>

#include "tests/support/overlap.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr double kSlack_m = 0.0012;  // a contact that is pressed gives way by a little more than the millimetre

void check_solid(const std::string& task, int seed) {
  RunOptions options;
  options.seed = seed;
  const EpisodeRecord episode = run_task(task, first_variation(task), options);
  INFO(task << " " << seed << ": " << verdict(episode));
  CHECK_FALSE(episode.frames.empty());
  for (const Overlap& overlap : overlaps_of(episode)) {
    // What is pinched, jammed into a hole or dropped may be deeper for a frame: grasp and landing tests look at that.
    if (overlap.kind == OverlapKind::things || overlap.kind == OverlapKind::thing) continue;
    if (overlap.depth < kSlack_m) continue;
    FAIL_CHECK(to_text(overlap));
  }
}

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

TEST_CASE("arm and furniture are solid in every task, first third", "[solid]") {
  for (const std::string& task : shipped_tasks(0, 3)) check_solid(task, 1);
}
TEST_CASE("arm and furniture are solid in every task, second third", "[solid]") {
  for (const std::string& task : shipped_tasks(1, 3)) check_solid(task, 1);
}
TEST_CASE("arm and furniture are solid in every task, last third", "[solid]") {
  for (const std::string& task : shipped_tasks(2, 3)) check_solid(task, 1);
}
