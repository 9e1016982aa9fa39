#include <algorithm>

#include "engine/symbolic/search.h"

namespace stampede::symbolic {
namespace {

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

}  // namespace

std::vector<int> shorten(const GroundTask& task, const Semantics& semantics, std::vector<int> plan,
                         std::int64_t expansions) {
  if (expansions <= 0) return plan;
  return eliminate(task, semantics, std::move(plan));
}

}  // namespace stampede::symbolic
