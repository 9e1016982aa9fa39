// A long horizon: thirty blocks, sixty skills, three declared subgoals.
#include <catch2/catch.hpp>
#include <chrono>
#include <functional>

#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

TEST_CASE("thirty blocks are sorted in at least sixty skills, subgoal by subgoal") {
  RunOptions options;
  options.seed = 21;
  const EpisodeRecord episode = run_task("sort_blocks", first_variation("sort_blocks"), options);
  INFO(verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(skills_of(episode).size() >= 60);
  std::vector<std::string> subgoals;
  std::int64_t end = 0;
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.kind != SegmentKind::subgoal) continue;
    CHECK(segment.span.first_frame == end);
    end = segment.span.end_frame;
    subgoals.push_back(segment.skill);
  }
  CHECK(subgoals == std::vector<std::string>{"first_colour", "second_colour", "third_colour", "goal"});
  CHECK(end == static_cast<std::int64_t>(episode.frames.size()));
}

namespace {

double seconds(const std::function<void()>& work) {
  const auto before = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
}

}  // namespace

// `test_tasks "[measure]"`: re-simulates the episode and keeps its facts current, frame by frame.
TEST_CASE("measure: what facts of a scene with thirty objects cost, beside the physics", "[.measure]") {
  RunOptions options;
  options.seed = 21;
  const std::string variation = first_variation("sort_blocks");
  const EpisodeRecord episode = run_task("sort_blocks", variation, options);
  EpisodeScripts scripts(all_tasks(), "sort_blocks", variation, options.seed);
  World world(std::make_shared<const Scene>(scene_from_document(episode.scene.document)));
  WorldView view(world);
  FactTracker tracker(scripts.symbols(), view);
  tracker.begin(tracker.read_all(view));
  double physics = 0, facts = 0;
  std::size_t next = 0;
  while (world.step_count() < episode.steps) {
    physics += seconds([&] {
      while (next < episode.commands.size() && episode.commands[next].step == world.step_count())
        world.apply(episode.commands[next++].operation);
      world.step();
    });
    facts += seconds([&] { tracker.step(view); });
    if (world.step_count() % 12 != 0) continue;
    world.close_window();
    view.close_frame();
    facts += seconds([&] { tracker.frame(view); });
  }
  WARN(verdict(episode) << ": " << skills_of(episode).size() << " skills, " << world.step_count() / 240.0
                        << " s simulated; wall " << episode.made.wall_s << " s; physics " << physics << " s, facts "
                        << facts << " s: " << 100 * facts / physics << " % of it, with "
                        << scripts.symbols().domain().predicates.size() << " predicates");
  CHECK(world.step_count() == episode.steps);
}
