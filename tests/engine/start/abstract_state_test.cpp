#include "engine/start/abstract_state.h"

#include <catch2/catch.hpp>
#include <regex>

#include "engine/base/error.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

// The light is switched on after one second: until then nobody sees what the lower cube lies on.
class DarkSymbols : public PlainSymbols {
 public:
  bool can_hide(const std::string& predicate) const override { return predicate == "on"; }
  bool observable(const Fact& fact, const WorldView& view) override {
    return fact.arguments[0] != "cube2" || view.time_s() >= 1.0;
  }
};

const EpisodeRecord& dark() {
  static const EpisodeRecord episode = [] {
    const TaskDraw task = stack_draw();
    DarkSymbols symbols;
    PlainSkills skills;
    RunOptions options;
    options.seed = 1;
    return run_episode(task, symbols, skills, options);
  }();
  return episode;
}

const Fact kLies{"on", {"cube2", "table"}};  // from the beginning to the end

}  // namespace

TEST_CASE("what nobody could see is a fact, and known from the moment it was seen") {
  const EpisodeRecord& episode = dark();
  REQUIRE(episode.outcome == Outcome::success);
  for (const FactRecord& record : episode.labels.facts) {
    if (record.fact == kLies) CHECK_FALSE(record.observed);
    if (record.fact == kLies) CHECK(record.open_start);
    if (record.fact.predicate == "holding") CHECK(record.observed);
  }
  int seen = 0;
  for (const FactRecord& record : episode.labels.observed_facts) {
    CHECK(record.fact.predicate == "on");
    if (record.fact != kLies) continue;
    ++seen;
    CHECK(record.start_step == 240);
    CHECK(record.first_frame == 20);
    CHECK(record.open_end);
  }
  CHECK(seen == 1);
}

TEST_CASE("the state in symbols at a frame: facts, what is known of them, and numbers") {
  const EpisodeRecord& episode = dark();
  const AbstractState before = abstract_state(episode, 5), after = abstract_state(episode, 25);
  CHECK(before.facts.contains(kLies));
  CHECK_FALSE(before.observed.contains(kLies));
  CHECK(after.observed.contains(kLies));
  CHECK(before.observed.contains(Fact{"hand_empty", {"panda.hand"}}));
  CHECK(before.joint_fractions.at("panda.joint4") > 0);
  CHECK(before.joint_fractions.at("panda.joint4") < 1);
  CHECK(before.poses.at("cube2").position[2] == Approx(0.02).margin(1e-3));
  const Scene scene = scene_from_document(episode.scene.document);
  const std::string text = describe(before, DarkSymbols().domain(), scene);
  CHECK(text.find("is on the table (not known)\n") != std::string::npos);
  CHECK(text.find("the hand is empty\n") != std::string::npos);
  CHECK(unseen_things(before) == std::set<std::string>{"cube2"});
  CHECK(unseen_things(after).empty());
  CHECK(text.find("\ncube2 is at ") != std::string::npos);
  CHECK(std::regex_search(text, std::regex("\ncube2 is at [-0-9. ]+ \\(not known\\)\n")));
  AbstractState nearly;
  nearly.joints["door"] = -2e-7;
  nearly.joint_fractions["door"] = -1e-7;
  nearly.poses["cube2"].position = {-0.0004, -0.0, -0.0006};
  CHECK(describe(nearly, DarkSymbols().domain(), scene) ==
        "door is 0 % open (0.000)\ncube2 is at 0.000 0.000 -0.001\n");
  CHECK_THROWS_AS(abstract_state(episode, -1), Error);
  CHECK_THROWS_AS(abstract_state(episode, static_cast<std::int64_t>(episode.frames.size())), Error);
}

TEST_CASE("facts at each frame are those of the timeline: the goal holds in the last, not in the first") {
  const EpisodeRecord& episode = dark();
  const Fact goal{"on", {"cube1", "cube2"}};
  CHECK_FALSE(abstract_state(episode, 0).facts.contains(goal));
  CHECK(abstract_state(episode, static_cast<std::int64_t>(episode.frames.size()) - 1).facts.contains(goal));
}
