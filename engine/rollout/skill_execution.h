// One call of one skill, as a value that is ticked: whoever drives an episode owns the loop over physics steps.
//
//   SkillExecution execution(rollout, symbols, skills, options);
//   if (const auto refusal = execution.begin(request)) …         // nothing has changed
//   while (execution.tick() == SkillStatus::running) rollout.advance();
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/rollout/rollout.h"
#include "engine/rollout/skill_call.h"
#include "engine/rollout/skill_motion.h"
#include "engine/rollout/skill_policy.h"
#include "engine/start/effects.h"
#include "engine/start/impasse.h"
#include "engine/start/skills.h"

namespace stampede {

enum class SkillStatus { running, done, failed };

// Lifetime: refers to all it is made of; one at a time over a rollout.
class SkillExecution {
 public:
  // Of the options, `controller` and `set` count: they go before what a request says.
  SkillExecution(Rollout& rollout, Symbols& symbols, SkillLibrary& skills, const RunOptions& options)
      : rollout_(rollout), symbols_(symbols), skills_(skills), options_(options) {}
  SkillExecution(const SkillExecution&) = delete;
  SkillExecution& operator=(const SkillExecution&) = delete;
  ~SkillExecution();

  // Why there can be no such call, whatever the world is like; nothing: there can.
  std::optional<Error> mistake_in(const SkillRequest& request) const;

  // Opens the skill's segment, draws its continuous parameters and starts its run; what fails there is a segment that
  // has failed at once. One whose declared effects all hold already has succeeded at once. Result: nothing, or why
  // there can be no such call: then nothing has changed, in the world, in the record or here. May be called again when
  // the last call is over.
  std::optional<Error> begin(const SkillRequest& request);

  // To be called before every physics step until it is over: running means that one step is due now, made by
  // Rollout::advance(). Plans motions where one ends and the next begins. Once over, ticks change nothing.
  SkillStatus tick();
  SkillStatus status() const;

  // Between two ticks: the call is over, its open segments end here with the reason `interrupted`, and the arm brakes.
  void interrupt(const std::string& why);

  const SkillResult& result() const { return result_; }  // once it is over

 private:
  // What is going on: the script is asked for its next call, a motion, a child skill, waiting for effects.
  enum class Phase { over, calling, moving, child, settling };

  struct MissingEffects {
    std::vector<std::string> literals;  // of the declared effects, those that do not hold
    bool pending = false;               // one of all is becoming steady
  };

  void start(SkillContext context, int parent);
  void forget_lost();
  bool nothing_to_do();
  SkillCall undrawn_call() const;
  void note_parameters(const SkillCall& call);
  void start_run(SkillCall call);
  bool draw_again();
  void tell(Impasse impasse, const SkillResult& failed) const;
  void open_segment(int parent, const Facts& before);
  bool step_due();
  void after_step();
  bool ask_script();
  bool start_child(const AskedCall& call, RandomKey key);
  bool start_policy(const robot_call::Policy& call);
  bool go_on_with_policy(RandomKey key);
  bool start_asked_skill(const AgentAction& asked, RandomKey key);
  void restore_controller();
  bool plan_motion(const RobotCall& call, RandomKey key);
  void follow(std::unique_ptr<Motion> motion, const RobotCall* call = nullptr);
  bool step_motion();
  void end_motion(SkillResult result);
  bool begin_settling();
  bool settled();
  void end_settling(SkillResult result);
  MissingEffects missing_effects() const;
  std::vector<EffectRecord> not_needed() const;
  bool finish(SkillResult result);
  std::optional<SkillResult> ended() const;

  Rollout& rollout_;
  Symbols& symbols_;
  SkillLibrary& skills_;
  const RunOptions& options_;
  Phase phase_ = Phase::over;
  bool owns_ = false;        // it is the rollout's running call, not a child
  bool step_asked_ = false;  // the last tick said that a step is due
  SkillContext context_;
  SkillResult result_;
  std::unique_ptr<SkillRun> run_;
  operation::Controller controller_;  // of this call; a child may have had another
  int calls_ = 0, questions_ = 0;     // asked for so far
  int redraws_ = 0;
  std::vector<ContinuousValue> first_drawn_;
  bool arm_moved_ = false;  // or something else was done that other draws cannot take back
  std::unique_ptr<SkillExecution> child_;
  std::unique_ptr<SkillPolicy> policy_;  // the script waits for it
  SkillCall call_;                       // as it was drawn
  std::optional<SkillMotion> motion_;
  int settle_segment_ = -1;
  std::int64_t settle_until_ = 0;
  std::vector<CountedEffects> counted_;  // of what the segment declares
  MissingEffects missing_;               // at the last frame of settling
  std::optional<Impasse> looked_at_;     // where somebody asks: told if this call fails after all
};

// Ticks what has begun to its end, making every step that is due.
template <typename Execution>
const SkillResult& run_to_end(Execution& execution, Rollout& rollout) {
  while (execution.tick() == SkillStatus::running) rollout.advance();
  return execution.result();
}

}  // namespace stampede
