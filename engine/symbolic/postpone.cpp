// What a plan does too early, done later.
#include "engine/symbolic/improver.h"

namespace stampede::symbolic {
namespace {

constexpr std::size_t kMostWaiting = 10;  // steps at the end of the plan that are sought anew
constexpr std::size_t kWayBack = 4;       // steps of the plan that a way back into it may replace

}  // namespace

// One pass that leaves out `count` steps in a row, takes those after them as far as they can be taken, and looks there
// for a way back into the plan: what was done too early is done where it is needed, as if the plan's order had been
// loosened first (the idea of block deordering: Siddiqui, Haslum, JAIR 54, 2015). True if the plan became cheaper.
bool Improver::postpone(std::size_t count, std::vector<int>& plan) {
  bool better = false;
  Words state = semantics.initial(), next, after;
  std::vector<Literals> needed = needed_before(plan);
  for (std::size_t i = 0; i + count <= plan.size() && budget > 0;) {
    const auto at = [&](std::size_t step) { return plan.begin() + static_cast<std::ptrdiff_t>(step); };
    after = state;
    std::size_t stuck = i + count;
    for (; stuck < plan.size() && semantics.applicable(after, plan[stuck]); ++stuck) {
      semantics.apply(after, plan[stuck], next);
      after.swap(next);
    }
    const std::size_t back = std::min(plan.size(), stuck + kWayBack);
    const int bound = search_cost(at(i), at(i + count)) + search_cost(at(stuck), at(back));
    const SearchResult found = search_window(after, needed[back], bound);
    if (found.solved) {
      std::vector<int> changed(plan.begin(), at(i));
      changed.insert(changed.end(), at(i + count), at(stuck));
      changed.insert(changed.end(), found.plan.begin(), found.plan.end());
      changed.insert(changed.end(), at(back), plan.end());
      if (price(changed) < price(plan) && works(changed)) {
        plan = std::move(changed);
        needed = needed_before(plan);
        better = true;
        continue;
      }
    }
    semantics.apply(state, plan[i], next);
    state.swap(next);
    ++i;
  }
  heuristic.set_goal(task.goal);
  return better;
}

// The same where other steps wait for those left out: all that can still be taken is, and the goal is sought from
// there.
bool Improver::finish_last(std::size_t count, std::vector<int>& plan) {
  bool better = false;
  Words state = semantics.initial(), next;
  heuristic.set_goal(task.goal);
  for (std::size_t i = 0; i + count <= plan.size() && budget > 0;) {
    std::vector<int> changed(plan.begin(), plan.begin() + static_cast<std::ptrdiff_t>(i));
    Words after = state;
    for (std::size_t step = i + count; step < plan.size(); ++step) {
      if (!semantics.applicable(after, plan[step])) continue;
      semantics.apply(after, plan[step], next);
      after.swap(next);
      changed.push_back(plan[step]);
    }
    const int bound = search_cost(plan.begin(), plan.end()) - search_cost(changed.begin(), changed.end());
    SearchResult found;
    if (plan.size() - changed.size() <= kMostWaiting) found = search_window(after, task.goal, bound);
    changed.insert(changed.end(), found.plan.begin(), found.plan.end());
    if (found.solved && price(changed) < price(plan)) {
      plan = std::move(changed);
      better = true;
      continue;
    }
    semantics.apply(state, plan[i], next);
    state.swap(next);
    ++i;
  }
  return better;
}

}  // namespace stampede::symbolic
