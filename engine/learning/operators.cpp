#include "engine/learning/operators.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/error.h"
#include "engine/learning/clusters.h"
#include "engine/learning/literals.h"

namespace stampede::learning {
namespace {

std::string slot_name(std::size_t slot, std::size_t arguments) {
  return slot < arguments ? "a" + std::to_string(slot + 1) : "x" + std::to_string(slot - arguments + 1);
}

Formula formula_of(const LiftedAtom& lifted, std::size_t arguments) {
  std::vector<Term> terms;
  for (const int slot : lifted.slots) terms.push_back({true, slot_name(static_cast<std::size_t>(slot), arguments)});
  return atom(lifted.predicate, std::move(terms));
}

Effect effect_of(const LiftedAtom& lifted, std::size_t arguments, bool negated) {
  Formula one = formula_of(lifted, arguments);
  return {{}, {}, std::move(one.predicate), std::move(one.terms), negated};
}

// Names: the skill's, with a number where it has cases; op1 … without a skill.
void name_actions(const std::vector<Cluster>& clusters, std::vector<Action>& actions) {
  std::map<std::string, int> cases, counted;
  for (const Cluster& one : clusters) ++cases[one.skill];
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const std::string& skill = clusters[i].skill;
    const std::string number = std::to_string(++counted[skill]);
    actions[i].name = skill.empty() ? "op" + number : cases[skill] > 1 ? skill + "_" + number : skill;
    if (skill.empty()) actions[i].skill = actions[i].name;
    if (cases[skill] > 1 && !skill.empty()) actions[i].case_name = number;
  }
}

std::vector<Predicate> predicates_of(const Experience& experience) {
  std::map<std::string, std::size_t> arities;
  for (const Transition& one : experience.transitions)
    for (const Facts* facts : {&one.before, &one.after})
      for (const Fact& fact : *facts) arities[fact.predicate] = fact.arguments.size();
  std::vector<Predicate> predicates;
  for (const auto& [name, arity] : arities) {
    Predicate predicate{name, {}, PredicateKind::basic, {}, {}};
    for (std::size_t i = 0; i < arity; ++i) predicate.parameters.push_back({"x" + std::to_string(i + 1), "object", {}});
    predicates.push_back(std::move(predicate));
  }
  return predicates;
}

void check(const Experience& experience) {
  std::map<std::string, std::size_t> arities;
  for (const Transition& one : experience.transitions) {
    if (one.skill.empty()) continue;
    const auto [known, fresh] = arities.insert({one.skill, one.arguments.size()});
    if (!fresh && known->second != one.arguments.size())
      throw Error("transitions of " + one.skill,
                  "have " + std::to_string(known->second) + " arguments and " + std::to_string(one.arguments.size()),
                  "give all calls of a skill the same arguments");
  }
  if (experience.transitions.empty())
    throw Error("transitions", "there are none", "name a catalogue or data set with skills in it");
}

}  // namespace

Action action_of(const Cluster& cluster, const Experience& experience, const LearningOptions& options) {
  Action action;
  action.skill = cluster.skill;
  const std::vector<std::string> types = slot_types(cluster, experience.types);
  for (std::size_t slot = 0; slot < types.size(); ++slot)
    action.parameters.push_back({slot_name(slot, cluster.arguments), types[slot], {}});
  std::vector<Formula> conditions;
  for (const LiftedAtom& one : preconditions(cluster, options.tolerance))
    conditions.push_back(formula_of(one, cluster.arguments));
  for (const LiftedAtom& one : cluster.denied) conditions.push_back(negation(formula_of(one, cluster.arguments)));
  action.precondition = conjunction(std::move(conditions));
  for (const LiftedAtom& one : cluster.added) action.effects.push_back(effect_of(one, cluster.arguments, false));
  for (const LiftedAtom& one : cluster.removed) action.effects.push_back(effect_of(one, cluster.arguments, true));
  return action;
}

LearnedOperators learn_operators(const Experience& experience, const LearningOptions& options) {
  check(experience);
  LearnedOperators learned;
  std::vector<Cluster> clusters = cluster_by_effects(experience, options);
  learned.transitions = static_cast<int>(std::count_if(experience.transitions.begin(), experience.transitions.end(),
                                                       [](const Transition& one) { return one.success; }));
  learned.unused = learned.transitions;
  const std::set<std::string> changing = changing_predicates(experience);
  for (Cluster& one : clusters) {
    learned.unused -= static_cast<int>(one.members.size());
    if (one.skill.empty()) add_only_ones(one, changing, options.tolerance);
  }
  deny_what_is_made(experience, clusters, options);
  deny_what_failed(experience, clusters, options, learned);

  std::vector<Action> actions;
  for (const Cluster& one : clusters) actions.push_back(action_of(one, experience, options));
  name_actions(clusters, actions);
  std::vector<std::size_t> order(actions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return actions[a].name < actions[b].name; });
  learned.domain.name = "learned";
  learned.domain.types = experience.types;
  learned.domain.predicates = predicates_of(experience);
  for (const std::size_t i : order) {
    learned.domain.actions.push_back(actions[i]);
    learned.seen.push_back(static_cast<int>(clusters[i].members.size()));
  }
  return learned;
}

std::string like_action(const Transition& transition, const Domain& learned) {
  const LiftedChange change = lifted_change(transition.before, transition.after, {}, LearningOptions{}.further);
  if (change.orders.empty()) return {};
  for (const Action& action : learned.actions) {
    const ActionLiterals literals = literals_of(action);
    Facts added, removed;  // places as objects, so that they get the same order
    for (const LiftedLiteral& one : literals.effect) {
      Fact fact{one.atom.predicate, {}};
      for (const int slot : one.atom.slots)
        fact.arguments.push_back(action.parameters[static_cast<std::size_t>(slot)].name);
      (one.negated ? removed : added).insert(std::move(fact));
    }
    const LiftedChange its = lifted_change(removed, added, {}, LearningOptions{}.further);
    if (its.added == change.added && its.removed == change.removed) return action.name;
  }
  return {};
}

}  // namespace stampede::learning
