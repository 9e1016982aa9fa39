#include "engine/symbolic/axioms.h"

#include <algorithm>
#include <bit>

#include "engine/symbolic/state.h"

namespace stampede::symbolic {

Axioms::Axioms(const GroundTask& task) : task_(task) {
  if (task.axioms.empty()) return;
  const std::size_t derived = static_cast<std::size_t>(task.facts - task.basic);
  head_begin_.assign(derived + 1, 0);
  for (const Axiom& axiom : task.axioms) ++head_begin_[axiom.head - task.basic + 1];
  for (std::size_t i = 0; i < derived; ++i) head_begin_[i + 1] += head_begin_[i];
  of_head_.resize(task.axioms.size());
  std::vector<int> at(head_begin_.begin(), head_begin_.end() - 1);
  for (std::size_t i = 0; i < task.axioms.size(); ++i) {
    of_head_[at[task.axioms[i].head - task.basic]++] = static_cast<int>(i);
  }
  find_components();
  index();
  dirty_.assign((components_.size() + 63) / 64, 0);
  open_.assign(task.axioms.size(), 0);
}

// By derived fact: the derived facts in its conditions.
std::vector<std::vector<int>> Axioms::derived_from() const {
  std::vector<std::vector<int>> below(static_cast<std::size_t>(task_.facts - task_.basic));
  for (const Axiom& axiom : task_.axioms) {
    std::vector<int>& own = below[axiom.head - task_.basic];
    for (const Literal one : axiom.body) {
      if (one >> 1 >= task_.basic) own.push_back((one >> 1) - task_.basic);
    }
  }
  for (std::vector<int>& own : below) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
  }
  return below;
}

// Strongly connected components, what is depended on first: Tarjan, SIAM J. Computing 1, 1972, without recursion.
void Axioms::find_components() {
  const std::vector<std::vector<int>> below = derived_from();
  const int count = static_cast<int>(below.size());
  std::vector<int> number(below.size(), -1), low(below.size(), 0), stack;
  std::vector<std::size_t> next(below.size(), 0);
  std::vector<char> on_stack(below.size(), 0);
  std::vector<int> path;
  int numbered = 0;
  component_of_.assign(below.size(), -1);
  const auto enter = [&](int fact) {
    number[fact] = low[fact] = numbered++;
    stack.push_back(fact);
    on_stack[fact] = 1;
    path.push_back(fact);
  };
  const auto close = [&](int root) {
    Component component{static_cast<int>(members_.size()), 0, false};
    int fact = -1;
    while (fact != root) {
      fact = stack.back();
      stack.pop_back();
      on_stack[fact] = 0;
      component_of_[fact] = static_cast<int>(components_.size());
      members_.push_back(fact + task_.basic);
    }
    component.end = static_cast<int>(members_.size());
    component.is_circle =
        component.end - component.begin > 1 || std::binary_search(below[root].begin(), below[root].end(), root);
    components_.push_back(component);
  };
  for (int start = 0; start < count; ++start) {
    if (number[start] >= 0) continue;
    enter(start);
    while (!path.empty()) {
      const int fact = path.back();
      if (next[fact] < below[fact].size()) {
        const int other = below[fact][next[fact]++];
        if (number[other] < 0) {
          enter(other);
        } else if (on_stack[other]) {
          low[fact] = std::min(low[fact], number[other]);
        }
        continue;
      }
      path.pop_back();
      if (!path.empty()) low[path.back()] = std::min(low[path.back()], low[fact]);
      if (low[fact] == number[fact]) close(fact);
    }
  }
}

void Axioms::index() {
  std::vector<std::vector<int>> users(static_cast<std::size_t>(task_.facts));
  std::vector<std::vector<int>> inner(static_cast<std::size_t>(task_.facts - task_.basic));
  for (std::size_t i = 0; i < task_.axioms.size(); ++i) {
    const Axiom& axiom = task_.axioms[i];
    const int own = component_of_[axiom.head - task_.basic];
    for (const Literal one : axiom.body) {
      const int fact = one >> 1;
      const bool is_inner = fact >= task_.basic && component_of_[fact - task_.basic] == own;
      if (is_inner) {
        inner[fact - task_.basic].push_back(static_cast<int>(i));
      } else {
        users[fact].push_back(own);
      }
    }
  }
  used_begin_ = inner_begin_ = {0};
  for (std::vector<int>& own : users) {
    std::sort(own.begin(), own.end());
    own.erase(std::unique(own.begin(), own.end()), own.end());
    used_by_.insert(used_by_.end(), own.begin(), own.end());
    used_begin_.push_back(static_cast<int>(used_by_.size()));
  }
  for (const std::vector<int>& own : inner) {
    inner_.insert(inner_.end(), own.begin(), own.end());
    inner_begin_.push_back(static_cast<int>(inner_.size()));
  }
}

void Axioms::derive(std::uint64_t* state) const {
  if (empty()) return;
  for (int fact = task_.basic; fact < task_.facts; ++fact) assign(state, fact, false);
  for (std::size_t i = 0; i < components_.size(); ++i) dirty_[i >> 6] |= std::uint64_t{1} << (i & 63);
  sweep(state);
}

void Axioms::update(const std::uint64_t* before, std::uint64_t* state) const {
  if (empty()) return;
  const int words = (task_.basic + 63) / 64;
  for (int word = 0; word < words; ++word) {
    std::uint64_t changed = before[word] ^ state[word];
    for (; changed != 0; changed &= changed - 1) disturb(64 * word + std::countr_zero(changed));
  }
  sweep(state);
}

void Axioms::disturb(int fact) const {
  for (int i = used_begin_[fact]; i < used_begin_[fact + 1]; ++i) {
    dirty_[used_by_[i] >> 6] |= std::uint64_t{1} << (used_by_[i] & 63);
  }
}

// Upwards: a component disturbs only later ones.
void Axioms::sweep(std::uint64_t* state) const {
  for (std::size_t word = 0; word < dirty_.size(); ++word) {
    while (dirty_[word] != 0) {
      const int bit = std::countr_zero(dirty_[word]);
      dirty_[word] &= dirty_[word] - 1;
      const Component& component = components_[64 * word + static_cast<std::size_t>(bit)];
      if (component.is_circle) {
        evaluate_circle(component, state);
      } else {
        evaluate(component, state);
      }
    }
  }
}

bool Axioms::fires(int axiom, const std::uint64_t* state) const {
  const Literals& body = task_.axioms[axiom].body;
  return std::all_of(body.begin(), body.end(), [&](Literal one) { return literal_holds(state, one); });
}

void Axioms::evaluate(const Component& component, std::uint64_t* state) const {
  const int fact = members_[component.begin], own = fact - task_.basic;
  const bool value = std::any_of(of_head_.begin() + head_begin_[own], of_head_.begin() + head_begin_[own + 1],
                                 [&](int axiom) { return fires(axiom, state); });
  if (value == test(state, fact)) return;
  assign(state, fact, value);
  disturb(fact);
}

void Axioms::evaluate_circle(const Component& component, std::uint64_t* state) const {
  was_true_.clear();
  for (int i = component.begin; i < component.end; ++i) {
    was_true_.push_back(test(state, members_[i]) ? 1 : 0);
    assign(state, members_[i], false);
  }
  const auto make_true = [&](int fact) {
    if (test(state, fact)) return;
    assign(state, fact, true);
    stack_.push_back(fact);
  };
  for (int i = component.begin; i < component.end; ++i) {
    const int own = members_[i] - task_.basic;
    for (int at = head_begin_[own]; at < head_begin_[own + 1]; ++at) {
      const int axiom = of_head_[at];
      open_[axiom] = 0;
      bool is_possible = true;  // outside the circle
      for (const Literal one : task_.axioms[axiom].body) {
        const int fact = one >> 1;
        if (fact >= task_.basic && component_of_[fact - task_.basic] == component_of_[own]) {
          ++open_[axiom];
        } else {
          is_possible = is_possible && literal_holds(state, one);
        }
      }
      if (!is_possible) open_[axiom] = -1;
    }
  }
  for (int i = component.begin; i < component.end; ++i) {
    const int own = members_[i] - task_.basic;
    for (int at = head_begin_[own]; at < head_begin_[own + 1]; ++at) {
      if (open_[of_head_[at]] == 0) make_true(members_[i]);
    }
  }
  while (!stack_.empty()) {
    const int own = stack_.back() - task_.basic;
    stack_.pop_back();
    for (int at = inner_begin_[own]; at < inner_begin_[own + 1]; ++at) {
      int& open = open_[inner_[at]];
      if (open > 0 && --open == 0) make_true(task_.axioms[inner_[at]].head);
    }
  }
  for (int i = component.begin; i < component.end; ++i) {
    if ((was_true_[i - component.begin] != 0) != test(state, members_[i])) disturb(members_[i]);
  }
}

}  // namespace stampede::symbolic
