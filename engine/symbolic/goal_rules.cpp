#include "engine/symbolic/goal_rules.h"

#include <algorithm>
#include <iterator>

namespace stampede::symbolic {

GoalRules::GoalRules(const Relaxation& relaxation) : relaxation_(relaxation) {
  achievers_.resize(static_cast<std::size_t>(relaxation_.nodes));
  for (std::size_t rule = 0; rule < relaxation_.rules.size(); ++rule) {
    const Relaxation::Rule& one = relaxation_.rules[rule];
    for (int i = one.begin; i < one.end; ++i) achievers_[relaxation_.effects[i]].push_back(static_cast<int>(rule));
  }
  find_stale();
}

// Picking up from where it was put: every action that puts it there held it before. Along such conditions the cheapest
// relaxed plan never runs, so leaving them out changes no value, and on tables with many objects leaves little to do.
void GoalRules::find_stale() {
  const std::vector<int>& conditions = relaxation_.conditions;
  std::vector<std::vector<int>> shared(static_cast<std::size_t>(relaxation_.nodes));
  for (std::size_t node = 0; node < shared.size(); ++node) {
    bool is_first = true;
    std::vector<int> both;
    for (const int achiever : achievers_[node]) {
      const Relaxation::Rule& rule = relaxation_.rules[achiever];
      const auto begin = conditions.begin() + rule.conditions_begin, end = conditions.begin() + rule.conditions_end;
      both.clear();
      if (is_first) {
        both.assign(begin, end);
      } else {
        std::set_intersection(shared[node].begin(), shared[node].end(), begin, end, std::back_inserter(both));
      }
      is_first = false;
      shared[node] = both;
      if (both.empty()) break;
    }
  }
  is_stale_.assign(conditions.size(), 0);
  for (const Relaxation::Rule& rule : relaxation_.rules) {
    for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
      const std::vector<int>& had = shared[conditions[i]];
      is_stale_[i] = std::all_of(relaxation_.effects.begin() + rule.begin, relaxation_.effects.begin() + rule.end,
                                 [&](int effect) { return std::find(had.begin(), had.end(), effect) != had.end(); });
    }
  }
}

std::vector<char> GoalRules::relevant_rules(const std::vector<int>& goal, std::vector<char>& relevant_nodes) const {
  std::vector<char> relevant(relaxation_.rules.size(), 0);
  std::vector<int> stack;
  const auto push = [&](int node) {
    if (!relevant_nodes[node]) stack.push_back(node);
    relevant_nodes[node] = 1;
  };
  for (const int node : goal) push(node);
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (const int achiever : achievers_[node]) {
      if (relevant[achiever]) continue;
      relevant[achiever] = 1;
      const Relaxation::Rule& rule = relaxation_.rules[achiever];
      for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
        if (!is_stale_[i]) push(relaxation_.conditions[i]);
      }
    }
  }
  return relevant;
}

void GoalRules::set_goal(const std::vector<int>& goal) {
  std::vector<char> relevant_nodes(static_cast<std::size_t>(relaxation_.nodes), 0);
  const std::vector<char> relevant = relevant_rules(goal, relevant_nodes);
  number_of.clear();
  effects_begin.clear();
  effects.clear();
  unconditional.clear();
  untouched.clear();
  costly = 0;
  for (std::size_t rule = 0; rule < relevant.size(); ++rule) {
    if (!relevant[rule]) continue;
    const Relaxation::Rule& one = relaxation_.rules[rule];
    if (static_cast<int>(rule) < relaxation_.costly) ++costly;
    untouched.push_back({one.conditions_end - one.conditions_begin, 0});
    if (untouched.back().open == 0) unconditional.push_back(static_cast<int>(number_of.size()));
    number_of.push_back(static_cast<int>(rule));
    effects_begin.push_back(static_cast<int>(effects.size()));
    for (int i = one.begin; i < one.end; ++i) {
      if (relevant_nodes[relaxation_.effects[i]]) effects.push_back(relaxation_.effects[i]);
    }
  }
  effects_begin.push_back(static_cast<int>(effects.size()));
  index_uses();
}

void GoalRules::index_uses() {
  const std::size_t nodes = static_cast<std::size_t>(relaxation_.nodes);
  std::vector<int> fresh(nodes, 0);
  used_begin.assign(nodes + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t rule = 0; rule < number_of.size(); ++rule) {
      const Relaxation::Rule& one = relaxation_.rules[number_of[rule]];
      for (int i = one.conditions_begin; i < one.conditions_end; ++i) {
        visit(static_cast<int>(rule), relaxation_.conditions[i], is_stale_[i] != 0);
      }
    }
  };
  each([&](int, int node, bool is_stale) {
    ++used_begin[node + 1];
    if (!is_stale) ++fresh[node];
  });
  for (std::size_t node = 0; node < nodes; ++node) used_begin[node + 1] += used_begin[node];
  used_middle.resize(nodes);
  for (std::size_t node = 0; node < nodes; ++node) used_middle[node] = used_begin[node] + fresh[node];
  used.resize(static_cast<std::size_t>(used_begin.back()));
  std::vector<int> front(used_begin.begin(), used_begin.end() - 1), back = used_middle;
  each([&](int rule, int node, bool is_stale) { used[(is_stale ? back : front)[node]++] = rule; });
}

}  // namespace stampede::symbolic
