// How often a controller of one's own succeeds, and how well that stands up to another start and to further things.
#include <algorithm>
#include <cstdio>
#include <stampede/session.h>

namespace {

// Goes straight to the target, which it observes.
class Reach : public stampede::Policy {
 public:
  std::optional<stampede::AgentAction> act(const stampede::EnvironmentObservation& now) override {
    const std::vector<double>& hand = now["gripper_pose"].reals();
    const std::vector<double>& target = now["object_pose/target"].reals();
    stampede::AgentAction step{.space = "tool_delta", .values = std::vector<double>(6)};
    for (std::size_t i = 0; i < 3; ++i) step.values[i] = std::clamp(0.5 * (target[i] - hand[i]), -0.02, 0.02);
    return step;
  }
};

}  // namespace

int main() {
  stampede::Session session({});
  const stampede::Evaluation answer =
      session.evaluate({"reach_target"}, {.episodes = 10,
                                          .perturb = {"start=2", "layout"},
                                          .workers = 2,
                                          .policy = [] { return std::make_unique<Reach>(); },
                                          .policy_name = "straight",
                                          .settings = {.channels = {"gripper_pose", "object_pose"}, .horizon_s = 10}});
  int told = 0;
  for (const stampede::EvaluationRow& row : answer.rows) {
    if (!row.axis.empty()) continue;  // of the variations with one colour
    std::printf("%-14s %-9s %3.0f %% (%.0f to %.0f), %.1f s\n", row.task.c_str(), row.perturbation.c_str(),
                100 * row.success, 100 * row.lower, 100 * row.upper, row.mean_length_s);
    for (const auto& [reason, count] : row.reasons) std::printf("  %s: %d\n", reason.c_str(), static_cast<int>(count));
    if (row.episodes != 10 || row.lower > row.success || row.success > row.upper) return 1;
    ++told;
  }
  return told == 3 && !answer.interrupted ? 0 : 1;
}
