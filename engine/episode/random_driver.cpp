// Skills drawn one after the other, with their arguments and continuous parameters.
#include "engine/episode/drivers.h"

namespace stampede {

SkillResult act_at_random(Drive& drive, const Rollout& rollout, RandomKey key) {
  const bool applicable = drive.options.behaviour == Behaviour::random_applicable;
  for (int i = 0; i < drive.options.skills; ++i) {
    drive.track.here();
    const std::optional<PlanStep> step = random_step(rollout.domain(), rollout.facts(), applicable, key.with(i));
    if (!step) return {Reason::no_plan, "no skill applies to anything here"};
    CallMode mode;
    mode.refuse = applicable;
    mode.random_parameters = true;
    drive.plan.steps.push_back(*step);
    const SkillResult result = drive.track.run(*step, static_cast<std::size_t>(i), {}, mode);
    if (result.ends_episode) return result;
  }
  drive.track.here();
  return drive.track.finish_goal(static_cast<std::size_t>(drive.options.skills));
}

}  // namespace stampede
