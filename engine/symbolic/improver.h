// One plan being made cheaper; each member is one way to do so. Not for use outside improve.cpp and postpone.cpp.
#pragma once

#include <utility>
#include <vector>

#include "engine/symbolic/search.h"

namespace stampede::symbolic {

// What plans are compared by.
using Price = std::pair<std::int64_t, std::size_t>;  // cost, steps

struct Improver {
  const GroundTask& task;
  const Semantics& semantics;
  Heuristic& heuristic;
  std::vector<int> costs;  // by operator, scaled; empty: all equal
  std::int64_t budget = 0;

  Price price(std::vector<int>::const_iterator from, std::vector<int>::const_iterator to) const {
    Price sum{0, static_cast<std::size_t>(to - from)};
    for (; from != to; ++from) sum.first += task.operators[*from].cost;
    return sum;
  }
  Price price(const std::vector<int>& plan) const { return price(plan.begin(), plan.end()); }

  int search_cost(std::vector<int>::const_iterator from, std::vector<int>::const_iterator to) const {
    if (costs.empty()) return static_cast<int>(to - from);
    int sum = 0;
    for (; from != to; ++from) sum += costs[*from];
    return sum;
  }

  bool works(const std::vector<int>& plan) const {
    Words state = semantics.initial(), next;
    for (const int op : plan) {
      if (!semantics.applicable(state, op)) return false;
      semantics.apply(state, op, next);
      state.swap(next);
    }
    return semantics.is_goal(state);
  }

  bool without(const std::vector<int>& plan, std::size_t drop, Words state, std::vector<int>& rest) const;
  std::vector<int> eliminate(std::vector<int> plan) const;
  std::vector<Literals> needed_before(const std::vector<int>& plan) const;
  SearchResult search_window(const Words& from, const Literals& goal, int bound);
  bool shorten_windows(std::size_t length, std::vector<int>& plan);
  bool finish_last(std::size_t count, std::vector<int>& plan);
  bool postpone(std::size_t count, std::vector<int>& plan);
  void search_again(std::int64_t expansions, std::vector<int>& plan);
};

}  // namespace stampede::symbolic
