#include "engine/symbolic/search.h"

#include <algorithm>
#include <array>

#include "engine/base/stopping.h"
#include "engine/symbolic/open_list.h"

namespace stampede::symbolic {
namespace {

constexpr std::size_t kHeuristics = 3, kLists = 2 * kHeuristics;
constexpr int kMostTies = 256;  // levels of landmarks ahead that order what h_FF calls equal
constexpr int kBoost = 1000;    // expansions that preferred operators get when the heuristic improves (as in LAMA)

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
        used_(query.weight != 0            ? 1
              : query.landmarks == nullptr ? 2
                                           : 3),
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
           static_cast<std::int64_t>(parents_.size() * sizeof(Entry) + reached_.size() * sizeof(std::uint64_t));
  }

  int next_list() {
    int best = -1;
    for (int i = 0; i < static_cast<int>(kLists); ++i) {
      if (lists_[static_cast<std::size_t>(i)].empty()) continue;
      if (best < 0 || turns_[static_cast<std::size_t>(i)] < turns_[static_cast<std::size_t>(best)]) best = i;
    }
    if (best >= 0) ++turns_[static_cast<std::size_t>(best)];
    return best;
  }

  // Of a state that is reached from state `number`, or that state itself.
  Landmarks::Ahead ahead(const Words& state, int number) {
    const auto from =
        reached_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(number) * query_.landmarks->words());
    judged_.assign(from, from + static_cast<std::ptrdiff_t>(query_.landmarks->words()));
    return query_.landmarks->judge(state, judged_.data());
  }

  int step_cost(int op) const { return query_.costs == nullptr ? 1 : (*query_.costs)[static_cast<std::size_t>(op)]; }

  // Room for what the path to the new state has reached; all states have it, dead ends too.
  void inherit(int parent) {
    if (used_ < kHeuristics) return;
    const std::size_t words = query_.landmarks->words(), end = reached_.size();
    reached_.resize(end + words, 0);
    if (parent < 0) return;
    const auto from = reached_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(parent) * words);
    std::copy(from, from + static_cast<std::ptrdiff_t>(words), reached_.begin() + static_cast<std::ptrdiff_t>(end));
  }

  // Evaluates a state that was not seen before and queues its successors; true at a goal.
  bool visit(const Words& state, Entry from) {
    const auto [number, is_new] = pool_.insert(state);
    if (!is_new) return false;
    parents_.push_back(from);
    inherit(from.parent);
    depth_.push_back(from.parent < 0 ? 0 : depth_[static_cast<std::size_t>(from.parent)] + step_cost(from.op));
    const int open_goals = goals_open(state, query_.goal);
    if (open_goals == 0) {
      result_.solved = true;
      result_.plan = operators_to(number, [&](int at) { return parents_[static_cast<std::size_t>(at)]; });
      return true;
    }
    heed_stop();
    ++result_.evaluated;
    const int h = heuristic_.evaluate(state);
    if (h == Heuristic::kDeadEnd) return false;
    if (query_.bound > 0 && depth_.back() + h >= query_.bound) return false;
    ++result_.expanded;
    std::array<int, kHeuristics> values = {h, open_goals, 0};
    if (used_ > 2) {
      std::uint64_t* reached = reached_.data() + static_cast<std::size_t>(number) * query_.landmarks->words();
      Landmarks::Ahead now;
      if (query_.strict) {
        now = query_.landmarks->judge(state, reached);
      } else {
        query_.landmarks->progress(state, reached);
        now = ahead(state, number);
      }
      values = {h, now.goals, now.landmarks};
    }
    boost(values);
    if (weight_ != 0) values[0] = depth_.back() + weight_ * h;
    queue_successors(state, number, values);
    return false;
  }

  // The more turns for preferred operators, the more heuristics say that the search is getting on.
  void boost(const std::array<int, kHeuristics>& values) {
    for (std::size_t i = 0; i < used_; ++i) {
      if (best_[i] >= 0 && values[i] >= best_[i]) continue;
      best_[i] = values[i];
      for (std::size_t list = 1; list < kLists; list += 2) turns_[list] -= kBoost;
    }
  }

  // h_FF is that of the state itself (lazy); what landmarks say is cheap and far better known of each successor, so it
  // also orders successors of equal h_FF.
  void queue_successors(const Words& state, int number, std::array<int, kHeuristics> keys) {
    const std::vector<int>& preferred = heuristic_.preferred();
    const int own = keys[0], most = used_ > 2 ? query_.landmarks->size() + 1 : 1, ties = std::min(most, kMostTies);
    if (used_ > 2) {
      const std::size_t words = query_.landmarks->words();
      query_.landmarks->begin_successors(state, reached_.data() + static_cast<std::size_t>(number) * words);
    }
    for (const int op : heuristic_.applicable()) {
      const bool is_preferred = std::binary_search(preferred.begin(), preferred.end(), op);
      if (used_ > 2) {
        semantics_.apply(state, op, successor_);
        const Landmarks::Ahead then = query_.landmarks->ahead_of(successor_);
        keys = {own * ties + then.landmarks * ties / most, then.goals, then.landmarks};
      }
      for (std::size_t i = 0; i < used_; ++i) {
        lists_[2 * i].push(keys[i], {number, op});
        if (is_preferred) lists_[2 * i + 1].push(keys[i], {number, op});
      }
    }
  }

  const GroundTask& task_;
  const Semantics& semantics_;
  Heuristic& heuristic_;
  const PlanLimits& limits_;
  const Query& query_;
  int weight_;
  std::size_t used_;  // heuristics
  StatePool pool_;
  std::vector<Entry> parents_;
  std::vector<int> depth_;
  std::vector<std::uint64_t> reached_;  // by state: the landmarks that were true on the way
  std::array<OpenList, kLists> lists_;  // of each heuristic: all successors, preferred ones
  std::array<std::int64_t, kLists> turns_ = {};
  std::array<int, kHeuristics> best_ = {-1, -1, -1};
  Words next_, successor_;
  std::vector<std::uint64_t> judged_;
  SearchResult result_;
};

}  // namespace

SearchResult lazy_search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                         const PlanLimits& limits, const Query& query) {
  return Search(task, semantics, heuristic, limits, query).run();
}

}  // namespace stampede::symbolic
