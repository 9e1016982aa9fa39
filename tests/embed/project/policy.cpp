// A controller of one's own as the body of a skill: planned with, tested, labelled and stored like any other skill.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stampede/session.h>

namespace {

// In place of a trained network: brings the tip to the target by its velocity.
class Servo final : public stampede::Policy {
 public:
  void begin(const stampede::PolicyCall& call) override {
    target_ = "object_pose/" + call.arguments.at("target");
    gain_ = call.parameters.at("gain")[0];
  }
  std::optional<stampede::AgentAction> act(const stampede::EnvironmentObservation& now) override {
    const std::vector<double>&tip = now["gripper_pose"].reals(), &goal = now[target_].reals();
    stampede::AgentAction action{.space = "tool_velocity", .values = std::vector<double>(6, 0.0)};
    for (std::size_t i = 0; i < 3; ++i) action.values[i] = std::clamp(gain_ * (goal[i] - tip[i]), -0.4, 0.4);
    return action;  // until the skill's effect holds, or its time is up
  }

 private:
  std::string target_;
  double gain_ = 1;
};

}  // namespace

int main() {
  // A folder of one's own, whose files go before those of the same name that came with the library.
  std::filesystem::create_directories("mine/skills");
  std::ofstream("mine/skills/reach.lua") << R"(-- Bring the tip of the hand into the target.
return skill {
  params = { "target: target" },
  precondition = { is_not.at("target") },
  effect = { is.at("target") },
  continuous = { gain = { 3, min = 1, max = 5 } },
  label = "reach for the {target}",
  run = policy("servo", { seconds = 8 }),
}
)";
  std::filesystem::remove("policy.db");
  stampede::Session session({.paths = {"mine"}, .catalogue = "policy.db"});
  session.add_policy("servo", {.make = [] { return std::make_unique<Servo>(); },
                               .channels = {"gripper_pose", "object_pose"},
                               .version = "1"});
  const stampede::RunTally tally =
      session.run_all({.tasks = {"reach_target"}, .episodes = 4, .workers = 2, .each = {.set = {"reach.gain=4"}}});

  // What it did is a skill with its effect tested, and the motion inside of it is the policy's.
  const stampede::Rows rows = session.query(
      "SELECT s.label, s.effect_held FROM segments s JOIN segments m ON m.episode = s.episode AND "
      "m.parent = s.segment WHERE s.skill = 'reach' AND m.skill = 'policy'");
  for (std::size_t i = 0; i < rows.size(); ++i)
    std::printf("%s: the effect %s\n", rows.text(i, "label").c_str(),
                !rows.is_null(i, "effect_held") && rows.integer(i, "effect_held") == 1 ? "holds" : "does not hold");
  std::printf("%d of %d succeeded\n", static_cast<int>(tally.succeeded), static_cast<int>(tally.finished));
  return tally.succeeded == 4 && rows.size() == 4 ? 0 : 1;
}
