// Runs one skill: draws its continuous parameters, plans and executes its motions, tests its effects.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/episode/rollout.h"

namespace stampede {

struct SkillResult {
  Reason reason = Reason::none;
  std::string detail;
  bool ends_episode = false;  // interrupted, timeout, out_of_order, failed_by_task
  int segment = -1;           // ordinal of the skill's segment
  // Ways to clear what was in the way, nearest first: without these things (free bodies, drawers, doors) the reason
  // would not be.
  std::vector<std::vector<std::string>> blockers = {};
  std::optional<PlanStep> step = {};  // what was tried
  bool ok() const { return reason == Reason::none; }
};

// How a skill is called; the first two are for who draws skills instead of planning them.
struct CallMode {
  bool refuse = true;              // a false precondition ends the call; else it is noted and the skill runs
  bool random_parameters = false;  // continuous parameters within their bounds, any of the grasps and placements
  bool find_blockers = false;      // where nothing reaches: look what is in the way
};

class SkillDriver {
 public:
  SkillDriver(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options, RandomKey key)
      : rollout_(rollout), symbols_(symbols), skills_(skills), options_(options), key_(key) {}

  // `position`: index in the plan, `attempt`: how often it was tried before; both only choose the draws.
  SkillResult run(const PlanStep& step, int parent_segment, int position, int attempt, const CallMode& mode = {});
  // The built-in skill `wait`: stands still until the goal holds (`patience` frames at most, else goal_false) and then
  // for `hold` frames more, through which it must stay true (else goal_unstable).
  SkillResult wait_for_goal(std::int64_t patience, std::int64_t hold, int parent_segment);

 private:
  struct Context {
    const Action& action;
    const SkillInfo& info;
    std::vector<std::string> arguments;
    RandomKey key;
    int attempt = 0;
    int segment = -1;
    CallMode mode = {};
  };
  SkillResult run_call(Context& context, const SkillCall* preset, int parent);
  void open_segment(Context& context, int parent, const Facts& before);
  Reason draw(const Context& context, SkillCall& call, std::string& detail);
  Reason draw_grasp(const Context& context, const ContinuousInfo& info, ContinuousValue& value, std::string& detail);
  Reason draw_sample(const Context& context, const ContinuousInfo& info, ContinuousValue& value, std::string& detail);
  SkillResult execute(const Context& context, const SkillCall& call);
  SkillResult run_motion(const Context& context, const RobotCall& call, RandomKey key);
  SkillResult follow(Motion& motion, int segment);
  SkillResult run_child(const Context& context, const SkillCall& call, RandomKey key);
  void after_hand(const robot_call::Hand& hand, int segment, bool ok);
  SkillResult settle_effects(const Context& context, const std::vector<Literal>& effects);
  std::vector<std::string> missing(const std::vector<Literal>& effects, bool& pending) const;
  void name_blockers(const Context& context, SkillResult& result, const std::function<bool()>& works);
  std::vector<PartRef> touchable(const Context& context) const;
  SkillResult watch_goal(std::int64_t patience, std::int64_t hold);

  Rollout& rollout_;
  Symbols& symbols_;
  SkillLibrary& skills_;
  const RunOptions& options_;
  RandomKey key_;
};

}  // namespace stampede
