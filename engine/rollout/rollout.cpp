#include "engine/rollout/rollout.h"

#include <chrono>
#include <cmath>

#include "engine/rollout/agent_action.h"
#include "engine/start/relations.h"

namespace stampede {

Rollout::Rollout(Symbols& symbols, const PreparedStart& start, SensorReader sensors, const std::atomic<bool>* stop)
    : task_(start.task),
      scene_(start.scene),
      symbols_(symbols),
      stop_(stop),
      world_(start.scene),
      view_(world_),
      facts_(symbols, view_, named_by(task_, symbols)),
      recorder_(view_),
      sensors_(std::move(sensors)),
      steps_per_frame_(start.scene->physics_hz / start.scene->frame_hz),
      horizon_steps_(std::llround(start.task.horizon_s * start.scene->physics_hz)) {
  view_.set_facts(&facts_);
  view_.restore(start.history);
  facts_.begin(start.values);
  facts_.look(view_);
  facts_.tell(start.task.told);
  recorder_.first_frame(view_);
  if (!sensors_.wants_margins()) return;
  Margins margins(symbols, facts_.atoms(), view_);
  if (margins.empty()) return;
  sensors_.add_margins(margins.channel(scene_->frame_hz));
  sensors_.note_margins(step(), margins.read(view_, start.values));
  margins_ = std::move(margins);
}

Reason Rollout::advance() {
  const auto before = std::chrono::steady_clock::now();  // a host time: reported, never decided upon
  world_.step();
  physics_wall_s_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - before).count();
  sensors_.step(view_);
  facts_.step(view_);
  return ended_ = close_step();
}

Reason Rollout::close_step() {
  if (at_frame())
    if (const Reason reason = close_frame(); reason != Reason::none) return reason;
  return check_stages();
}

Reason Rollout::close_frame() {
  world_.close_window();
  view_.close_frame();
  facts_.frame(view_);
  if (margins_) sensors_.note_margins(step(), margins_->read(view_));
  recorder_.contacts(view_);
  recorder_.frame(view_, task_.reward ? task_.reward(view_) : 0);
  if (!keeps_record_) {
    recorder_.forget_frames();
    facts_.forget_closed();
    sensors_.forget();
  }
  if (stop_ != nullptr && stop_->load(std::memory_order_relaxed)) return Reason::interrupted;
  if (!sensors_.failure().empty()) return Reason::sensor_error;
  if (task_.fails && task_.fails(view_)) return Reason::failed_by_task;
  return step() >= horizon_steps_ ? Reason::timeout : Reason::none;
}

Reason Rollout::check_stages() {
  const int count = static_cast<int>(task_.stages.size());
  while (stage_ < count && holds_now(task_.stages[static_cast<std::size_t>(stage_)])) ++stage_;
  for (int later = stage_ + 1; later < count; ++later)
    if (holds_now(task_.stages[static_cast<std::size_t>(later)])) return Reason::out_of_order;
  return Reason::none;
}

bool Rollout::holds_now(const Formula& formula) const {
  return holds(formula, facts_.facts(), symbols_.domain(), facts_.objects());
}

bool Rollout::goal_holds() {
  return stage_ == static_cast<int>(task_.stages.size()) && holds_now(task_.goal) && (!task_.also || task_.also(view_));
}

std::string Rollout::unmet_goal() const {
  std::string text;
  for (const std::string& literal : unmet(task_.goal, facts_.facts(), symbols_.domain(), facts_.objects()))
    text += (text.empty() ? "" : ", ") + literal;
  return text.empty() ? text : text + " does not hold";
}

Rollout::Checkpoint Rollout::checkpoint() {
  world_.apply(operation::Boundary{});
  return {world_.snapshot(), view_.history(), facts_.save(), recorder_.mark(), sensors_.mark(), keep, stage_};
}

int Rollout::open_motion(std::string kind, int parent_segment, std::string controller) {
  SegmentRecord segment;
  segment.kind = SegmentKind::motion;
  segment.parent = parent_segment;
  segment.robot = view_.scene().robot.name;
  segment.skill = std::move(kind);
  segment.controller = std::move(controller);
  return recorder_.open_segment(std::move(segment), step());
}

void Rollout::close_segment(int ordinal, Reason reason, std::string detail) {
  recorder_.close_segment(ordinal, step(), reason, std::move(detail));
}

void Rollout::keep_record(bool wanted) {
  keeps_record_ = wanted;
  world_.keep_log(wanted);
}

void Rollout::note_asked(const AgentAction& action, std::int64_t segment) {
  if (!keeps_record_) return;
  AskedAction noted;
  noted.asked = action;
  if (!is_of_tool(action.space)) noted.asked.frame = AgentAction{}.frame;
  noted.first_frame = noted.end_frame = recorder_.frame_at(step());
  noted.segment = segment;
  recorder_.agent_actions.push_back(std::move(noted));
}

Rollout::Branch Rollout::branch() { return {checkpoint(), recorder_, sensors_, ended_}; }

void Rollout::restore(const Branch& branch) {
  recorder_ = branch.recorder;
  sensors_ = branch.sensors;
  restore(branch.checkpoint);
  ended_ = branch.ended;
}

void Rollout::restore(const Checkpoint& checkpoint) {
  world_.restore(checkpoint.world);
  view_.restore(checkpoint.history);
  facts_.restore(checkpoint.facts);
  recorder_.cut(checkpoint.record);
  sensors_.cut(checkpoint.sensors);
  keep = checkpoint.keep;
  stage_ = checkpoint.stage;
  ended_ = Reason::none;
}

}  // namespace stampede
