// Execution is watched: what goes otherwise than declared is planned around from where the world is.
#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"
#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

EpisodeRecord run_with(const std::string& task, OnFailure on_failure) {
  RunOptions options;
  options.seed = 1;
  options.on_failure = on_failure;
  return run_task(task, "", options);
}

}  // namespace

TEST_CASE("a block is knocked off the post that a later step would take it from: the rest is planned again") {
  const auto on_failure = GENERATE(OnFailure::undo, OnFailure::recover, OnFailure::stop);
  const EpisodeRecord episode = run_with("sweep_past_pole", on_failure);
  INFO(to_string(on_failure) << ": " << verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  const auto push = std::find_if(episode.labels.segments.begin(), episode.labels.segments.end(),
                                 [](const SegmentRecord& segment) { return segment.skill == "push"; });
  const auto pick = std::find_if(
      episode.labels.segments.begin(), episode.labels.segments.end(),
      [](const SegmentRecord& segment) { return segment.skill == "pick" && segment.arguments[0] == "perched"; });
  REQUIRE((push != episode.labels.segments.end() && pick != episode.labels.segments.end()));
  CHECK(push->outcome == Outcome::success);  // it did what it declares, and more
  const Fact perched{"on", {"perched", "pole"}};
  const auto lost = std::find_if(episode.labels.facts.begin(), episode.labels.facts.end(),
                                 [&](const FactRecord& record) { return record.fact == perched; });
  REQUIRE(lost != episode.labels.facts.end());
  CHECK(lost->open_start);
  CHECK(lost->end_step > push->span.start_step);
  CHECK(lost->end_step <= push->span.end_step);
  // The first plan was to take it from the post: that is where it was. No try was undone to learn better.
  CHECK(pick->arguments[1] == "table");
  CHECK(pick->precondition_held == true);
  if (on_failure != OnFailure::recover) CHECK(episode.labels.attempts.empty());
}

TEST_CASE("blocks that leave no room for the fingers are found, named, and moved first") {
  const auto on_failure = GENERATE(OnFailure::undo, OnFailure::recover);
  const EpisodeRecord episode = run_with("walled_in", on_failure);
  INFO(to_string(on_failure) << ": " << verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  const auto skills = skills_of(episode);
  const auto last = std::find(skills.rbegin(), skills.rend(), "pick item");
  REQUIRE(last == skills.rbegin());
  CHECK(std::count_if(skills.begin(), skills.end(), [](const auto& text) { return text.starts_with("place"); }) >= 1);
  std::string reasons;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.reason == Reason::no_grasp) reasons += segment.detail + "\n";
  for (const AttemptRecord& attempt : episode.labels.attempts)
    if (attempt.segment.reason == Reason::no_grasp) reasons += attempt.segment.detail + "\n";
  CHECK_THAT(reasons, Catch::Contains("in the way: "));
}

TEST_CASE("an open drawer over the one that is wanted is shut first: by the plan, or once it is found in the way") {
  const bool aware = GENERATE(true, false);
  RunOptions options;
  options.seed = 1;
  options.where = formula_from_pddl("(open chest.top_drawer)", "test");
  const EpisodeRecord episode =
      run_task("put_item_in_drawer", "level=bottom", options, aware ? all_tasks() : unaware());
  INFO(verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(skills_of(episode) ==
        std::vector<std::string>{"close chest.top_drawer", "open chest.bottom_drawer", "pick item", "put_in item"});
  const auto named =
      std::any_of(episode.labels.attempts.begin(), episode.labels.attempts.end(), [](const AttemptRecord& attempt) {
        return attempt.segment.detail.find("in the way: chest.top_drawer") != std::string::npos;
      });
  CHECK(named == !aware);
}
