// Two environments in two threads: each sees the same numbers and pixels as alone.
#include <cstdio>
#include <random>
#include <stampede/session.h>
#include <thread>

namespace {

// All that is observed along a random walk of the joints and a skill.
std::vector<double> walk(const stampede::Session& session, const std::string& task, std::int64_t seed) {
  stampede::Environment world = session.environment(
      task, {.channels = {"joint_positions", "task_low_dim_state", "front_rgb"}, .width = 64, .height = 64});
  std::vector<double> seen;
  const auto see = [&](const stampede::EnvironmentObservation& now) {
    for (const char* name : {"joint_positions", "task_low_dim_state"})
      seen.insert(seen.end(), now[name].reals().begin(), now[name].reals().end());
    seen.insert(seen.end(), now["front_rgb"].bytes().begin(), now["front_rgb"].bytes().end());
  };
  see(world.reset({.seed = seed}));
  const stampede::SkillChoice first = world.skills().front();
  see(world.step({.space = "skill", .frames = 40, .skill = first.skill, .arguments = first.arguments}).observation);
  std::mt19937 random(static_cast<unsigned>(seed));
  std::uniform_real_distribution small(-0.05, 0.05);  // rad
  for (int i = 0; i < 40; ++i) {
    stampede::AgentAction action{.space = "joint_delta"};
    for (int joint = 0; joint < 7; ++joint) action.values.push_back(small(random));
    see(world.step(action).observation);
  }
  return seen;
}

}  // namespace

int main() {
  const stampede::Session session({});
  const std::vector<double> reach = walk(session, "reach_target", 1), close = walk(session, "close_drawer", 2);
  std::vector<double> left, right;
  std::thread one([&] { left = walk(session, "reach_target", 1); });
  std::thread two([&] { right = walk(session, "close_drawer", 2); });
  one.join();
  two.join();
  const bool same = left == reach && right == close;
  std::printf("%zu and %zu values, %s\n", left.size(), right.size(), same ? "the same as alone" : "not as alone");
  return same ? 0 : 1;
}
