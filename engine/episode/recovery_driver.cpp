// Failures stay in the episode, and the rest is planned again from where the world is.
#include <map>

#include "engine/episode/drivers.h"

namespace stampede {
namespace {

constexpr int kFailuresPerAction = 3;  // then plans do without it

}  // namespace

SkillResult follow_with_recovery(Drive& drive) {
  CurrentPlan& plan = drive.plan;
  std::size_t position = 0;
  std::map<PlanStep, int> failures;
  for (int tries = 0;; ++position) {
    SkillResult result;
    std::optional<PlanStep> failed;
    for (std::size_t i = 0; result.ok() && i < plan.size(); ++i, ++position) {
      drive.track.here();
      result = drive.track.run(plan.next(i), position, plan.set(i), plan.mode(i));
      if (!result.ok()) failed = plan.steps[i];
      if (result.ok()) result = plan.watch(i + 1, result.segment);
    }
    drive.track.here();
    if (result.ok()) result = drive.track.finish_goal(position);
    if (result.ok() || result.ends_episode || plan.given() || ++tries >= drive.options.tries_per_episode) return result;
    if (failed && plan.avoid(result, 0)) continue;
    if (failed && ++failures[*failed] == kFailuresPerAction) plan.forbidden.insert(*failed);
    if (const SkillResult planned = plan.again(0); !planned.ok()) {
      if (plan.forbidden.empty()) return planned;
      plan.forbidden.clear();  // nothing works without what failed: try it again after all
      failures.clear();
      if (const SkillResult once_more = plan.again(0); !once_more.ok()) return once_more;
    }
  }
}

}  // namespace stampede
