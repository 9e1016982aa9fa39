#include <algorithm>
#include <deque>
#include <optional>
#include <utility>

#include "engine/base/error.h"
#include "engine/symbolic/alike.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/search.h"

namespace stampede {

namespace {

constexpr std::int64_t kCrowdPatience = 20'000;   // expansions of the search without crowds
constexpr std::int64_t kPatience = 30'000;        // expansions of the greedy search before width search is tried
constexpr std::int64_t kWidthPatience = 400'000;  // states of that, before greedy search goes on to the limit
constexpr std::int64_t kSecondShare = 2;          // expansions of the second search, as a multiple of the first's
constexpr std::int64_t kSecondWork = 64'000'000;  // operators times expansions of it: bounds the time on large tasks

std::pair<std::int64_t, std::size_t> price(const symbolic::GroundTask& task, const std::vector<int>& plan) {
  std::int64_t cost = 0;
  for (const int op : plan) cost += task.operators[op].cost;
  return {cost, plan.size()};
}

// Greedy search first; what it has not solved by then is often a crowd that width search finds a way through.
symbolic::SearchResult find_plan(const symbolic::GroundTask& task, const symbolic::Semantics& semantics,
                                 symbolic::Heuristic& heuristic, const PlanLimits& limits,
                                 const symbolic::Query& query) {
  PlanLimits part = limits;
  symbolic::SearchResult result;
  const auto goes_on = [&](symbolic::SearchResult next) {
    next.expanded += result.expanded, next.evaluated += result.evaluated;
    result = std::move(next);
    return !result.solved && !result.exhausted && result.evaluated < limits.expansions;
  };
  part.expansions = std::min(limits.expansions, kPatience);
  if (!goes_on(lazy_search(task, semantics, heuristic, part, query))) return result;
  part.expansions = std::min(limits.expansions - result.evaluated, kWidthPatience);
  if (!goes_on(width_search(task, semantics, heuristic, part, query))) return result;
  part.expansions = limits.expansions - result.evaluated + kPatience;  // the first of which are those from above
  goes_on(lazy_search(task, semantics, heuristic, part, query));
  return result;
}

PlanOutcome solve_whole(const Domain& domain, const Problem& problem, const PlanLimits& limits,
                        const std::set<PlanStep>& forbidden) {
  using namespace symbolic;
  PlanOutcome outcome;
  GroundTask task;
  try {
    task = ground(lift(domain, problem), forbidden, limits.memory_bytes);
  } catch (const TooManyGround& error) {
    outcome.end = PlanEnd::memory_limit;
    outcome.explanation = error.message() + "\n    " + error.hint();
    return outcome;
  }
  if (task.out_of_memory) {
    outcome.end = PlanEnd::memory_limit;
    outcome.explanation = "more ground formulas and effects than the limit of " + std::to_string(limits.memory_bytes) +
                          " bytes has room for: " + task.fullest +
                          "\n    fewer variables, or narrower types of them, make fewer";
    return outcome;
  }
  if (!task.solvable()) {
    outcome.explanation = explain_unsolvable(task, {}, limits);
    return outcome;
  }
  const Semantics semantics(task);
  Heuristic heuristic(task);
  Landmarks landmarks(task, heuristic.relaxation(), semantics.initial());
  Query query{semantics.initial(), task.goal, 0, 0, &landmarks};
  SearchResult result = find_plan(task, semantics, heuristic, limits, query);
  outcome.expanded = result.expanded;
  outcome.evaluated = result.evaluated;
  outcome.solved = result.solved;
  if (!result.solved) {
    outcome.end = result.exhausted                        ? PlanEnd::unsolvable
                  : result.evaluated >= limits.expansions ? PlanEnd::expansion_limit
                                                          : PlanEnd::memory_limit;
    outcome.explanation = explain_unsolvable(task, result, limits);
    return outcome;
  }
  outcome.end = PlanEnd::solved;
  if (limits.improve > 0 && !result.plan.empty()) {  // two greedy searches seldom go wrong at the same place
    PlanLimits second = limits;
    const auto operators = static_cast<std::int64_t>(task.operators.size());
    second.expansions = std::min({limits.improve, kSecondShare * result.evaluated, kSecondWork / (operators + 100)});
    query.strict = true;
    SearchResult other = lazy_search(task, semantics, heuristic, second, query);
    if (other.solved && price(task, other.plan) < price(task, result.plan)) result.plan = std::move(other.plan);
  }
  for (const int op : shorten(task, semantics, heuristic, result.plan, limits.improve)) {
    outcome.plan.push_back(task.step(op));
    outcome.cost += task.operators[op].cost;
  }
  return outcome;
}

}  // namespace

std::string to_text(const Plan& plan) {
  std::string text;
  for (const PlanStep& step : plan) text += to_text(Fact{step.action, step.arguments}) + "\n";
  return text;
}

std::string to_text(PlanEnd end) {
  switch (end) {
    case PlanEnd::solved:
      return "solved";
    case PlanEnd::unsolvable:
      return "unsolvable (proved)";
    case PlanEnd::expansion_limit:
      return "gave up at the limit of expansions";
    case PlanEnd::memory_limit:
      return "gave up at the limit of memory";
    case PlanEnd::no_answer:
      return "the planner ended without an answer";
  }
  return {};
}

PlanOutcome solve(const Domain& domain, const Problem& problem, const PlanLimits& limits,
                  const std::set<PlanStep>& forbidden) {
  std::int64_t spent = 0;
  if (const std::optional<Problem> fewer = symbolic::without_crowds(domain, problem, forbidden)) {
    PlanLimits part = limits;
    part.expansions = std::min(limits.expansions, kCrowdPatience);
    PlanOutcome outcome = solve_whole(domain, *fewer, part, forbidden);
    if (outcome.solved && validate(domain, problem, outcome.plan).valid) return outcome;
    spent = outcome.evaluated;
  }
  PlanOutcome outcome = solve_whole(domain, problem, limits, forbidden);
  outcome.evaluated += spent;
  return outcome;
}

std::vector<Plan> solve_many(const Domain& domain, const Problem& problem, int k, const PlanLimits& limits) {
  constexpr std::int64_t kPriceOfTry = 100;  // grounding again is not free: bounds the tries where searches are short
  std::vector<Plan> found;
  std::set<Plan> known;                           // steps in alphabetical order
  std::set<std::set<PlanStep>> tried = {{}};      // forbidden sets
  std::deque<std::set<PlanStep>> waiting = {{}};  // the same, not yet looked at; fewest forbidden steps first
  PlanLimits left = limits;
  while (!waiting.empty() && static_cast<int>(found.size()) < k && left.expansions > 0) {
    const std::set<PlanStep> forbidden = std::move(waiting.front());
    waiting.pop_front();
    const PlanOutcome outcome = solve(domain, problem, left, forbidden);
    left.expansions -= outcome.evaluated + kPriceOfTry;
    if (!outcome.solved) continue;
    Plan sorted = outcome.plan;
    std::sort(sorted.begin(), sorted.end());
    if (!known.insert(sorted).second) continue;
    found.push_back(outcome.plan);
    sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());
    for (const PlanStep& step : sorted) {  // each plan that lacks one of these steps is another
      std::set<PlanStep> more = forbidden;
      more.insert(step);
      if (tried.insert(more).second) waiting.push_back(std::move(more));
    }
  }
  return found;
}

std::int64_t plan_cost(const Domain& domain, const Problem& problem, const Plan& plan) {
  std::int64_t sum = 0;
  for (const PlanStep& step : plan) {
    const Action* action = domain.action(step.action);
    const std::string place = to_text(Fact{step.action, step.arguments});
    if (action == nullptr) throw Error(place, "unknown action");
    if (action->cost_function.empty()) {
      sum += action->cost;
      continue;
    }
    Fact of{action->cost_function, {}};
    for (const Term& term : action->cost_terms) {
      std::string name = term.name;
      for (std::size_t i = 0; i < std::min(action->parameters.size(), step.arguments.size()); ++i) {
        if (term.variable && action->parameters[i].name == term.name) name = step.arguments[i];
      }
      of.arguments.push_back(name);
    }
    const auto value = problem.values.find(of);
    if (value == problem.values.end()) throw Error(place, "its cost " + to_text(of) + " has no value");
    sum += value->second;
  }
  return sum;
}

}  // namespace stampede
