#include "engine/symbolic/drawn_choice.h"

#include <algorithm>

namespace stampede {
namespace {

using Renaming = std::map<std::string, std::string>;

const std::string& renamed(const Renaming& names, const std::string& name) {
  const auto found = names.find(name);
  return found == names.end() ? name : found->second;
}

void put_names(std::vector<std::string>& arguments, const Renaming& names) {
  for (std::string& argument : arguments) argument = renamed(names, argument);
}

void put_names(Formula& formula, const Renaming& names) {
  for (Term& term : formula.terms)
    if (!term.variable) term.name = renamed(names, term.name);
  for (Formula& part : formula.parts) put_names(part, names);
}

// Groups of objects of which the same is known: each fact about one, with a blank for its own name.
std::vector<std::vector<std::string>> equals(const Domain& domain, const Problem& problem) {
  std::map<std::string, std::string> types;
  for (const TypedObject& object : problem.objects) types[object.name] = object.type;
  for (const TypedObject& constant : domain.constants) types.erase(constant.name);
  std::map<std::string, std::set<std::string>> known;
  for (const Fact& fact : problem.init)
    for (const std::string& name : fact.arguments) {
      if (!types.contains(name)) continue;
      Fact blank = fact;
      for (std::string& argument : blank.arguments)
        if (argument == name) argument.clear();
      known[name].insert(to_text(blank));
    }
  std::map<std::pair<std::string, std::set<std::string>>, std::vector<std::string>> groups;
  for (const auto& [name, type] : types) groups[{type, known[name]}].push_back(name);
  std::vector<std::vector<std::string>> result;
  for (auto& [unused, names] : groups)
    if (names.size() > 1) result.push_back(std::move(names));
  return result;
}

Problem with_names(Problem problem, const Renaming& names) {
  Facts init;
  for (Fact fact : problem.init) {
    put_names(fact.arguments, names);
    init.insert(std::move(fact));
  }
  problem.init = std::move(init);
  std::map<Fact, int> values;
  for (const auto& [of, value] : problem.values) {
    Fact fact = of;
    put_names(fact.arguments, names);
    values.emplace(std::move(fact), value);
  }
  problem.values = std::move(values);
  put_names(problem.goal, names);
  return problem;  // the objects are the same: names moved among equal types
}

}  // namespace

PlanOutcome solve_drawn(const Domain& domain, const Problem& problem, const std::set<PlanStep>& forbidden,
                        RandomKey key) {
  Renaming there, back;
  std::int64_t number = 0;
  for (const std::vector<std::string>& group : equals(domain, problem)) {
    std::vector<std::string> drawn = group;
    Random(key.with(number++)).shuffle(drawn);
    for (std::size_t i = 0; i < group.size(); ++i) there[group[i]] = drawn[i], back[drawn[i]] = group[i];
  }
  if (there.empty()) return solve(domain, problem, {}, forbidden);
  std::set<PlanStep> kept_out;
  for (PlanStep step : forbidden) {
    put_names(step.arguments, there);
    kept_out.insert(std::move(step));
  }
  PlanOutcome outcome = solve(domain, with_names(problem, there), {}, kept_out);
  if (!outcome.solved) return solve(domain, problem, {}, forbidden);  // its explanation names things as they are
  for (PlanStep& step : outcome.plan) put_names(step.arguments, back);
  return outcome;
}

}  // namespace stampede
