#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/ground.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

// Grows from the goal: names that matter, until nothing more does.
class Relevance {
 public:
  Relevance(const Domain& domain, std::set<std::string> reachable)
      : domain_(domain), reachable_(std::move(reachable)) {}

  Domain run(const Problem& problem) {
    note(problem.goal);
    for (std::size_t before = 0; before != used_.size() + actions_.size();) {
      before = used_.size() + actions_.size();
      for (const Predicate& predicate : domain_.predicates) {
        if (!used_.contains(predicate.name)) continue;
        note(predicate.parameters);
        note(predicate.derived);
      }
      for (const Action& action : domain_.actions) {
        if (reachable_.contains(action.name) && bears(action)) note(action);
      }
    }
    return cut(problem);
  }

 private:
  void note(const std::vector<Parameter>& parameters) {
    for (const Parameter& one : parameters) {
      if (!one.type.empty()) types_.insert(one.type);
      used_.insert(one.traits.begin(), one.traits.end());
    }
  }

  void note(const Formula& formula) {
    if (formula.kind == Formula::Kind::atom) used_.insert(formula.predicate);
    note(formula.variables);
    for (const Formula& part : formula.parts) note(part);
  }

  void note(const Action& action) {
    if (!actions_.insert(action.name).second) return;
    note(action.parameters);
    note(action.precondition);
    if (!action.cost_function.empty()) functions_.insert(action.cost_function);
    for (const Effect& effect : action.effects) {
      note(effect.forall);
      note(effect.when);
      used_.insert(effect.predicate);
    }
  }

  bool bears(const Action& action) const {
    return std::any_of(action.effects.begin(), action.effects.end(),
                       [&](const Effect& effect) { return used_.contains(effect.predicate); });
  }

  Domain cut(const Problem& problem) {
    Domain result = domain_;
    std::erase_if(result.actions, [&](const Action& one) { return !actions_.contains(one.name); });
    std::erase_if(result.predicates, [&](const Predicate& one) { return !used_.contains(one.name); });
    std::erase_if(result.traits, [&](const std::string& one) { return !used_.contains(one); });
    std::erase_if(result.functions, [&](const Predicate& one) { return !functions_.contains(one.name); });
    for (const Predicate& one : result.functions) note(one.parameters);
    for (const TypedObject& one : symbolic::all_objects(domain_, problem.objects)) types_.insert(one.type);
    std::set<std::string> kept;
    for (std::string at : types_) {
      while (result.types.contains(at) && kept.insert(at).second) at = result.types.at(at);
    }
    std::erase_if(result.types, [&](const auto& one) { return !kept.contains(one.first); });
    return result;  // the constants stay: every problem of the domain has them
  }

  const Domain& domain_;
  std::set<std::string> reachable_, used_, types_, actions_, functions_;
};

}  // namespace

Domain named_by_content(Domain domain) {
  domain.name = "stampede";
  domain.name += "-" + content_hash(to_pddl(domain)).substr(0, 16);
  return domain;
}

Domain task_sized(const Domain& domain, const Problem& problem) {
  const symbolic::GroundTask task = symbolic::ground(symbolic::lift(domain, problem), {});
  if (task.out_of_memory) {
    throw Error("problem " + problem.name, "too large to find what it needs of its domain: " + task.fullest,
                "fewer variables, or narrower types of them, make fewer");
  }
  std::set<std::string> reachable;
  for (std::size_t i = 0; i < task.operators.size(); ++i) reachable.insert(task.step(static_cast<int>(i)).action);
  return Relevance(domain, std::move(reachable)).run(problem);
}

Problem restricted(Problem problem, const Domain& domain) {
  std::set<std::string> known(domain.traits.begin(), domain.traits.end());
  for (const Predicate& one : domain.predicates) known.insert(one.name);
  std::erase_if(problem.init, [&](const Fact& fact) { return !known.contains(fact.predicate); });
  std::set<std::string> functions;
  for (const Predicate& one : domain.functions) functions.insert(one.name);
  std::erase_if(problem.values, [&](const auto& one) { return !functions.contains(one.first.predicate); });
  return problem;
}

}  // namespace stampede
