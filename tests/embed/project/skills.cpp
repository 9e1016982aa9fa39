// An agent that draws among the skills that are feasible until the goal holds.
#include <cstdio>
#include <random>
#include <stampede/session.h>

int main() {
  const stampede::Session session({});
  stampede::Environment world = session.environment("stack_blocks", {.reward = stampede::RewardKind::dense});
  world.reset({.variation = "height=2", .seed = 7});
  std::mt19937 random(1);
  stampede::StepResult now;
  int failed = 0;
  for (int i = 0; i < 100 && !now.terminated && !now.truncated; ++i) {
    std::vector<stampede::SkillChoice> feasible;
    for (const stampede::SkillChoice& choice : world.skills())
      if (choice.feasible) feasible.push_back(choice);
    if (feasible.empty()) break;
    const stampede::SkillChoice& drawn = feasible[random() % feasible.size()];
    now = world.step({.space = "skill", .skill = drawn.skill, .arguments = drawn.arguments});
    if (now.refusal || now.ended.size() != 1) return 1;
    const stampede::SkillEnd& end = now.ended.front();
    std::printf("(%s", end.skill.c_str());
    for (const std::string& argument : end.arguments) std::printf(" %s", argument.c_str());
    std::printf(") %s, %d frames, reward %.2f\n", end.success ? "done" : end.reason.c_str(),
                static_cast<int>(now.frames), now.reward);
    if (end.precondition_held != true) return 1;  // what the mask promised
    failed += end.success ? 0 : 1;
    if (now.reward == 1 && !now.terminated) now = world.step({.space = "hold"});  // the goal must hold for a while
  }
  std::printf("%s after %.1f s, %d skills failed\n", now.success ? "success" : "no success", now.observation.time_s,
              failed);
  return now.success ? 0 : 1;
}
