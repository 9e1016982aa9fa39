#include "engine/symbolic/search.h"

#include <algorithm>
#include <array>
#include <deque>

namespace stampede::symbolic {
namespace {

constexpr int kBoost = 1000;  // expansions that preferred operators get when the heuristic improves (as in LAMA)

struct Entry {
  int parent, op;
};

// First in, first out among equals.
class OpenList {
 public:
  bool empty() const { return count_ == 0; }
  std::int64_t count() const { return count_; }
  void push(int key, Entry entry) {
    if (static_cast<std::size_t>(key) >= buckets_.size()) buckets_.resize(static_cast<std::size_t>(key) + 1);
    buckets_[static_cast<std::size_t>(key)].push_back(entry);
    lowest_ = std::min(lowest_, static_cast<std::size_t>(key));
    ++count_;
  }
  Entry pop() {
    while (buckets_[lowest_].empty()) ++lowest_;
    const Entry entry = buckets_[lowest_].front();
    buckets_[lowest_].pop_front();
    --count_;
    return entry;
  }

 private:
  std::vector<std::deque<Entry>> buckets_;
  std::size_t lowest_ = 0;
  std::int64_t count_ = 0;
};

class Search {
 public:
  Search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic, const PlanLimits& limits,
         const Query& query)
      : task_(task),
        semantics_(semantics),
        heuristic_(heuristic),
        limits_(limits),
        query_(query),
        weight_(query.weight),
        pool_(semantics.words()) {}

  SearchResult run() {
    if (visit(query_.start, {-1, -1})) return result_;
    while (result_.evaluated < limits_.expansions && bytes() < limits_.memory_bytes) {
      const int list = next_list();
      if (list < 0) {
        result_.exhausted = true;
        break;
      }
      const Entry entry = lists_[static_cast<std::size_t>(list)].pop();
      semantics_.apply(pool_.get(entry.parent), entry.op, next_);
      if (visit(next_, entry)) break;
    }
    return result_;
  }

 private:
  std::int64_t bytes() const {
    std::int64_t entries = 0;
    for (const OpenList& list : lists_) entries += list.count();
    return pool_.bytes() + entries * static_cast<std::int64_t>(sizeof(Entry)) +
           static_cast<std::int64_t>(parents_.size() * sizeof(Entry));
  }

  int next_list() {
    int best = -1;
    for (int i = 0; i < 4; ++i) {
      if (lists_[static_cast<std::size_t>(i)].empty()) continue;
      if (best < 0 || turns_[static_cast<std::size_t>(i)] < turns_[static_cast<std::size_t>(best)]) best = i;
    }
    if (best >= 0) ++turns_[static_cast<std::size_t>(best)];
    return best;
  }

  int goals_open(const Words& state) const {
    return static_cast<int>(std::count_if(query_.goal.begin(), query_.goal.end(),
                                          [&](Literal one) { return !literal_holds(state.data(), one); }));
  }

  // Evaluates a state that was not seen before and queues its successors; true at a goal.
  bool visit(const Words& state, Entry from) {
    const auto [number, is_new] = pool_.insert(state);
    if (!is_new) return false;
    parents_.push_back(from);
    depth_.push_back(from.parent < 0 ? 0 : depth_[static_cast<std::size_t>(from.parent)] + 1);
    if (goals_open(state) == 0) {
      extract(number);
      return true;
    }
    ++result_.evaluated;
    const int h = heuristic_.evaluate(state);
    if (h == Heuristic::kDeadEnd) return false;
    if (query_.bound > 0 && depth_.back() + h >= query_.bound) return false;
    ++result_.expanded;
    const std::array<int, 2> values = {h, weight_ == 0 ? goals_open(state) : 0};
    const std::array<int, 2> keys = {weight_ == 0 ? h : depth_.back() + weight_ * h, values[1]};
    const std::size_t used = weight_ == 0 ? 2 : 1;
    for (std::size_t i = 0; i < used; ++i) {
      if (best_[i] >= 0 && values[i] >= best_[i]) continue;
      best_[i] = values[i];
      turns_[1] -= kBoost;
      turns_[3] -= kBoost;
    }
    const std::vector<int>& preferred = heuristic_.preferred();
    for (const int op : heuristic_.applicable()) {
      const bool is_preferred = std::binary_search(preferred.begin(), preferred.end(), op);
      for (std::size_t i = 0; i < used; ++i) {
        lists_[2 * i].push(keys[i], {number, op});
        if (is_preferred) lists_[2 * i + 1].push(keys[i], {number, op});
      }
    }
    return false;
  }

  void extract(int number) {
    result_.solved = true;
    for (int at = number; parents_[static_cast<std::size_t>(at)].op >= 0;
         at = parents_[static_cast<std::size_t>(at)].parent) {
      result_.plan.push_back(parents_[static_cast<std::size_t>(at)].op);
    }
    std::reverse(result_.plan.begin(), result_.plan.end());
  }

  const GroundTask& task_;
  const Semantics& semantics_;
  Heuristic& heuristic_;
  const PlanLimits& limits_;
  const Query& query_;
  int weight_;
  StatePool pool_;
  std::vector<Entry> parents_;
  std::vector<int> depth_;
  std::array<OpenList, 4> lists_;  // h_FF: all, preferred; open goals: all, preferred
  std::array<std::int64_t, 4> turns_ = {0, 0, 0, 0};
  std::array<int, 2> best_ = {-1, -1};
  Words next_;
  SearchResult result_;
};

}  // namespace

int cost_of(const GroundTask& task, int op) {
  return task.lifted.domain->actions[task.lifted.schemas[task.operators[op].schema].action].cost;
}

SearchResult lazy_search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         const PlanLimits& limits, const Query& query) {
  return Search(task, semantics, heuristic, limits, query).run();
}

}  // namespace stampede::symbolic

namespace stampede {

std::string to_text(const Plan& plan) {
  std::string text;
  for (const PlanStep& step : plan) text += to_text(Fact{step.action, step.arguments}) + "\n";
  return text;
}

PlanOutcome solve(const Domain& domain, const Problem& problem, const PlanLimits& limits,
                  const std::set<PlanStep>& forbidden) {
  using namespace symbolic;
  PlanOutcome outcome;
  const GroundTask task = ground(lift(domain, problem), forbidden);
  if (!task.solvable()) {
    outcome.explanation = explain_unsolvable(task, {}, limits);
    return outcome;
  }
  const Semantics semantics(task);
  Heuristic heuristic(task);
  const SearchResult result = lazy_search(task, semantics, heuristic, limits, {semantics.initial(), task.goal, 0, 0});
  outcome.expanded = result.expanded;
  outcome.evaluated = result.evaluated;
  outcome.solved = result.solved;
  if (!result.solved) {
    outcome.explanation = explain_unsolvable(task, result, limits);
    return outcome;
  }
  for (const int op : shorten(task, semantics, heuristic, result.plan, limits.improve))
    outcome.plan.push_back(task.step(op));
  return outcome;
}

}  // namespace stampede
