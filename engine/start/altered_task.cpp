#include "engine/start/altered_task.h"

#include <cmath>

#include "engine/base/error.h"
#include "engine/start/constraints.h"
#include "engine/start/language.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// `the red block is on the table and the hand is empty`; nothing for what templates cannot say.
std::string sentence(const Formula& formula, const Domain& domain, const Scene& scene) {
  if (formula.kind == Formula::Kind::conjunction) {
    std::string text;
    for (const Formula& part : formula.parts) {
      const std::string one = sentence(part, domain, scene);
      if (one.empty()) return {};
      text += (text.empty() ? "" : " and ") + one;
    }
    return text;
  }
  const bool negated = formula.kind == Formula::Kind::negation;
  const Formula& inner = negated ? formula.parts[0] : formula;
  const Predicate* predicate = inner.kind == Formula::Kind::atom ? domain.predicate(inner.predicate) : nullptr;
  if (predicate == nullptr || predicate->label.empty()) return {};
  std::vector<std::string> names;
  for (const Term& term : inner.terms) {
    if (term.variable) return {};
    names.push_back(term.name);
  }
  const std::string text = fill(predicate->label, predicate->parameters, names, scene);
  return negated ? "it is not so that " + text : text;
}

void set_rates(Task& task, const RunOptions& options) {
  Scene& scene = task.scene;
  if (options.physics_hz > 0) scene.physics_hz = options.physics_hz;
  if (options.frame_hz > 0) scene.frame_hz = options.frame_hz;
  if (options.horizon_s > 0) task.horizon_s = options.horizon_s;
  const auto check = [&](const std::string& what, double hz) {
    if (!(hz > 0) || std::fmod(scene.physics_hz, hz) != 0)
      throw Error("physics_hz",
                  "physics at " + std::to_string(scene.physics_hz) + " Hz has no whole number of steps for " + what,
                  "choose a multiple");
  };
  check("a frame at " + std::to_string(scene.frame_hz) + " Hz", scene.frame_hz);
  for (const Sensor& sensor : scene.sensors) check("a sample of " + sensor.name, sensor.rate_hz);
}

void set_goal(Task& task, const Formula& goal, const Symbols& symbols) {
  const Domain& domain = symbols.domain();
  task.goal = checked_formula(goal, domain, static_facts(task.scene, domain).objects, "--goal");
  const std::string text = sentence(task.goal, domain, task.scene);
  task.instructions = {text.empty() ? "make this true: " + to_text(task.goal) : "make sure that " + text};
  task.stages.clear();
  task.steps.reset();
  task.subgoals.clear();
  task.also = task.fails = nullptr;
  task.reward = nullptr;
}

}  // namespace

Task altered(Task task, const Symbols& symbols, const RunOptions& options) {
  set_rates(task, options);
  if (!options.motion_planner.empty()) task.motion_planner = options.motion_planner;
  if (options.where) task.where = task.where ? conjunction({*options.where, *task.where}) : *options.where;
  if (options.goal) set_goal(task, *options.goal, symbols);
  const RandomKey key = RandomKey("perturb").with(task.name).with(task.variation).with(options.seed);
  for (std::string& instruction : task.instructions) instruction = perturbed(instruction, options.perturb, key);
  return task;
}

TaskDraw altered(const TaskDraw& task, const Symbols& symbols, const RunOptions& options) {
  return [task, &symbols, &options](int draw) { return altered(task(draw), symbols, options); };
}

}  // namespace stampede
