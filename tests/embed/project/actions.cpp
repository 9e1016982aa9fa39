// Random actions in every action space of a task: how many frames went by, how many were refused, and why.
#include <cstdio>
#include <random>
#include <stampede/session.h>

namespace {

// Within the bounds; poses not far from that of the tool, or most of them would be out of reach; skills by name.
stampede::AgentAction random_action(const stampede::ActionSpace& space, const stampede::Environment& world,
                                    std::mt19937& random) {
  stampede::AgentAction action{.space = space.name};
  const std::vector<double> here = world.observe()["gripper_pose"].reals();
  const bool pose = space.name == "tool_pose" || space.name == "tool_impedance" || space.name == "tool_path";
  for (std::size_t i = 0; i < space.components.size(); ++i) {
    const stampede::ActionComponent& one = space.components[i];
    double value = std::uniform_real_distribution(one.lower, one.upper)(random);
    if (pose && i < 3) value = here[i] + 0.05 * value;
    if (pose && i >= 3 && i < 7) value = here[i];
    action.values.push_back(space.name == "tool_path_delta" ? 0.05 * value : value);
  }
  if (space.name == "tool_path" || space.name == "skill" || space.name == "hold") action.frames = 10;  // cut off then
  if (space.name != "skill") return action;
  auto choices = world.skills();
  std::erase_if(choices, [](const auto& one) { return !one.feasible; });
  if (choices.empty()) return action;  // it is refused
  const stampede::SkillChoice& choice = choices[random() % choices.size()];
  action.skill = choice.skill;
  action.arguments = choice.arguments;
  return action;
}

}  // namespace

int main() {
  const stampede::Session session({});
  stampede::Environment world = session.environment("pick_and_lift", {.channels = {"joint_positions", "gripper_pose"}});
  std::int64_t seed = 7;
  world.reset({.seed = seed});
  const auto joints = world.spaces().front().components;  // of joint_position
  std::mt19937 random(1);
  for (const stampede::ActionSpace& space : world.spaces()) {
    std::int64_t frames = 0, refused = 0;
    std::string why;
    for (int i = 0; i < 10; ++i) {
      const stampede::StepResult now = world.step(random_action(space, world, random));
      frames += now.frames;
      if (now.refusal) {
        ++refused;
        why = now.refusal->what;
        if (now.frames != 0) return 1;  // nothing happens then
      } else if (now.frames == 0 && now.ended.empty()) {
        return 1;  // only a skill whose precondition does not hold ends at once
      }
      const auto& angles = now.observation["joint_positions"].reals();
      for (std::size_t j = 0; j < angles.size(); ++j)
        if (!(angles[j] > joints[j].lower - 1.1e-3 && angles[j] < joints[j].upper + 1.1e-3)) return 1;
      if (now.terminated || now.truncated) world.reset({.seed = ++seed});
    }
    std::printf("%-16s %4d frames, %2d of 10 refused %s\n", space.name.c_str(), static_cast<int>(frames),
                static_cast<int>(refused), why.c_str());
    if (frames == 0 && space.name != "skill" && space.name != "go_on") return 1;
  }
}
