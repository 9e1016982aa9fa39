// Seeded draws of skills instead of a plan: whatever is drawn, the episode ends, says why each skill failed, and
// replays.
#include <catch2/catch.hpp>

#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

TEST_CASE("random skills run in every kind of world, fail with reasons, and replay bit for bit") {
  const auto task =
      GENERATE(as<std::string>{}, "pick_and_lift", "stack_blocks", "put_item_in_drawer", "find_item_in_drawer");
  const auto behaviour = GENERATE(Behaviour::random_skills, Behaviour::random_applicable);
  RunOptions options;
  options.seed = 5;
  options.on_failure = OnFailure::recover;
  options.behaviour = behaviour;
  options.skills = 8;
  const EpisodeRecord episode = run_task(task, first_variation(task), options);
  INFO(task << " " << to_string(behaviour) << ": " << verdict(episode));
  CHECK(episode.reason != Reason::script_error);
  std::size_t skills = 0, unmet = 0;
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.kind != SegmentKind::skill) continue;
    INFO(segment.label << ": " << to_string(segment.reason) << " " << segment.detail);
    ++skills;
    unmet += segment.precondition_held == false;
    CHECK((segment.outcome == Outcome::success) == (segment.reason == Reason::none));
    CHECK(segment.reason != Reason::script_error);
  }
  CHECK(skills == 8);
  if (behaviour == Behaviour::random_applicable) CHECK(unmet == 0);
  CHECK(replay_episode(episode) == "");
}

TEST_CASE("an arm that runs any skills, possible or not, presses on nothing with much more than 80 N") {
  double most = 0;
  for (const std::string task : {"take_off_weighing_scales", "set_the_table", "open_fridge", "remove_cups"})
    for (const std::int64_t seed : {503, 504, 505, 506}) {
      RunOptions options;
      options.seed = seed;
      options.on_failure = OnFailure::recover;
      options.behaviour = Behaviour::random_skills;
      const EpisodeRecord episode = run_task(task, first_variation(task), options);
      for (const ContactRecord& contact : episode.labels.contacts) {
        if (contact.object_a != "panda") continue;
        INFO(task << " " << seed << ": " << contact.part_a << " and " << contact.object_b);
        CHECK(contact.peak_force < 100);
        most = std::max(most, contact.peak_force);
      }
    }
  CHECK(most > 20);
}
