// Planning with the simulator as the model: breadth first over feasible skills, by save and restore, until the goal
// holds.
#include <cstdio>
#include <deque>
#include <set>
#include <stampede/session.h>

namespace {

struct Node {
  stampede::SavedState state;
  std::vector<stampede::AgentAction> plan;  // that leads there
};

// What holds, one truth value a ground atom.
std::vector<bool> facts(const stampede::EnvironmentObservation& now) {
  const auto& row = now["facts"].bytes();
  return {row.begin(), row.end()};
}

}  // namespace

int main() {
  const stampede::Session session({});
  stampede::Environment world =
      session.environment("stack_blocks", {.channels = {"facts"}, .reward = stampede::RewardKind::dense});
  std::set<std::vector<bool>> seen = {facts(world.reset({.variation = "height=2", .seed = 7}))};
  const stampede::SavedState start = world.save();
  std::deque<Node> open = {{start, {}}};
  std::vector<stampede::AgentAction> found;
  int tried = 0;
  while (!open.empty() && found.empty() && tried < 500) {
    const Node node = open.front();
    open.pop_front();
    world.restore(node.state);
    for (const stampede::SkillChoice& choice : world.skills()) {
      if (!choice.feasible) continue;
      world.restore(node.state);
      const stampede::AgentAction call = {.space = "skill", .skill = choice.skill, .arguments = choice.arguments};
      const stampede::StepResult now = world.step(call);
      ++tried;
      if (now.refusal || now.truncated || !now.ended.front().success) continue;
      if (!seen.insert(facts(now.observation)).second) continue;  // another way to where we have been
      Node next = {world.save(), node.plan};
      next.plan.push_back(call);
      if (now.reward == 1) {  // the goal holds
        found = next.plan;
        break;
      }
      open.push_back(std::move(next));
    }
  }

  // From the start again: what follows a restore is the same, bit for bit.
  world.restore(start);
  for (const stampede::AgentAction& call : found) {
    std::printf("(%s", call.skill.c_str());
    for (const std::string& argument : call.arguments) std::printf(" %s", argument.c_str());
    std::puts(")");
    world.step(call);
  }
  const bool success = world.step({.space = "hold"}).success;
  std::printf("%s, %d skills tried, %zu states\n", success ? "success" : "no success", tried, seen.size());
  return success && !found.empty() ? 0 : 1;
}
