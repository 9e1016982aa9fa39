#include "engine/rollout/assumptions.h"

#include <algorithm>
#include <map>

namespace stampede {
namespace {

constexpr std::size_t kMostGuesses = 64;  // of all things together, before there is no plan

// Drawn orders: of things, and of what may be so of each.
std::vector<std::vector<Fact>> by_thing(const Facts& conceivable, RandomKey key) {
  std::vector<Fact> drawn(conceivable.begin(), conceivable.end());
  Random(key).shuffle(drawn);
  std::vector<std::vector<Fact>> groups;
  for (Fact& fact : drawn) {
    const auto own = std::find_if(groups.begin(), groups.end(), [&](const std::vector<Fact>& group) {
      return group.front().arguments.front() == fact.arguments.front();
    });
    (own == groups.end() ? groups.emplace_back() : *own).push_back(std::move(fact));
  }
  return groups;
}

// Guess `number` counts through the groups as a clock's hands go round; empty: all have been made.
Facts guess(const std::vector<std::vector<Fact>>& groups, std::size_t number) {
  Facts facts;
  for (const std::vector<Fact>& group : groups) {
    facts.insert(group[number % group.size()]);
    number /= group.size();
  }
  return number == 0 ? facts : Facts{};
}

Facts needed(PlanningTask planning, const Plan& plan, Facts assumed) {
  for (const Fact& fact : Facts(assumed)) {
    planning.problem.init.erase(fact);
    if (validate(planning.domain, planning.problem, plan).valid)
      assumed.erase(fact);
    else
      planning.problem.init.insert(fact);
  }
  return assumed;
}

// Things of which something is known that could change, and what that is.
std::map<std::string, Fact> placed_by(const FactTracker& facts) {
  std::map<std::string, Fact> placed;
  for (const Fact& fact : facts.known_basic()) {
    const Predicate* predicate = facts.domain().predicate(fact.predicate);
    if (predicate == nullptr || predicate->kind != PredicateKind::basic) continue;
    for (const std::string& thing : fact.arguments) placed.emplace(thing, fact);
  }
  return placed;
}

}  // namespace

Facts conceivable(const FactTracker& facts) {
  const std::map<std::string, Fact> placed = placed_by(facts);
  Facts found;
  for (Fact& fact : facts.never_seen())
    if (!fact.arguments.empty() && !placed.contains(fact.arguments.front())) found.insert(std::move(fact));
  return found;
}

std::vector<NotAssumed> not_assumed(const FactTracker& facts) {
  const std::map<std::string, Fact> placed = placed_by(facts);
  std::vector<NotAssumed> found;
  for (Fact& fact : facts.never_seen()) {
    const auto known = fact.arguments.empty() ? placed.end() : placed.find(fact.arguments.front());
    if (known != placed.end()) found.push_back({std::move(fact), known->second});
  }
  return found;
}

std::string why_not_assumed(const std::vector<NotAssumed>& facts, const std::string& explanation) {
  std::string text;
  std::set<std::string> told;
  for (const auto& [fact, known] : facts) {
    const std::string missed = "(" + fact.predicate + " " + fact.arguments.front();
    if (explanation.find(missed) == std::string::npos || !told.insert(missed).second) continue;
    text += "; nobody can see whether " + to_text(fact) + ", but it is not assumed, for " + to_text(known) +
            " is known of '" + fact.arguments.front() +
            "': where nobody can see that either, the task says so in `observable`";
  }
  return text;
}

void keep_known(Problem& problem, const FactTracker& facts, const Facts& assumed) {
  Facts& init = problem.init;
  const Facts known = facts.known_basic(), possible = conceivable(facts);
  for (const Fact& fact : facts.basic())
    if (!known.contains(fact)) init.erase(fact);
  init.insert(known.begin(), known.end());
  std::set_intersection(assumed.begin(), assumed.end(), possible.begin(), possible.end(),
                        std::inserter(init, init.end()));
}

AssumingPlan plan_assuming(const PlanningTask& known, const Facts& conceivable, RandomKey key,
                           const std::function<PlanOutcome(const PlanningTask&)>& planner) {
  PlanOutcome outcome = planner(known);
  if (outcome.solved || conceivable.empty()) return {std::move(outcome), {}};
  const std::vector<std::vector<Fact>> groups = by_thing(conceivable, key);
  for (std::size_t number = 0; number < kMostGuesses; ++number) {
    const Facts assumed = guess(groups, number);
    if (assumed.empty()) break;
    PlanningTask planning = known;
    planning.problem.init.insert(assumed.begin(), assumed.end());
    PlanOutcome found = planner(planning);
    if (!found.solved) continue;
    Facts rests_on = needed(std::move(planning), found.plan, assumed);
    return {std::move(found), std::move(rests_on)};
  }
  return {std::move(outcome), {}};
}

}  // namespace stampede
