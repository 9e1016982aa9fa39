// A long horizon: thirty blocks, sixty skills, three declared subgoals.
#include <catch2/catch.hpp>

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
  for (const SegmentRecord& segment : episode.segments) {
    if (segment.kind != "subgoal") continue;
    CHECK(segment.span.first_frame == end);
    end = segment.span.end_frame;
    subgoals.push_back(segment.skill);
  }
  CHECK(subgoals == std::vector<std::string>{"first_colour", "second_colour", "third_colour", "goal"});
  CHECK(end == static_cast<std::int64_t>(episode.frames.size()));
}
