#include <algorithm>
#include <map>

#include "engine/base/stopping.h"
#include "engine/symbolic/open_list.h"
#include "engine/symbolic/search.h"

namespace stampede::symbolic {
namespace {

constexpr int kNothingNew = 3;  // novelty of a state in which neither a fact nor a pair of facts is new

// Which facts and pairs of facts have been seen, in one class of states.
class Seen {
 public:
  Seen(int facts, bool pairs)
      : facts_(static_cast<std::size_t>(facts)), single_(words(facts_)), pairs_(pairs ? words(facts_ * facts_) : 0) {}

  // 1: a fact is new, 2: a pair is; and what it brings is seen from now on.
  int novelty(const std::vector<int>& fresh, const std::vector<int>& all) {
    int result = kNothingNew;
    for (const int fact : fresh)
      if (mark(single_, static_cast<std::size_t>(fact))) result = 1;
    if (pairs_.empty()) return result;
    for (const int a : fresh) {
      for (const int b : all) {
        const auto [low, high] = std::minmax(a, b);
        if (mark(pairs_, static_cast<std::size_t>(high) * facts_ + static_cast<std::size_t>(low)))
          result = std::min(result, 2);
      }
    }
    return result;
  }

 private:
  static std::size_t words(std::size_t bits) { return (bits + 63) / 64; }
  static bool mark(Words& bits, std::size_t at) {
    const std::uint64_t bit = std::uint64_t{1} << (at & 63);
    const bool is_new = (bits[at >> 6] & bit) == 0;
    bits[at >> 6] |= bit;
    return is_new;
  }

  std::size_t facts_;
  Words single_, pairs_;
};

class WidthSearch {
 public:
  WidthSearch(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic, const PlanLimits& limits,
              const Literals& goal)
      : task_(task),
        semantics_(semantics),
        heuristic_(heuristic),
        limits_(limits),
        goal_(goal),
        successors_(task),
        pool_(semantics.words()) {}

  SearchResult run(const Words& start) {
    if (add(start, {-1, -1})) return result_;
    while (!open_.empty() && result_.evaluated < limits_.expansions && bytes() < limits_.memory_bytes) {
      heed_stop();
      const int number = open_.pop().parent;
      ++result_.expanded;
      state_ = pool_.get(number);
      successors_.applicable(state_, applicable_);
      for (const int op : applicable_) {
        semantics_.apply(state_, op, next_);
        if (add(next_, {number, op})) return result_;
      }
    }
    result_.exhausted = open_.empty();
    return result_;
  }

 private:
  struct Node {
    Entry from;
    int open_goals;
    int aim;             // of aims_: what the last relaxed plan on the way wanted
    std::size_t had_at;  // in had_: what of it the way has had
    int had;             // how much
  };

  std::int64_t bytes() const {
    return pool_.bytes() + open_.count() * static_cast<std::int64_t>(sizeof(Entry)) + seen_bytes_ +
           static_cast<std::int64_t>(nodes_.size() * sizeof(Node) + had_.size() * sizeof(std::uint64_t));
  }

  // A state that was not seen before, with its place in the queue; true at a goal.
  bool add(const Words& state, Entry from) {
    const auto [number, is_new] = pool_.insert(state);
    if (!is_new) return false;
    ++result_.evaluated;
    const Node* parent = from.parent < 0 ? nullptr : &nodes_[static_cast<std::size_t>(from.parent)];
    Node node{from, goals_open(state, goal_), 0, had_.size(), 0};
    if (node.open_goals == 0) {
      nodes_.push_back(node);
      result_.solved = true;
      result_.plan = operators_to(number, [&](int at) { return nodes_[static_cast<std::size_t>(at)].from; });
      return true;
    }
    bool is_dead = false;
    if (parent == nullptr || node.open_goals < parent->open_goals) {
      is_dead = !aim_anew(state, node);
    } else {
      go_on(state, *parent, node);
    }
    const std::pair<int, int> its_class{node.open_goals, node.had};
    const bool same = parent != nullptr && parent->open_goals == node.open_goals && parent->had == node.had;
    nodes_.push_back(node);
    if (is_dead) return false;
    open_.push(novelty(state, same, its_class) * (static_cast<int>(goal_.size()) + 1) + node.open_goals, {number, -1});
    return false;
  }

  // False: a dead end.
  bool aim_anew(const Words& state, Node& node) {
    if (heuristic_.evaluate(state) == Heuristic::kDeadEnd) return false;
    std::vector<Literal>& aim = aims_.emplace_back();
    for (const int one : heuristic_.relaxed())
      if (one < 2 * task_.facts && !literal_holds(state.data(), one)) aim.push_back(one);
    node.aim = static_cast<int>(aims_.size()) - 1;
    had_.resize(had_.size() + (aim.size() + 63) / 64, 0);
    return true;
  }

  void go_on(const Words& state, const Node& parent, Node& node) {
    node.aim = parent.aim;
    const std::vector<Literal>& aim = aims_[static_cast<std::size_t>(node.aim)];
    const std::size_t words = (aim.size() + 63) / 64, from = parent.had_at;
    had_.resize(had_.size() + words, 0);
    std::copy_n(had_.begin() + static_cast<std::ptrdiff_t>(from), words,
                had_.begin() + static_cast<std::ptrdiff_t>(node.had_at));
    node.had = parent.had;
    for (std::size_t i = 0; i < aim.size(); ++i) {
      const std::uint64_t bit = std::uint64_t{1} << (i & 63);
      std::uint64_t& word = had_[node.had_at + (i >> 6)];
      if ((word & bit) != 0 || !literal_holds(state.data(), aim[i])) continue;
      word |= bit;
      ++node.had;
    }
  }

  // `same`: the state that it was reached from is of the same class, so only what differs can be new.
  int novelty(const Words& state, bool same, const std::pair<int, int>& its_class) {
    auto found = seen_.find(its_class);
    if (found == seen_.end()) {
      const std::int64_t room = static_cast<std::int64_t>(task_.basic) * task_.basic / 8;
      const bool pairs = seen_bytes_ + room < limits_.memory_bytes / 4;
      if (pairs) seen_bytes_ += room;
      found = seen_.emplace(its_class, Seen(task_.basic, pairs)).first;
    }
    all_.clear(), fresh_.clear();
    for (int fact = 0; fact < task_.basic; ++fact) {
      if (!test(state.data(), fact)) continue;
      all_.push_back(fact);
      if (!same || !test(state_.data(), fact)) fresh_.push_back(fact);
    }
    return found->second.novelty(fresh_, all_);
  }

  const GroundTask& task_;
  const Semantics& semantics_;
  Heuristic& heuristic_;
  const PlanLimits& limits_;
  const Literals& goal_;
  Successors successors_;
  StatePool pool_;
  std::vector<Node> nodes_;
  std::vector<std::vector<Literal>> aims_;
  Words had_;
  std::map<std::pair<int, int>, Seen> seen_;  // by open goals and how much of the relaxed plan was had
  std::int64_t seen_bytes_ = 0;
  OpenList open_;
  Words state_, next_;
  std::vector<int> applicable_, all_, fresh_;
  SearchResult result_;
};

}  // namespace

SearchResult width_search(const GroundTask& task, const Semantics& semantics, Heuristic& heuristic,
                          const PlanLimits& limits, const Query& query) {
  return WidthSearch(task, semantics, heuristic, limits, query.goal).run(query.start);
}

}  // namespace stampede::symbolic
