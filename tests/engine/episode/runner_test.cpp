// A whole episode without Lua and SQL: planned, executed, tested, recorded, replayed.
#include "engine/episode/runner.h"

#include <catch2/catch.hpp>

#include "tests/support/labels.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

EpisodeRecord stack(std::int64_t seed, OnFailure on_failure = OnFailure::undo) {
  const TaskDraw task = plain::stack_draw();
  plain::PlainSymbols symbols;
  plain::PlainSkills skills;
  RunOptions options;
  options.seed = seed;
  options.on_failure = on_failure;
  return run_episode(task, symbols, skills, options);
}

}  // namespace

TEST_CASE("a planned episode reaches its goal, and what it declares is what happens") {
  const EpisodeRecord episode = stack(1);
  INFO(to_string(episode.reason) << ": " << episode.detail);
  for (const AttemptRecord& attempt : episode.labels.attempts)
    INFO(attempt.segment.skill << " " << to_string(attempt.segment.reason) << " " << attempt.segment.detail);
  REQUIRE(episode.outcome == Outcome::success);
  std::vector<std::string> skills;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::skill) skills.push_back(segment.skill);
  REQUIRE(skills == std::vector<std::string>{"pick", "place"});
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::skill) {
      CHECK(segment.precondition_held == true);
      CHECK(segment.effect_held == true);
    }
  CHECK(episode.frames.size() == static_cast<std::size_t>(episode.steps / 12 + 1));
  CHECK_FALSE(episode.frames.back().action.has_value());
  CHECK(episode.frames[episode.frames.size() - 2].done);
}

TEST_CASE("subgoals and motions tile the frames, skills those before the arm stands still for the verdict") {
  const EpisodeRecord episode = stack(2);
  REQUIRE(episode.outcome == Outcome::success);
  const SegmentRecord& hold = episode.labels.segments.back();
  REQUIRE(hold.skill == "hold");
  CHECK(hold.kind == SegmentKind::motion);
  CHECK(hold.parent == 0);  // of the subgoal: it belongs to no skill
  test::check_tiling(episode);
}

TEST_CASE("the same seed gives the same episode, another seed another") {
  const EpisodeRecord first = stack(3), second = stack(3), other = stack(4);
  CHECK(first.state_hash == second.state_hash);
  CHECK(first.steps == second.steps);
  CHECK(first.state_hash != other.state_hash);
}

TEST_CASE("a replay from scene and commands agrees bit for bit, and a changed command does not") {
  EpisodeRecord episode = stack(5);
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(replay_episode(episode) == "");
  for (Command& command : episode.commands)
    if (auto* follow = std::get_if<operation::Follow>(&command.operation)) {
      follow->trajectory.knots.back().position[0] += 1e-9;
      break;
    }
  CHECK(replay_episode(episode) != "");
}

TEST_CASE("facts agree with segments: on(cube1, table) ends in pick, on(cube1, cube2) begins in place") {
  const EpisodeRecord episode = stack(6);
  REQUIRE(episode.outcome == Outcome::success);
  const auto find = [&](const Fact& fact) {
    for (const FactRecord& record : episode.labels.facts)
      if (record.fact == fact) return record;
    FAIL(to_text(fact));
    return FactRecord{};
  };
  const FactRecord before = find({"on", {"cube1", "table"}}), after = find({"on", {"cube1", "cube2"}});
  CHECK(before.open_start);
  CHECK(after.open_end);
  for (const SegmentRecord& segment : episode.labels.segments) {
    if (segment.skill == "pick" && segment.kind == SegmentKind::skill) {
      CHECK(before.end_step > segment.span.start_step);
      CHECK(before.end_step <= segment.span.end_step);
    }
    if (segment.skill == "place" && segment.kind == SegmentKind::skill) {
      CHECK(after.start_step > segment.span.start_step);
      CHECK(after.start_step <= segment.span.end_step);
    }
  }
}

TEST_CASE("the stop-based keyframe rule misses the approach that pick passes at speed, its via-point is recorded") {
  const EpisodeRecord episode = stack(1);
  REQUIRE(episode.outcome == Outcome::success);
  REQUIRE_FALSE(episode.labels.vias.empty());
  const ViaRecord& approach = episode.labels.vias.front();
  CHECK(approach.name == "approach");
  CHECK(approach.speed > 0.1);  // rad/s: the rule's threshold for standing still
  const std::int64_t frame = approach.step / 12;
  const auto& keyframes = episode.labels.keyframes.at("stopped");
  for (const std::int64_t keyframe : keyframes) CHECK(std::abs(keyframe - frame) > 2);
  CHECK(keyframes.back() == static_cast<std::int64_t>(episode.frames.size()) - 1);
}

TEST_CASE("without undo a failure is the episode, and says why") {
  const TaskDraw task = plain::stack_draw();
  plain::PlainSymbols symbols;
  class Clumsy : public plain::PlainSkills {  // never opens the hand over the lower cube
   public:
    std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override {
      if (call.skill == "place")
        return std::make_unique<plain::CallList>(std::vector<RobotCall>{robot_call::Wait{0.1}});
      return plain::PlainSkills::start(call, view);
    }
  } skills;
  RunOptions options;
  options.seed = 1;
  options.on_failure = OnFailure::stop;
  const EpisodeRecord episode = run_episode(task, symbols, skills, options);
  CHECK(episode.outcome == Outcome::failure);
  CHECK(episode.reason == Reason::effect_mismatch);
  CHECK(episode.labels.attempts.empty());
  options.on_failure = OnFailure::undo;
  options.tries_per_skill = 2;
  options.tries_per_episode = 5;
  const EpisodeRecord undone = run_episode(task, symbols, skills, options);
  CHECK(undone.outcome == Outcome::failure);
  CHECK(undone.labels.attempts.size() >= 4);  // each undone try is a row
  CHECK(replay_episode(undone) == "");
}

TEST_CASE("an error in a skill's script ends the episode at once: it would come again") {
  const TaskDraw task = plain::stack_draw();
  plain::PlainSymbols symbols;
  struct Broken : plain::PlainSkills {
    std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override {
      if (call.skill == "place")
        return std::make_unique<plain::CallList>(
            std::vector<RobotCall>{robot_call::Fail{Reason::script_error, "skills/place.lua:7: no such method"}});
      return plain::PlainSkills::start(call, view);
    }
  } skills;
  RunOptions options;
  options.seed = 1;
  options.on_failure = OnFailure::undo;
  const EpisodeRecord episode = run_episode(task, symbols, skills, options);
  CHECK(episode.reason == Reason::script_error);
  CHECK(episode.labels.attempts.empty());
}
