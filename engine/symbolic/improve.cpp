#include <algorithm>

#include "engine/symbolic/search.h"

namespace stampede::symbolic {
namespace {

constexpr std::int64_t kWindowExpansions = 25;
constexpr std::int64_t kWholeExpansions = 400;
constexpr std::int64_t kWindowWork = 4'000'000;  // operators times expansions: bounds the time on large tasks

std::int64_t total(const GroundTask& task, const std::vector<int>& plan) {
  std::int64_t sum = 0;
  for (const int op : plan) sum += cost_of(task, op);
  return sum;
}

// The plan without step `drop` and without all later steps that then cannot be taken; empty-handed if the goal fails.
bool without(const GroundTask& task, const Semantics& semantics, const std::vector<int>& plan, std::size_t drop,
             Words state, std::vector<int>& rest) {
  rest.assign(plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(drop));
  Words next;
  for (std::size_t i = drop + 1; i < plan.size(); ++i) {
    if (!semantics.applicable(state, plan[i])) continue;
    semantics.apply(state, plan[i], next);
    state.swap(next);
    rest.push_back(plan[i]);
  }
  return semantics.is_goal(state) && total(task, rest) <= total(task, plan);
}

// Action elimination: Nakhost, Müller, ICAPS 2010.
std::vector<int> eliminate(const GroundTask& task, const Semantics& semantics, std::vector<int> plan) {
  Words state = semantics.initial(), next;
  std::vector<int> rest;
  for (std::size_t i = 0; i < plan.size();) {
    if (without(task, semantics, plan, i, state, rest)) {
      plan = rest;
      continue;
    }
    semantics.apply(state, plan[i], next);
    state.swap(next);
    ++i;
  }
  return plan;
}

// What must hold before each step so that the rest of the plan works and ends in the goal. Exact only without
// conditional effects and axioms.
std::vector<Literals> needed_before(const GroundTask& task, const std::vector<int>& plan) {
  std::vector<Literals> needed(plan.size() + 1);
  needed.back() = task.goal;
  for (std::size_t i = plan.size(); i-- > 0;) {
    const Operator& op = task.operators[plan[i]];
    Literals before = op.precondition;
    for (const Literal one : needed[i + 1]) {
      if (!std::binary_search(op.effects.begin(), op.effects.end(), one)) before.push_back(one);
    }
    std::sort(before.begin(), before.end());
    before.erase(std::unique(before.begin(), before.end()), before.end());
    needed[i] = std::move(before);
  }
  return needed;
}

// One pass of windows of `length` steps over the plan; true if some window became cheaper.
bool shorten_windows(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic, std::size_t length,
                     std::int64_t& budget, std::vector<int>& plan) {
  bool better = false;
  Words state = semantics.initial(), next;
  std::vector<Literals> needed = needed_before(task, plan);
  for (std::size_t i = 0; i < plan.size() && budget > 0; ++i) {
    const std::size_t end = std::min(plan.size(), i + length);
    PlanLimits limits;
    limits.expansions = std::min(budget, kWindowExpansions);
    heuristic.set_goal(needed[end]);
    const SearchResult found =
        lazy_search(task, semantics, heuristic, limits, {state, needed[end], 1, static_cast<int>(end - i)});
    budget -= found.evaluated;
    const auto from = plan.begin() + static_cast<std::ptrdiff_t>(i),
               to = plan.begin() + static_cast<std::ptrdiff_t>(end);
    if (found.solved && total(task, found.plan) < total(task, {from, to})) {
      plan.insert(plan.erase(from, to), found.plan.begin(), found.plan.end());
      needed = needed_before(task, plan);
      better = true;
    }
    if (i >= plan.size()) break;
    semantics.apply(state, plan[i], next);
    state.swap(next);
  }
  heuristic.set_goal(task.goal);
  return better;
}

// Searches for the whole plan again, each time for a shorter one: for tasks whose stretches cannot be replaced because
// what they need to achieve cannot be regressed (axioms, conditional effects).
std::vector<int> search_again(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                              std::int64_t budget, std::vector<int> plan) {
  for (const int weight : {3, 1}) {
    while (budget > 0) {
      PlanLimits limits;
      limits.expansions = budget;
      const SearchResult found = lazy_search(task, semantics, heuristic, limits,
                                             {semantics.initial(), task.goal, weight, static_cast<int>(plan.size())});
      budget -= found.evaluated;
      if (!found.solved || total(task, found.plan) >= total(task, plan)) break;
      plan = eliminate(task, semantics, found.plan);
    }
  }
  return plan;
}

}  // namespace

std::vector<int> shorten(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         std::vector<int> plan, std::int64_t expansions) {
  if (expansions <= 0) return plan;
  plan = eliminate(task, semantics, std::move(plan));
  const bool regresses = task.axioms.empty() && std::all_of(task.operators.begin(), task.operators.end(),
                                                            [](const Operator& op) { return op.conditional.empty(); });
  std::int64_t budget =
      std::min<std::int64_t>(expansions, kWindowWork / static_cast<std::int64_t>(task.operators.size() + 100));
  if (!regresses) return search_again(task, semantics, heuristic, std::min(budget, kWholeExpansions), std::move(plan));
  for (const std::size_t length : {8, 16}) {
    if (shorten_windows(task, semantics, heuristic, length, budget, plan)) {
      plan = eliminate(task, semantics, std::move(plan));
    }
  }
  return plan;
}

}  // namespace stampede::symbolic
