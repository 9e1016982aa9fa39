// The columns of what an agent asked for: which action each frame is part of, its values, its reward.
#include <algorithm>
#include <limits>
#include <map>
#include <optional>

#include "engine/record/action_space.h"
#include "engine/record/array_maker.h"

namespace stampede {
namespace {

constexpr double kNotAsked = std::numeric_limits<double>::quiet_NaN();

// act(frame) for those that are part of an action, of so many that there are.
template <typename Act>
void each_frame_of(const AskedAction& one, std::size_t frames, const Act& act) {
  const auto end = std::min(one.end_frame, static_cast<std::int64_t>(frames));
  for (std::int64_t frame = std::max<std::int64_t>(one.first_frame, 0); frame < end; ++frame)
    act(static_cast<std::size_t>(frame));
}

std::optional<double> opening_of(const AgentAction& action) {
  if (action.values.empty()) return std::nullopt;  // a skill's fingers are its own
  return action.space == "gripper" ? action.values.front() : action.gripper;
}

// Actions with values of one space.
struct UsedSpace {
  std::vector<const AskedAction*> actions;
  std::size_t width = 0;
  bool world = false, tool = false;  // which frames of reference there are
};

std::map<std::string, UsedSpace> used_spaces(const std::vector<AskedAction>& actions) {
  std::map<std::string, UsedSpace> used;
  for (const AskedAction& one : actions) {
    if (one.asked.values.empty() || one.asked.space == "gripper") continue;
    UsedSpace& space = used[one.asked.space];
    space.actions.push_back(&one);
    space.width = std::max(space.width, one.asked.values.size());
    (one.asked.frame == "tool" ? space.tool : space.world) = true;
  }
  return used;
}

std::string reference_of(const std::string& name, const UsedSpace& space) {
  if (!is_of_tool(name)) return {};
  if (!space.tool) return "world";
  return space.world ? "world or tool" : "tool";
}

}  // namespace

void ArrayMaker::agent_actions() {
  if (!needs_of(request_).agent || episode_.agent_actions.empty()) return;
  arrays_.agent_actions = episode_.agent_actions;
  asked_ids();
  asked_values();
  asked_openings();
  asked_rewards();
}

// A policy's go before that of who called its skill.
void ArrayMaker::asked_ids() {
  if (!wanted("agent_action")) return;
  const std::vector<AskedAction>& actions = arrays_.agent_actions;
  std::vector<std::int64_t> ids(tables_.frames, -1);
  for (std::size_t i = 0; i < actions.size(); ++i)
    each_frame_of(actions[i], tables_.frames, [&](std::size_t frame) {
      const std::int64_t now = ids[frame];
      if (now < 0 || actions[static_cast<std::size_t>(now)].segment <= actions[i].segment)
        ids[frame] = static_cast<std::int64_t>(i);
    });
  add({"agent_action", ""}, {arrays_.frames}, std::move(ids));
}

// A column a space that was used: two that act at once are never of one space.
void ArrayMaker::asked_values() {
  std::vector<std::string> joints;
  for (const std::size_t place : arm_) joints.push_back(episode_.scene.joints[place].name);
  const std::vector<ActionSpace> named = named_spaces(joints);
  for (const auto& [name, space] : used_spaces(arrays_.agent_actions)) {
    if (!wanted("agent_action/" + name)) continue;
    const std::size_t width = space.width;
    std::vector<double> rows(tables_.frames * width, kNotAsked);
    for (const AskedAction* one : space.actions)
      each_frame_of(*one, tables_.frames, [&](std::size_t frame) {
        const std::vector<double>& values = one->asked.values;
        std::copy(values.begin(), values.end(), rows.begin() + static_cast<std::ptrdiff_t>(frame * width));
      });
    ColumnWords words{"agent_action/" + name, "", reference_of(name, space)};
    for (const ActionSpace& known : named) {
      if (known.name != name || known.components.size() != width) continue;
      std::string last;
      for (const ActionComponent& component : known.components) {
        words.labels.push_back(component.name);
        if (component.unit != last) words.unit += (last.empty() ? "" : ", ") + component.unit;
        last = component.unit;
      }
    }
    add_rows(std::move(words), width, std::move(rows));
  }
}

void ArrayMaker::asked_openings() {
  std::vector<double> openings(tables_.frames, kNotAsked);
  bool any = false;
  for (const AskedAction& one : arrays_.agent_actions)
    if (const auto opening = opening_of(one.asked)) {
      any = true;
      each_frame_of(one, tables_.frames, [&](std::size_t frame) { openings[frame] = *opening; });
    }
  if (any && wanted("agent_action/gripper")) add({"agent_action/gripper", "m"}, {arrays_.frames}, std::move(openings));
}

// At the last frame of an action: what came of it.
void ArrayMaker::asked_rewards() {
  std::vector<double> rewards(tables_.frames, kNotAsked);
  bool any = false;
  for (const AskedAction& one : arrays_.agent_actions) {
    if (!one.reward) continue;
    any = true;
    if (one.first_frame < one.end_frame && one.end_frame <= arrays_.frames && one.first_frame >= 0)
      rewards[static_cast<std::size_t>(one.end_frame - 1)] = *one.reward;
  }
  if (any && wanted("agent_reward")) add({"agent_reward", ""}, {arrays_.frames}, std::move(rewards));
}

}  // namespace stampede
