// A policy as the body of a skill: asked at each frame, until it is done.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/motion/motion.h"
#include "engine/rollout/observer.h"
#include "engine/start/robot_call.h"

namespace stampede {

// Those that come with the engine.
const std::map<std::string, PolicyEntry>& shipped_policies();

// Throws Error where nobody has registered a policy of that name, with the nearest one as cure.
const PolicyEntry& policy_entry(const RunOptions& options, const std::string& name);

// One call of a policy. Its actions of a frame are a Motion; a path or a skill that it asks for is whoever's task who
// runs the motion: `pending` holds it when the motion is done, and another motion goes on after it. Lifetime: refers
// to the rollout and the options.
class SkillPolicy {
 public:
  // `finished`: asked at each frame; true ends it, as does the call's time. `segment`: of the skill, whose controller
  // makes actions that name none. Throws Error, as it is no failure of the skill, when there is no policy of that name
  // or channel of those that it asks for, with the nearest one as cure.
  SkillPolicy(Rollout& rollout, const RunOptions& options, const robot_call::Policy& call, int segment,
              std::function<bool()> finished);
  void begin(const PolicyCall& call);  // throws what the policy throws

  std::unique_ptr<Motion> motion();  // `policy`, to the next path or skill, or the end
  std::optional<AgentAction> take_pending();
  void end_asked();  // in the record: what it asked for last ends here, if it has not ended
  bool over() const { return over_; }

 private:
  class Acting;
  MotionResult step(World& world);
  void note_asked(const AgentAction& action);

  Rollout& rollout_;
  EnvironmentSettings settings_;
  std::unique_ptr<Renderer> renderer_;
  std::optional<Observer> observer_;
  std::vector<ActionSpace> spaces_;
  std::function<std::unique_ptr<Policy>()> make_;
  std::unique_ptr<Policy> policy_;
  int segment_;
  std::function<bool()> finished_;
  std::int64_t until_ = 0;
  bool over_ = false, asked_ = false;
  std::optional<AgentAction> pending_;
};

}  // namespace stampede
