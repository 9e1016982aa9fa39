#include "engine/symbolic/alike.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace stampede::symbolic {
namespace {

constexpr std::size_t kCrowd = 6;  // objects alike; fewer all stay
constexpr std::size_t kStay = 2;   // of each crowd
constexpr int kRounds = 4;         // what is told apart only by then may count as alike: plans are validated

struct Mentioned {
  std::set<std::string> predicates, objects;

  void add(const std::vector<Term>& terms) {
    for (const Term& term : terms)
      if (!term.variable) objects.insert(term.name);
  }
  void add(const Formula& formula) {
    if (formula.kind == Formula::Kind::atom) predicates.insert(formula.predicate);
    add(formula.terms);
    for (const Formula& part : formula.parts) add(part);
    add(formula.variables);
  }
  void add(const std::vector<Parameter>& parameters) {
    for (const Parameter& parameter : parameters) predicates.insert(parameter.traits.begin(), parameter.traits.end());
  }
};

// Effects alone tell nobody apart: only what is asked does.
Mentioned mentioned_by(const Domain& domain, const Problem& problem, const std::set<PlanStep>& forbidden) {
  Mentioned found;
  found.add(problem.goal);
  for (const Predicate& predicate : domain.predicates)
    if (predicate.kind == PredicateKind::derived) found.add(predicate.derived);
  for (const Action& action : domain.actions) {
    found.add(action.parameters);
    found.add(action.precondition);
    found.add(action.cost_terms);
    for (const Effect& effect : action.effects) {
      found.add(effect.forall);
      found.add(effect.when);
      found.add(effect.terms);
    }
  }
  for (const TypedObject& constant : domain.constants) found.objects.insert(constant.name);
  for (const PlanStep& step : forbidden) found.objects.insert(step.arguments.begin(), step.arguments.end());
  return found;
}

// A fact or value as one of its objects sees it: which, at which place, and the colours of all.
using Sight = std::vector<int>;

class Colours {
 public:
  Colours(const Problem& problem, const Mentioned& mentioned) {
    std::map<std::pair<std::string, std::string>, int> first;  // by type and, of who is named, name
    for (const TypedObject& object : problem.objects) {
      const bool named = mentioned.objects.contains(object.name);
      const auto key = std::pair(object.type, named ? object.name : "");
      number_[object.name] = static_cast<int>(colour_.size());
      colour_.push_back(first.emplace(key, static_cast<int>(first.size())).first->second);
    }
    count_ = first.size();
    std::map<std::string, int> kinds;
    const auto add = [&](const std::string& name, const Fact& fact) {
      const int kind = kinds.emplace(name, static_cast<int>(kinds.size())).first->second;
      std::vector<int> arguments;
      for (const std::string& argument : fact.arguments) arguments.push_back(number_.at(argument));
      facts_.emplace_back(kind, std::move(arguments));
    };
    for (const Fact& fact : problem.init)
      if (mentioned.predicates.contains(fact.predicate)) add(fact.predicate, fact);
    for (const auto& [fact, value] : problem.values) add(fact.predicate + "=" + std::to_string(value), fact);
    for (int round = 0; round < kRounds && refine(); ++round) {
    }
  }

  int of(const std::string& object) const { return colour_[static_cast<std::size_t>(number_.at(object))]; }

 private:
  bool refine() {
    std::vector<std::vector<Sight>> sights(colour_.size());
    for (const auto& [kind, arguments] : facts_) {
      Sight sight = {kind, 0};
      for (const int argument : arguments) sight.push_back(colour_[static_cast<std::size_t>(argument)]);
      for (std::size_t place = 0; place < arguments.size(); ++place) {
        sight[1] = static_cast<int>(place);
        sights[static_cast<std::size_t>(arguments[place])].push_back(sight);
      }
    }
    std::map<std::pair<int, std::vector<Sight>>, int> finer;
    std::vector<int> colour;
    for (std::size_t i = 0; i < sights.size(); ++i) {
      std::sort(sights[i].begin(), sights[i].end());
      const auto key = std::pair(colour_[i], std::move(sights[i]));
      colour.push_back(finer.emplace(key, static_cast<int>(finer.size())).first->second);
    }
    colour_ = std::move(colour);
    return finer.size() > std::exchange(count_, finer.size());
  }

  std::map<std::string, int> number_;
  std::vector<int> colour_;
  std::size_t count_ = 0;
  std::vector<std::pair<int, std::vector<int>>> facts_;
};

}  // namespace

std::optional<Problem> without_crowds(const Domain& domain, const Problem& problem,
                                      const std::set<PlanStep>& forbidden) {
  if (problem.objects.size() < kCrowd) return std::nullopt;
  const Mentioned mentioned = mentioned_by(domain, problem, forbidden);
  const Colours colours(problem, mentioned);
  std::map<int, std::vector<std::string>> alike;
  for (const TypedObject& object : problem.objects) alike[colours.of(object.name)].push_back(object.name);
  std::set<std::string> gone;
  for (const auto& [colour, names] : alike)
    if (names.size() >= kCrowd) gone.insert(names.begin() + kStay, names.end());
  if (gone.empty()) return std::nullopt;
  const auto stays = [&](const Fact& fact) {
    return std::none_of(fact.arguments.begin(), fact.arguments.end(),
                        [&](const std::string& name) { return gone.contains(name); });
  };
  Problem rest{problem.name, {}, {}, problem.goal, {}};
  for (const TypedObject& object : problem.objects)
    if (!gone.contains(object.name)) rest.objects.push_back(object);
  for (const Fact& fact : problem.init)
    if (stays(fact)) rest.init.insert(rest.init.end(), fact);
  for (const auto& [fact, value] : problem.values)
    if (stays(fact)) rest.values.emplace(fact, value);
  return rest;
}

}  // namespace stampede::symbolic
