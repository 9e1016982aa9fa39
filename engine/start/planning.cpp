#include "engine/start/planning.h"

#include <algorithm>
#include <functional>
#include <set>

#include "engine/base/error.h"
#include "engine/start/effects.h"
#include "engine/start/relations.h"
#include "engine/symbolic/instances.h"

namespace stampede {
namespace {

std::string stage_name(std::size_t number) { return "stage_" + std::to_string(number); }

void collect(const Formula& formula, std::vector<Literal>& literals) {
  if (formula.kind == Formula::Kind::conjunction) {
    for (const Formula& part : formula.parts) collect(part, literals);
    return;
  }
  const bool negated = formula.kind == Formula::Kind::negation;
  const Formula& inner = negated ? formula.parts.front() : formula;
  if (inner.kind != Formula::Kind::atom)
    throw Error("goal", "in_order takes conjunctions of literals", "write the parts without any_of, exists or forall");
  Literal literal{{inner.predicate, {}}, negated};
  for (const Term& term : inner.terms) literal.fact.arguments.push_back(term.name);
  literals.push_back(std::move(literal));
}

Formula formula_of(const Literal& literal) {
  std::vector<Term> terms;
  for (const std::string& name : literal.fact.arguments) terms.push_back({false, name});
  Formula formula = atom(literal.fact.predicate, std::move(terms));
  return literal.negated ? negation(std::move(formula)) : formula;
}

// When this effect makes `literal` true: its own condition and equal arguments.
std::vector<Formula> matching(const Effect& effect, const Literal& literal) {
  std::vector<Formula> conditions;
  if (effect.when.kind != Formula::Kind::always) conditions.push_back(effect.when);
  for (std::size_t i = 0; i < effect.terms.size(); ++i) {
    Formula same;
    same.kind = Formula::Kind::equal;
    same.terms = {effect.terms[i], {false, literal.fact.arguments[i]}};
    conditions.push_back(std::move(same));
  }
  return conditions;
}

void add_constants(const std::set<std::string>& names, const std::vector<TypedObject>& objects, Domain& domain) {
  for (const TypedObject& object : objects)
    if (names.contains(object.name) &&
        std::find(domain.constants.begin(), domain.constants.end(), object) == domain.constants.end())
      domain.constants.push_back(object);
  std::sort(domain.constants.begin(), domain.constants.end(),
            [](const TypedObject& a, const TypedObject& b) { return a.name < b.name; });
}

void sort_predicates(Domain& domain) {
  std::sort(domain.predicates.begin(), domain.predicates.end(),
            [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
}

// The action may not be used with these arguments while the fluent `name` holds; what ends one of the facts ends it.
void obstruct(PlanningTask& planning, const Obstruction& obstruction, const std::string& name,
              const std::vector<TypedObject>& objects) {
  std::set<std::string> named(obstruction.action.arguments.begin(), obstruction.action.arguments.end());
  for (Action& action : planning.domain.actions) {
    if (action.name == obstruction.action.action) {
      std::vector<Formula> ways = {negation(atom(name, {}))};
      for (std::size_t i = 0; i < action.parameters.size(); ++i) {
        Formula same;
        same.kind = Formula::Kind::equal;
        same.terms = {{true, action.parameters[i].name}, {false, obstruction.action.arguments[i]}};
        ways.push_back(negation(std::move(same)));
      }
      action.precondition = conjunction({action.precondition, disjunction(std::move(ways))});
    }
    std::vector<Effect> added;
    for (const Effect& effect : action.effects)
      for (const Fact& fact : obstruction.facts) {
        if (!effect.negated || effect.predicate != fact.predicate) continue;
        named.insert(fact.arguments.begin(), fact.arguments.end());
        added.push_back({effect.forall, conjunction(matching(effect, {fact, true})), name, {}, true});
      }
    action.effects.insert(action.effects.end(), added.begin(), added.end());
  }
  add_constants(named, objects, planning.domain);
  planning.domain.predicates.push_back({name, {}, {}, {}, {}});
  sort_predicates(planning.domain);
  planning.problem.init.insert({name, {}});
}

// Is there no order of putting things down in which each relation is made by its first thing, the others standing?
bool in_a_circle(const std::vector<Literal>& relations) {
  std::set<std::string> waiting;
  for (const Literal& one : relations)
    if (!one.negated) waiting.insert(one.fact.arguments.front());
  const auto waits = [&](const std::string& thing) {  // for another that has yet to be put down
    return std::ranges::any_of(relations, [&](const Literal& one) {
      const auto& names = one.fact.arguments;
      return !one.negated && names.front() == thing &&
             std::any_of(names.begin() + 1, names.end(), [&](const auto& name) { return waiting.contains(name); });
    });
  };
  while (!waiting.empty()) {
    const auto next = std::ranges::find_if_not(waiting, waits);
    if (next == waiting.end()) return true;
    waiting.erase(next);
  }
  return false;
}

// Whoever puts the things down makes the relations that are asked of them, and whoever moves them ends them.
void relate(PlanningTask& planning, const std::vector<Literal>& relations, const FactTracker& facts, bool by_any) {
  std::set<std::string> named;
  for (const Literal& relation : relations) {
    const Fact& fact = relation.fact;
    const PredicateTraits traits = facts.symbols().traits(fact.predicate);
    named.insert(fact.arguments.begin(), fact.arguments.end());
    std::vector<Term> terms;
    for (const std::string& name : fact.arguments) terms.push_back({false, name});
    for (Action& action : planning.domain.actions) {
      const bool makes = !relation.negated && std::ranges::find(traits.made_by, action.skill) != traits.made_by.end();
      for (const auto& [skill, moved] : traits.moved_by) {
        if (skill != action.skill) continue;
        for (std::size_t i = 0; i < terms.size(); ++i) {
          Formula same;
          same.kind = Formula::Kind::equal;
          same.terms = {{true, moved}, terms[i]};
          action.effects.push_back({{}, std::move(same), fact.predicate, terms, !(makes && (by_any || i == 0))});
        }
      }
    }
  }
  add_constants(named, facts.objects(), planning.domain);
}

// That the literal holds after the action, but for what the action ends.
Formula true_after(const Action& action, const Literal& literal) {
  std::vector<Formula> ways = {formula_of(literal)};
  for (const Effect& effect : action.effects)
    if (effect.predicate == literal.fact.predicate && effect.negated == literal.negated && effect.forall.empty())
      ways.push_back(conjunction(matching(effect, literal)));
  return ways.size() == 1 ? ways.front() : disjunction(std::move(ways));
}

void advance_stages(Action& action, const std::vector<std::vector<Literal>>& stages) {
  std::vector<Effect> added;
  for (const Effect& effect : action.effects)
    for (std::size_t stage = 0; stage < stages.size(); ++stage)
      for (const Literal& literal : stages[stage]) {
        if (effect.predicate != literal.fact.predicate || effect.negated != literal.negated) continue;
        std::vector<Formula> conditions = matching(effect, literal);
        for (const Literal& other : stages[stage])
          if (other.fact != literal.fact) conditions.push_back(true_after(action, other));
        const auto with = [&](Formula condition, const std::string& predicate) {
          std::vector<Formula> all = conditions;
          if (condition.kind != Formula::Kind::always) all.push_back(std::move(condition));
          added.push_back({effect.forall, conjunction(std::move(all)), predicate, {}, false});
        };
        with(stage == 0 ? Formula{} : atom(stage_name(stage), {}), stage_name(stage + 1));
        if (stage > 0) with(negation(atom(stage_name(stage), {})), "out_of_order");
      }
  action.effects.insert(action.effects.end(), added.begin(), added.end());
}

}  // namespace

Problem world_problem(const Task& task, const FactTracker& facts) {
  Problem problem;
  problem.name = task.name;
  problem.objects = facts.objects();
  problem.init = facts.basic();
  problem.goal = task.goal;
  return problem;
}

std::string beside_goal(const Task& task) {
  std::string text;
  if (!task.stages.empty()) text = "the parts of the goal must come true in the order in which they are written";
  if (task.also) text += std::string(text.empty() ? "" : "; ") + "the task's own test `also` must hold too";
  return text;
}

PlanningTask planning_task(const Task& task, const Domain& domain, const FactTracker& facts, int reached,
                           const std::vector<Obstruction>& obstructions, bool by_any) {
  PlanningTask planning{domain, world_problem(task, facts)};
  for (TypedObject& constant : planning.domain.constants)  // a thing may be called as a part of another is
    for (const TypedObject& object : planning.problem.objects)
      if (object.name == constant.name) constant = object;
  if (const std::vector<Literal> relations = relations_asked(task, facts); !relations.empty())
    relate(planning, relations, facts, by_any || in_a_circle(relations));
  for (std::size_t i = 0; i < obstructions.size(); ++i)
    obstruct(planning, obstructions[i], "obstructed_" + std::to_string(i + 1), facts.objects());
  const std::vector<Formula>& stages = task.stages;
  if (stages.empty()) return planning;

  std::vector<std::vector<Literal>> literals(stages.size());
  for (std::size_t i = 0; i < stages.size(); ++i) collect(stages[i], literals[i]);
  for (Action& action : planning.domain.actions) advance_stages(action, literals);
  std::set<std::string> named;  // the effects speak of these objects, so the domain must know them
  for (const auto& stage : literals)
    for (const Literal& literal : stage) named.insert(literal.fact.arguments.begin(), literal.fact.arguments.end());
  add_constants(named, facts.objects(), planning.domain);
  std::vector<Formula> goal = {task.goal, atom(stage_name(stages.size()), {}), negation(atom("out_of_order", {}))};
  for (std::size_t i = 1; i <= stages.size(); ++i)
    planning.domain.predicates.push_back({stage_name(i), {}, {}, {}, {}});
  planning.domain.predicates.push_back({"out_of_order", {}, {}, {}, {}});
  sort_predicates(planning.domain);
  for (int i = 1; i <= reached; ++i) planning.problem.init.insert({stage_name(static_cast<std::size_t>(i)), {}});
  planning.problem.goal = conjunction(std::move(goal));
  return planning;
}

namespace {

using Visit = std::function<void(const std::vector<std::string>&)>;

void complete(const Action& action, std::vector<std::string>& arguments, const symbolic::View& view, const Visit& visit,
              std::size_t from = 0) {
  if (from == action.parameters.size()) return visit(arguments);
  if (!arguments[from].empty()) return complete(action, arguments, view, visit, from + 1);
  for (const TypedObject& candidate : view.objects) {
    if (!symbolic::admits(action.parameters[from], candidate, view)) continue;
    if (std::find(arguments.begin(), arguments.end(), candidate.name) != arguments.end()) continue;
    arguments[from] = candidate.name;
    complete(action, arguments, view, visit, from + 1);
    arguments[from].clear();
  }
}

// What is left open is tried object by object.
void limit_choices(const Action& action, const std::vector<std::string>& arguments, const symbolic::View& view) {
  std::vector<Parameter> open;
  for (std::size_t i = 0; i < arguments.size(); ++i)
    if (arguments[i].empty()) open.push_back(action.parameters[i]);
  symbolic::limit_instances(action.name, open, view, "skill " + action.skill);
}

}  // namespace

PlanStep resolve_step(const PlanStep& step, const Domain& domain, const FactTracker& facts) {
  const symbolic::View view{facts.facts(), domain, facts.objects()};
  std::vector<PlanStep> fitting;
  for (const Action& action : domain.actions) {
    if (action.name != step.action && action.skill != step.action) continue;
    std::vector<std::string> arguments = step.arguments;
    arguments.resize(action.parameters.size());
    const bool whole = std::none_of(arguments.begin(), arguments.end(), [](const auto& name) { return name.empty(); });
    limit_choices(action, arguments, view);
    complete(action, arguments, view, [&](const std::vector<std::string>& names) {
      if (whole || holds(action.precondition, facts.facts(), domain, facts.objects(), binding_of(action, names)))
        fitting.push_back({action.name, names});
    });
  }
  if (fitting.size() > 1)
    std::erase_if(fitting, [&](const PlanStep& candidate) {
      const Action* action = domain.action(candidate.action);
      return !holds(action->precondition, facts.facts(), domain, facts.objects(),
                    binding_of(*action, candidate.arguments));
    });
  if (fitting.size() == 1) return fitting.front();
  std::string candidates;
  for (const PlanStep& candidate : fitting) candidates += to_text(Plan{candidate}) + " ";
  throw Error("steps",
              fitting.empty() ? "no binding of '" + step.action + "' meets its precondition"
                              : "'" + step.action + "' is ambiguous: " + candidates,
              "name the missing parameters");
}

std::optional<PlanStep> random_step(const Domain& domain, const FactTracker& facts, bool applicable, RandomKey key) {
  const symbolic::View view{facts.facts(), domain, facts.objects()};
  Random random(key);
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(n)));
  };
  std::vector<const Action*> actions;
  for (const Action& action : domain.actions) actions.push_back(&action);
  while (!actions.empty()) {
    const std::size_t index = below(actions.size());
    const Action& action = *actions[index];
    actions.erase(actions.begin() + static_cast<std::ptrdiff_t>(index));
    std::vector<std::vector<std::string>> bindings;
    std::vector<std::string> arguments(action.parameters.size());
    limit_choices(action, arguments, view);
    complete(action, arguments, view, [&](const std::vector<std::string>& names) {
      if (!applicable || holds(action.precondition, facts.facts(), domain, facts.objects(), binding_of(action, names)))
        bindings.push_back(names);
    });
    if (!bindings.empty()) return PlanStep{action.name, bindings[below(bindings.size())]};
  }
  return std::nullopt;
}

}  // namespace stampede
