#include "scripting/session/start_question.h"

#include "engine/start/altered_task.h"
#include "engine/start/relations.h"
#include "engine/start/start.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

void ask_what_is_known(const Task& task, const FactTracker& facts, std::int64_t seed, StartQuestion& question) {
  question.asked = planning_task(task, facts.domain(), facts, 0);
  question.plain = world_problem(task, facts);
  if (task.steps) return;
  keep_known(question.asked.problem, facts, {});
  if (const Facts possible = conceivable(facts); !possible.empty()) {
    const RandomKey key = RandomKey("assume").with(task.name).with(task.variation).with(seed);
    const auto ours = [](const PlanningTask& one) { return solve(one.domain, one.problem); };
    question.assumed = plan_assuming(question.asked, possible, key, ours).assumed;
  }
  keep_known(question.asked.problem, facts, question.assumed);
  keep_known(question.plain, facts, question.assumed);
  question.not_assumed = not_assumed(facts);
}

}  // namespace

StartQuestion question_at_start(EpisodeScripts& scripts, const RunOptions& options, const std::atomic<bool>* stop) {
  StartQuestion question;
  const PreparedStart start =
      prepare_start(altered(scripts.task(), scripts.symbols(), options), scripts.symbols(), options, stop);
  const Task& task = start.task;
  question.instructions = task.instructions;
  question.start = start;
  if (question.start.reason != Reason::none) return question;
  World world(question.start.scene);
  WorldView view(world);
  view.restore(start.history);
  FactTracker facts(scripts.symbols(), view, named_by(task, scripts.symbols()));
  facts.begin(start.values);  // as the episode begins: a fresh world has no contacts to read `on` from
  facts.look(view);
  facts.tell(task.told);
  ask_what_is_known(task, facts, options.seed, question);
  question.state.facts = facts.facts();
  question.state.observed = facts.observed();
  for (const Object& thing : view.scene().objects)
    if (thing.kind == ObjectKind::body) question.state.poses[thing.name] = to_pose(view.world_from(thing.name));
  question.beside_goal = beside_goal(task);
  if (task.steps) {
    question.said.emplace();
    question.said->solved = true;
    question.said->end = PlanEnd::solved;
    for (const TaskStep& one : *task.steps) question.said->plan.push_back(one.step);
  }
  return question;
}

PddlTexts pddl_of(const StartQuestion& question, const Domain& own, bool sized) {
  if (!sized) {
    const Domain domain = named_by_content(own);
    return {to_pddl(domain), to_pddl(question.plain, domain, question.beside_goal)};
  }
  const Domain domain = named_by_content(task_sized(question.asked.domain, question.asked.problem));
  return {to_pddl(domain), to_pddl(restricted(question.asked.problem, domain), domain, question.beside_goal)};
}

}  // namespace stampede
