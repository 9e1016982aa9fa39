// What counts as success is as strict as RLBench's conditions, and what counts as seated is: by geometry, not by the
// numbers that the scripts judge by.
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "engine/rollout/skill_execution.h"
#include "engine/start/start.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr double kDegree = M_PI / 180;

EpisodeRecord done(const std::string& task) {
  RunOptions options;
  options.seed = 7400011;
  EpisodeRecord episode = run_task(task, first_variation(task), options);
  INFO(task << ": " << verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  return episode;
}

double joint(const EpisodeRecord& episode, std::int64_t frame, const std::string& name) {
  for (std::size_t i = 0; i < episode.scene.joints.size(); ++i)
    if (episode.scene.joints[i].name == name) return episode.frames[static_cast<std::size_t>(frame)].joint_position[i];
  FAIL("no joint " << name);
  return 0;
}

Transform pose(const EpisodeRecord& episode, std::int64_t frame, const std::string& name) {
  for (std::size_t i = 0; i < episode.scene.posed.size(); ++i)
    if (episode.scene.posed[i] == name)
      return to_transform(episode.frames[static_cast<std::size_t>(frame)].object_pose[i]);
  FAIL("no pose of " << name);
  return Transform::Identity();
}

// The last interval of a fact that holds at the end.
const FactRecord& last(const EpisodeRecord& episode, const std::string& predicate, const std::string& first) {
  const FactRecord* found = nullptr;
  for (const FactRecord& record : episode.labels.facts)
    if (record.fact.predicate == predicate && record.open_end && record.fact.arguments.front() == first)
      found = &record;
  REQUIRE(found != nullptr);
  return *found;
}

}  // namespace

TEST_CASE("doors, lids, switches and knobs have moved at least as far as RLBench asks, when it first counts") {
  const auto left = [](const char* task, const char* part) {
    const EpisodeRecord episode = done(task);
    return joint(episode, last(episode, "closed", part).first_frame, part);
  };
  CHECK(left("close_box", "box.lid") < 2.618 - 2.6);
  CHECK(left("close_laptop_lid", "laptop.lid") < 1.833 - 1.79);
  CHECK(left("toilet_seat_down", "toilet.seat") < 1.745 - 1.7);
  CHECK(left("close_grill", "grill.lid") < 10 * kDegree);
  CHECK(left("close_door", "doorway.door") < 5 * kDegree);
  const auto gone = [](const char* task, const char* predicate, const char* part) {
    const EpisodeRecord episode = done(task);
    return joint(episode, last(episode, predicate, part).first_frame, part);
  };
  CHECK(gone("toilet_seat_up", "open", "toilet.seat") > 1.40);
  CHECK(gone("turn_oven_on", "turned", "cooker.oven_knob") > 1.5);
  CHECK(gone("turn_tap", "turned", "basin.left_tap") > 1.57);
  const EpisodeRecord flipped = done("press_switch");
  const auto& names = flipped.scene.joints;
  const auto rocker = std::ranges::find_if(names, [](const JointName& one) { return one.name == "switch.rocker"; });
  REQUIRE(rocker != names.end());
  CHECK(joint(flipped, std::ssize(flipped.frames) - 1, "switch.rocker") > 1.0 / 1.047 * rocker->upper);
}

TEST_CASE("what first counts as in a slot or hung is all the way in, and straight") {
  struct Seat {
    const char *task, *predicate, *object, *place, *owner;
    Vector3 at;      // a point of the object, in its frame …
    Vector3 wanted;  // … and where it is when it is all the way in, in the owner's frame
    double most, degrees;
    Vector3 own, others;  // directions that are then one
  };
  const Vector3 x = Vector3::UnitX(), z = Vector3::UnitZ();
  const std::vector<Seat> seats = {
      {"plug_charger_in_power_supply",
       "in_slot",
       "charger",
       "outlet.socket",
       "outlet",
       {0.025, 0, 0},
       {0, 0, 0.13},
       0.004,
       6,
       x,
       x},
      {"put_umbrella_in_umbrella_stand",
       "in_slot",
       "umbrella",
       "stand.tube",
       "stand",
       {0, 0, 0},
       {0, 0, 0.010},
       0.006,
       16,
       z,
       z},
      {"insert_onto_square_peg", "hanging", "ring", "target.peg", "target", {0, 0, 0}, {0, 0, 0.026}, 0.004, 4, z, z},
      {"solve_puzzle", "in_slot", "piece", "puzzle.hole", "puzzle", {0, 0, 0}, {0, 0, 0.005}, 0.003, 3, z, z},
  };
  for (const Seat& seat : seats) {
    const EpisodeRecord episode = done(seat.task);
    INFO(seat.task);
    const std::int64_t frame = last(episode, seat.predicate, seat.object).first_frame;
    const Transform there = pose(episode, frame, seat.owner).inverse() * pose(episode, frame, seat.object);
    const Vector3 along = seat.others, off = there * seat.at - seat.wanted;
    CHECK(std::abs(off.dot(along)) < seat.most);
    CHECK(std::acos(std::min(1.0, (there.linear() * seat.own).dot(along))) < seat.degrees * kDegree);
  }
}

TEST_CASE("a skill that has just done what it declares has nothing to do when it is called again, whichever it is") {
  const std::vector<std::string> tasks = {"close_drawer",
                                          "open_drawer",
                                          "put_item_in_drawer",
                                          "take_money_out_safe",
                                          "press_switch",
                                          "turn_oven_on",
                                          "slide_block_to_target",
                                          "reach_target",
                                          "stack_cups",
                                          "put_rubbish_in_bin",
                                          "phone_on_base",
                                          "unplug_charger",
                                          "hang_frame_on_hanger",
                                          "take_frame_off_hanger",
                                          "pick_and_lift",
                                          "open_jar",
                                          "set_the_table",
                                          "put_groceries_in_cupboard",
                                          "tv_on"};
  std::set<std::string> called;
  for (const std::string& name : tasks) {
    RunOptions options;
    options.seed = 7400011;
    const std::string variation = first_variation(name);
    const EpisodeRecord episode = run_task(name, variation, options);
    EpisodeScripts scripts(all_tasks(), name, variation, options.seed);
    const PreparedStart start = prepare_start(scripts.task(), scripts.symbols(), options);
    Rollout rollout(scripts.symbols(), start, SensorReader(*start.scene, {}, RandomKey("test")), nullptr);
    SkillExecution execution(rollout, scripts.symbols(), scripts.skills(), options);
    for (const SegmentRecord& segment : episode.labels.segments) {
      if (segment.kind != SegmentKind::skill) continue;
      SkillRequest request;
      request.step = {segment.case_name.empty() ? segment.skill : segment.skill + "_" + segment.case_name,
                      segment.arguments};
      request.mode.refuse = false;
      REQUIRE_FALSE(execution.begin(request));
      if (!run_to_end(execution, rollout).ok()) break;  // another draw than the plan's
      INFO(name << " " << segment.skill);
      const std::string before = rollout.world().state_hash();
      REQUIRE_FALSE(execution.begin(request));
      CHECK(execution.status() == SkillStatus::done);
      CHECK(rollout.world().state_hash() == before);
      called.insert(segment.skill);
    }
  }
  CHECK(called.size() >= 18);
}

TEST_CASE("a pick that counts leaves what stands beside where it stood") {
  int picks = 0;
  for (const std::string task : {"setup_chess", "pick_up_cup", "put_groceries_in_cupboard"})
    for (const std::int64_t seed : {7310001, 7310004, 7310006}) {
      RunOptions options;
      options.seed = seed;
      const EpisodeRecord episode = run_task(task, first_variation(task), options);
      for (const SegmentRecord& segment : episode.labels.segments) {
        if (segment.kind != SegmentKind::skill || segment.skill != "pick" || segment.outcome != Outcome::success)
          continue;
        ++picks;
        const auto frame = [&](std::int64_t step) { return step * episode.frame_hz / episode.physics_hz; };
        for (const std::string& name : episode.scene.posed) {
          if (name == segment.arguments.front() || name.starts_with(segment.arguments.front() + ".")) continue;
          const Transform before = pose(episode, frame(segment.span.start_step), name);
          const Transform after = pose(episode, frame(segment.span.end_step), name);
          INFO(task << " " << seed << ": " << segment.label << " moves " << name);
          CHECK((after.translation() - before.translation()).norm() < 0.0105);
        }
      }
    }
  CHECK(picks > 6);
}
