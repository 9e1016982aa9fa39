#include "engine/rollout/skill_policy.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"
#include "engine/rollout/agent_action.h"
#include "engine/rollout/priority_policy.h"

namespace stampede {
namespace {

MotionResult failed(std::string detail) { return {MotionStatus::failed, Reason::policy_error, std::move(detail)}; }

void stop(World& world) {
  if (world.steered()) world.apply(rest(world));
}

}  // namespace

const std::map<std::string, PolicyEntry>& shipped_policies() {
  static const std::map<std::string, PolicyEntry> entries = {{"keep_tool", keep_tool_policy()}};
  return entries;
}

const PolicyEntry& policy_entry(const RunOptions& options, const std::string& name) {
  std::vector<std::string> names;
  const auto find = [&](const std::map<std::string, PolicyEntry>& entries) -> const PolicyEntry* {
    for (const auto& [own, entry] : entries) names.push_back(own);
    const auto found = entries.find(name);
    return found == entries.end() ? nullptr : &found->second;
  };
  if (options.policies)
    if (const PolicyEntry* entry = find(*options.policies)) return *entry;
  if (const PolicyEntry* entry = find(shipped_policies())) return *entry;
  std::string cure = did_you_mean(name, names);
  if (!cure.empty()) cure += cure.back() == '?' ? " " : "; ";
  throw Error("policy '" + name + "'", "nobody has registered it",
              cure + "a program registers its own with Session::add_policy, in Python with add_policy");
}

Policy::~Policy() = default;

class SkillPolicy::Acting final : public Motion {
 public:
  explicit Acting(SkillPolicy& run) : run_(run) {}
  std::string kind() const override { return "policy"; }
  MotionResult step(World& world) override {
    MotionResult result = run_.step(world);
    if (result.status != MotionStatus::running) stop(world);
    return result;
  }
  void interrupt(World& world) override { stop(world); }

 private:
  SkillPolicy& run_;
};

SkillPolicy::SkillPolicy(Rollout& rollout, const RunOptions& options, const robot_call::Policy& call, int segment,
                         std::function<bool()> finished)
    : rollout_(rollout),
      spaces_(action_spaces(rollout.view().scene())),
      segment_(segment),
      finished_(std::move(finished)),
      until_(rollout.step() + std::llround(call.seconds * rollout.view().scene().physics_hz)) {
  const PolicyEntry& entry = policy_entry(options, call.name);
  settings_.channels = entry.channels;
  settings_.hidden = entry.hidden;
  settings_.width = entry.width;
  settings_.height = entry.height;
  observer_.emplace(rollout, options, settings_, renderer_);
  make_ = entry.make;
}

void SkillPolicy::begin(const PolicyCall& call) {
  policy_ = make_();
  policy_->begin(call);
}

std::unique_ptr<Motion> SkillPolicy::motion() { return std::make_unique<Acting>(*this); }

std::optional<AgentAction> SkillPolicy::take_pending() { return std::exchange(pending_, std::nullopt); }

void SkillPolicy::end_asked() {
  if (asked_) rollout_.recorder().end_asked(segment_, rollout_.step());
  asked_ = false;
}

void SkillPolicy::note_asked(const AgentAction& action) {
  rollout_.note_asked(action, segment_);
  asked_ = true;
}

// Before a physics step: at a frame it is asked, in between its last action goes on.
MotionResult SkillPolicy::step(World& world) {
  if (!rollout_.at_frame()) return {};
  end_asked();
  over_ = over_ || world.step_count() >= until_ || finished_();
  if (over_) return {MotionStatus::done};
  std::optional<AgentAction> action;
  try {
    action = policy_->act(observer_->observe());
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    return failed(error.what());
  }
  over_ = !action;
  if (over_) return {MotionStatus::done};
  if (auto mistake = mistake_in(*action, spaces_)) return failed(mistake->what + ": " + mistake->cure);
  if (action->space == "hold" || action->space == "go_on") return failed("a policy cannot ask for " + action->space);
  if (!lasts_a_frame(action->space)) {
    note_asked(*action);
    pending_ = std::move(action);
    return {MotionStatus::done};
  }
  AgentAction complete = *action;
  if (complete.controller.empty()) complete.controller = rollout_.recorder().segment(segment_).controller;
  auto operations = operations_for(complete, rollout_);
  if (const auto* refusal = std::get_if<ActionRefusal>(&operations)) return failed(refusal->what);
  note_asked(*action);
  for (const Operation& operation : std::get<std::vector<Operation>>(operations)) world.apply(operation);
  return {};
}

}  // namespace stampede
