#include <algorithm>
#include <utility>

#include "engine/symbolic/improver.h"

namespace stampede::symbolic {
namespace {

constexpr std::int64_t kWindowExpansions = 50;
constexpr std::int64_t kWholeExpansions = 400;
constexpr std::int64_t kWindowWork = 32'000'000;  // operators times expansions: bounds the time on large tasks
constexpr int kMostStepCost = 64;                 // in searches; true costs are scaled to it

}  // namespace

// The plan without step `drop` and without all later steps that then cannot be taken; false if the goal fails.
bool Improver::without(const std::vector<int>& plan, std::size_t drop, Words state, std::vector<int>& rest) const {
  rest.assign(plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(drop));
  Words next;
  for (std::size_t i = drop + 1; i < plan.size(); ++i) {
    if (!semantics.applicable(state, plan[i])) continue;
    semantics.apply(state, plan[i], next);
    state.swap(next);
    rest.push_back(plan[i]);
  }
  return semantics.is_goal(state);
}

// Action elimination: Nakhost, Müller, ICAPS 2010. By simulation, so conditional effects and axioms are as good as any.
std::vector<int> Improver::eliminate(std::vector<int> plan) const {
  Words state = semantics.initial(), next;
  std::vector<int> rest;
  for (std::size_t i = 0; i < plan.size();) {
    if (without(plan, i, state, rest)) {
      plan = rest;
      continue;
    }
    semantics.apply(state, plan[i], next);
    state.swap(next);
    ++i;
  }
  return plan;
}

namespace {

// Derived literals become the basic facts below them, as a state has these: more than is needed.
class Unfolding {
 public:
  explicit Unfolding(const GroundTask& task)
      : basic_(task.basic),
        reads_(static_cast<std::size_t>(task.facts - task.basic)),
        seen_(static_cast<std::size_t>(task.facts), 0) {
    for (const Axiom& axiom : task.axioms) {
      std::vector<int>& own = reads_[axiom.head - task.basic];
      for (const Literal one : axiom.body) own.push_back(one >> 1);
    }
  }

  void unfold(Literals& literals, const Words& state) {
    Literals basic;
    for (const Literal one : literals) {
      if (one >> 1 < basic_) {
        basic.push_back(one);
      } else {
        stack_.push_back(one >> 1);
      }
    }
    while (!stack_.empty()) {
      const int fact = stack_.back();
      stack_.pop_back();
      if (seen_[fact]) continue;
      seen_[fact] = 1;
      touched_.push_back(fact);
      if (fact < basic_) {
        basic.push_back(2 * fact + (test(state.data(), fact) ? 0 : 1));
      } else {
        stack_.insert(stack_.end(), reads_[fact - basic_].begin(), reads_[fact - basic_].end());
      }
    }
    for (const int fact : touched_) seen_[fact] = 0;
    touched_.clear();
    std::sort(basic.begin(), basic.end());
    basic.erase(std::unique(basic.begin(), basic.end()), basic.end());
    literals = std::move(basic);
  }

 private:
  int basic_;
  std::vector<std::vector<int>> reads_;  // by derived fact: what its axioms read
  std::vector<char> seen_;
  std::vector<int> stack_, touched_;
};

// What must hold in a state so that the step can be taken there and `after` holds then.
Literals regressed(const Literals& after, const Operator& step, const Words& state) {
  Literals before = step.precondition;
  for (const ConditionalEffect& effect : step.conditional) {
    for (const Literal one : effect.when) before.push_back(literal_holds(state.data(), one) ? one : one ^ 1);
    const int fact = effect.effect >> 1;  // may or may not be changed: what matters later must be right before
    if (std::binary_search(after.begin(), after.end(), effect.effect) ||
        std::binary_search(after.begin(), after.end(), effect.effect ^ 1)) {
      before.push_back(2 * fact + (test(state.data(), fact) ? 0 : 1));
    }
  }
  for (const Literal one : after) {
    if (std::binary_search(step.effects.begin(), step.effects.end(), one)) continue;
    const bool is_conditional =
        std::any_of(step.conditional.begin(), step.conditional.end(),
                    [&](const ConditionalEffect& effect) { return effect.effect >> 1 == one >> 1; });
    if (!is_conditional) before.push_back(one);
  }
  return before;
}

}  // namespace

// What must hold before each step so that the rest of the plan works and ends in the goal: exact for plain effects. For
// conditional effects and axioms it is more than needed: all that the rest reads, directly or through axioms, as it is.
std::vector<Literals> Improver::needed_before(const std::vector<int>& plan) const {
  std::vector<Words> states = {semantics.initial()};
  for (const int op : plan) {
    Words next;
    semantics.apply(states.back(), op, next);
    states.push_back(std::move(next));
  }
  Unfolding below(task);
  std::vector<Literals> needed(plan.size() + 1);
  needed.back() = task.goal;
  for (std::size_t i = plan.size(); i-- > 0;) {
    Literals after = needed[i + 1];
    if (i + 1 < plan.size() || !task.axioms.empty()) below.unfold(after, states[i + 1]);
    needed[i] = regressed(after, task.operators[plan[i]], states[i]);
    below.unfold(needed[i], states[i]);
  }
  return needed;
}

SearchResult Improver::search_window(const Words& from, const Literals& goal, int bound) {
  PlanLimits limits;
  limits.expansions = std::min(budget, kWindowExpansions);
  heuristic.set_goal(goal);
  const SearchResult found = lazy_search(task, semantics, heuristic, limits,
                                         {from, goal, 1, bound, nullptr, costs.empty() ? nullptr : &costs});
  budget -= found.evaluated;
  return found;
}

// One pass of windows of `length` steps over the plan; true if some window became cheaper.
bool Improver::shorten_windows(std::size_t length, std::vector<int>& plan) {
  bool better = false;
  Words state = semantics.initial(), next;
  std::vector<Literals> needed = needed_before(plan);
  for (std::size_t i = 0; i < plan.size() && budget > 0; ++i) {
    const std::size_t end = std::min(plan.size(), i + length);
    const auto from = plan.begin() + static_cast<std::ptrdiff_t>(i),
               to = plan.begin() + static_cast<std::ptrdiff_t>(end);
    const SearchResult found = search_window(state, needed[end], search_cost(from, to));
    if (found.solved && price(found.plan) < price(from, to)) {
      std::vector<int> changed(plan.begin(), from);
      changed.insert(changed.end(), found.plan.begin(), found.plan.end());
      changed.insert(changed.end(), to, plan.end());
      if (works(changed)) {
        plan = std::move(changed);
        needed = needed_before(plan);
        better = true;
      }
    }
    if (i >= plan.size()) break;
    semantics.apply(state, plan[i], next);
    state.swap(next);
  }
  heuristic.set_goal(task.goal);
  return better;
}

// Weighted best-first searches for the whole plan, each from scratch and bounded by the best so far: anytime search as
// in Richter, Thayer, Ruml, ICAPS 2010.
void Improver::search_again(std::int64_t expansions, std::vector<int>& plan) {
  for (const int weight : {5, 3, 2, 1}) {
    while (expansions > 0) {
      PlanLimits limits;
      limits.expansions = expansions;
      const SearchResult found =
          lazy_search(task, semantics, heuristic, limits,
                      {semantics.initial(), task.goal, weight, search_cost(plan.begin(), plan.end()), nullptr,
                       costs.empty() ? nullptr : &costs});
      expansions -= found.evaluated;
      budget -= found.evaluated;
      if (!found.solved || price(found.plan) >= price(plan)) break;
      plan = eliminate(found.plan);
    }
  }
}

namespace {

// Costs as searches see them: at least 1 each, so that steps count too. Empty: all are equal.
std::vector<int> scaled_costs(const GroundTask& task) {
  int least = 0, most = 0;
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const int cost = task.operators[i].cost;
    least = i == 0 ? cost : std::min(least, cost);
    most = std::max(most, cost);
  }
  std::vector<int> costs;
  if (least == most) return costs;
  for (const Operator& op : task.operators) {
    costs.push_back(most < kMostStepCost
                        ? std::max(1, op.cost)
                        : static_cast<int>(1 + static_cast<std::int64_t>(op.cost) * (kMostStepCost - 1) / most));
  }
  return costs;
}

}  // namespace

std::vector<int> shorten(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         std::vector<int> plan, std::int64_t expansions) {
  if (expansions <= 0 || plan.empty()) return plan;
  Improver improver{task, semantics, heuristic, scaled_costs(task)};
  if (!improver.costs.empty()) heuristic.set_costs(&improver.costs);
  improver.budget =
      std::min<std::int64_t>(expansions, kWindowWork / static_cast<std::int64_t>(task.operators.size() + 100));
  plan = improver.eliminate(std::move(plan));
  std::size_t in_vain = 0;  // windows of so many steps, and so any that are as long as the plan
  for (const std::size_t length : {8, 16}) {
    if (plan.size() <= in_vain) break;
    if (improver.shorten_windows(length, plan)) {
      plan = improver.eliminate(std::move(plan));
    } else {
      in_vain = length;
    }
  }
  for (const std::size_t count : {2, 4}) {
    if (improver.postpone(count, plan)) plan = improver.eliminate(std::move(plan));
  }
  if (improver.finish_last(2, plan)) plan = improver.eliminate(std::move(plan));
  const bool is_plain = task.axioms.empty() && std::all_of(task.operators.begin(), task.operators.end(),
                                                           [](const Operator& op) { return op.conditional.empty(); });
  const bool is_small = plan.size() <= 24;  // larger plans are beyond what so few expansions find again
  if (!is_plain || is_small || !improver.costs.empty()) {
    improver.search_again(std::min(improver.budget, kWholeExpansions), plan);
  }
  heuristic.set_costs(nullptr);
  return plan;
}

}  // namespace stampede::symbolic
