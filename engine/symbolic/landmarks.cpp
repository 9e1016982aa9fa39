#include "engine/symbolic/landmarks.h"

#include <algorithm>
#include <bit>
#include <deque>
#include <iterator>

namespace stampede::symbolic {
namespace {

constexpr std::size_t kMostLabelWords = 16'000'000;  // 128 MB
constexpr std::size_t kMostLabelWork = 60'000'000;   // words touched when each rule is looked at a few times

constexpr std::size_t kMostMasked = 8000;  // landmarks: 32 MB of masks

bool bit(const std::uint64_t* words, int i) { return (words[i >> 6] >> (i & 63) & 1) != 0; }
void set_bit(std::uint64_t* words, int i) { words[i >> 6] |= std::uint64_t{1} << (i & 63); }

}  // namespace

Landmarks::Landmarks(const GroundTask& task, const Relaxation& relaxation, const Words& start) {
  width_ = (static_cast<std::size_t>(relaxation.nodes) + 63) / 64;
  const std::size_t nodes = static_cast<std::size_t>(relaxation.nodes);
  if (width_ * nodes <= kMostLabelWords && width_ * (relaxation.conditions.size() + nodes) <= kMostLabelWork) {
    label(task, relaxation, start);
  }
  choose(task);
  order(task, relaxation);
  find_removals(task);
  make_masks();
  labels_ = {};
  labelled_ = {};
}

// A node's label: the nodes that are true before or with it in every relaxed plan for it.
void Landmarks::label(const GroundTask& task, const Relaxation& relaxation, const Words& start) {
  labels_.assign(static_cast<std::size_t>(relaxation.nodes) * width_, 0);
  labelled_.assign(static_cast<std::size_t>(relaxation.nodes), 0);
  std::vector<int> open;
  std::deque<int> queue;
  std::vector<char> queued(relaxation.rules.size(), 0);
  for (const Relaxation::Rule& rule : relaxation.rules) open.push_back(rule.conditions_end - rule.conditions_begin);
  const auto enqueue = [&](int rule) {
    if (open[rule] > 0 || queued[rule]) return;
    queued[rule] = 1;
    queue.push_back(rule);
  };
  const auto now_labelled = [&](int node) {
    labelled_[node] = 1;
    for (int i = relaxation.used_begin[node]; i < relaxation.used_begin[node + 1]; ++i) --open[relaxation.used[i]];
  };
  for (int fact = 0; fact < task.facts; ++fact) {
    const int node = 2 * fact + (test(start.data(), fact) ? 0 : 1);
    if (!relaxation.needed[node]) continue;
    set_bit(labels_.data() + static_cast<std::size_t>(node) * width_, node);
    now_labelled(node);
  }
  for (std::size_t rule = 0; rule < relaxation.rules.size(); ++rule) enqueue(static_cast<int>(rule));
  std::vector<std::uint64_t> joined(width_);
  while (!queue.empty()) {
    const int at = queue.front();
    queue.pop_front();
    queued[at] = 0;
    const Relaxation::Rule& rule = relaxation.rules[at];
    std::fill(joined.begin(), joined.end(), 0);
    for (int i = rule.conditions_begin; i < rule.conditions_end; ++i) {
      const std::uint64_t* label = labels_of(relaxation.conditions[i]);
      for (std::size_t w = 0; w < width_; ++w) joined[w] |= label[w];
    }
    for (int i = rule.begin; i < rule.end; ++i) {
      const int node = relaxation.effects[i];
      std::uint64_t* label = labels_.data() + static_cast<std::size_t>(node) * width_;
      bool changed = !labelled_[node];
      if (changed) {
        std::copy(joined.begin(), joined.end(), label);
        set_bit(label, node);
        now_labelled(node);
      } else {
        for (std::size_t w = 0; w < width_; ++w) {
          std::uint64_t kept = label[w] & joined[w];
          if (static_cast<std::size_t>(node) >> 6 == w) kept |= label[w] & (std::uint64_t{1} << (node & 63));
          changed |= kept != label[w];
          label[w] = kept;
        }
      }
      if (!changed) continue;
      for (int j = relaxation.used_begin[node]; j < relaxation.used_begin[node + 1]; ++j) enqueue(relaxation.used[j]);
    }
  }
}

void Landmarks::choose(const GroundTask& task) {
  std::vector<std::uint64_t> all(width_, 0);
  for (const Literal goal : task.goal) {
    set_bit(all.data(), goal);
    if (labels_.empty() || !labelled_[goal]) continue;
    for (std::size_t w = 0; w < width_; ++w) all[w] |= labels_of(goal)[w];
  }
  of_node_.assign(width_ * 64, -1);
  for (int node = 0; node < 2 * task.facts; ++node) {
    if (!bit(all.data(), node)) continue;
    of_node_[node] = size();
    node_.push_back(node);
    is_goal_.push_back(std::binary_search(task.goal.begin(), task.goal.end(), node) ? 1 : 0);
    if (is_goal_.back()) goals_.push_back(size() - 1);
  }
  words_ = (node_.size() + 63) / 64;
  now_.assign(words_, 0);
}

void Landmarks::order(const GroundTask& task, const Relaxation& relaxation) {
  before_.resize(node_.size());
  needed_for_.resize(node_.size());
  needs_.resize(node_.size());
  if (labels_.empty()) return;
  for (int landmark = 0; landmark < size(); ++landmark) {
    if (!labelled_[node_[landmark]]) continue;
    for (int node = 0; node < 2 * task.facts; ++node) {
      if (node == node_[landmark] || !bit(labels_of(node_[landmark]), node)) continue;
      if (of_node_[node] >= 0) before_[landmark].push_back(of_node_[node]);
    }
  }
  // What all operators that can be first to achieve a landmark share as a condition must hold right before.
  std::vector<std::vector<int>> shared(node_.size());
  std::vector<char> is_first(node_.size(), 1);
  for (const Relaxation::Rule& rule : relaxation.rules) {
    const auto begin = relaxation.conditions.begin() + rule.conditions_begin,
               end = relaxation.conditions.begin() + rule.conditions_end;
    if (std::any_of(begin, end, [&](int one) { return labelled_[one] == 0; })) continue;
    for (int i = rule.begin; i < rule.end; ++i) {
      const int landmark = of_node_[relaxation.effects[i]], node = relaxation.effects[i];
      if (landmark < 0) continue;
      if (std::any_of(begin, end, [&](int one) { return bit(labels_of(one), node); })) continue;
      std::vector<int> both;
      if (is_first[landmark]) {
        both.assign(begin, end);
      } else {
        std::set_intersection(shared[landmark].begin(), shared[landmark].end(), begin, end, std::back_inserter(both));
      }
      is_first[landmark] = 0;
      shared[landmark] = std::move(both);
    }
  }
  for (int landmark = 0; landmark < size(); ++landmark) {
    for (const int node : shared[landmark]) {
      if (of_node_[node] < 0) continue;
      needed_for_[of_node_[node]].push_back(landmark);
      needs_[landmark].push_back(of_node_[node]);
    }
  }
}

void Landmarks::progress(const Words& state, std::uint64_t* reached) {
  std::fill(now_.begin(), now_.end(), 0);
  for (int landmark = 0; landmark < size(); ++landmark) {  // those reached now count as earlier ones only afterwards
    if (bit(reached, landmark) || !literal_holds(state.data(), node_[landmark])) continue;
    const bool is_turn = std::all_of(before_[landmark].begin(), before_[landmark].end(),
                                     [&](int earlier) { return bit(reached, earlier); });
    if (is_turn) set_bit(now_.data(), landmark);
  }
  for (std::size_t w = 0; w < words_; ++w) reached[w] |= now_[w];
}

void Landmarks::find_removals(const GroundTask& task) {
  takes_away_.resize(node_.size());
  wanted_.assign(node_.size(), 0);
  std::vector<char> is_first(node_.size(), 1);
  std::vector<int> removed, both;
  for (const Operator& op : task.operators) {
    removed.clear();
    for (const Literal one : op.effects) {
      if (of_node_[one ^ 1] >= 0) removed.push_back(of_node_[one ^ 1]);
    }
    std::sort(removed.begin(), removed.end());
    for (const Literal one : op.effects) {
      const int landmark = of_node_[one];
      if (landmark < 0 || !is_goal_[landmark]) continue;
      both.clear();
      std::vector<int>& away = takes_away_[landmark];
      if (is_first[landmark]) {
        both = removed;
      } else {
        std::set_intersection(away.begin(), away.end(), removed.begin(), removed.end(), std::back_inserter(both));
      }
      is_first[landmark] = 0;
      away = both;
    }
  }
}

// Marks the goals still to be achieved, those held too early included, and what they need first; their number.
int Landmarks::find_wanted(const Words& state) {
  const auto is_true = [&](int landmark) { return literal_holds(state.data(), node_[landmark]); };
  std::fill(wanted_.begin(), wanted_.end(), 0);
  int goals = 0;
  for (const int goal : goals_) {
    if (!is_true(goal)) stack_.push_back(goal);
  }
  while (!stack_.empty()) {
    goals += static_cast<int>(stack_.size());
    while (!stack_.empty()) {
      const int at = stack_.back();
      stack_.pop_back();
      if (wanted_[at]) continue;
      wanted_[at] = 1;
      for (const int before : needs_[at]) {
        if (!wanted_[before] && !is_true(before)) stack_.push_back(before);
      }
    }
    for (const int goal : goals_) {
      const std::vector<int>& away = takes_away_[goal];
      if (wanted_[goal]) continue;
      if (std::any_of(away.begin(), away.end(), [&](int one) { return wanted_[one] != 0; })) stack_.push_back(goal);
    }
  }
  return goals;
}

Landmarks::Ahead Landmarks::judge(const Words& state, std::uint64_t* reached) {
  const auto is_true = [&](int landmark) { return literal_holds(state.data(), node_[landmark]); };
  Ahead ahead;
  ahead.goals = find_wanted(state);
  progress(state, reached);
  for (const int goal : goals_) {
    if (wanted_[goal]) reached[goal >> 6] &= ~(std::uint64_t{1} << (goal & 63));
  }
  for (int landmark = 0; landmark < size(); ++landmark) {
    if (!bit(reached, landmark)) {
      ++ahead.landmarks;
    } else if (!is_true(landmark)) {
      const std::vector<int>& later = needed_for_[landmark];
      const bool is_needed = std::any_of(later.begin(), later.end(), [&](int one) { return !bit(reached, one); });
      if (is_needed) ++ahead.landmarks;
    }
  }
  return ahead;
}

void Landmarks::make_masks() {
  parent_truth_.assign(words_, 0);
  truth_ = wanted_bits_ = reached_bits_ = goal_mask_ = parent_truth_;
  for (const int goal : goals_) set_bit(goal_mask_.data(), goal);
  if (node_.size() > kMostMasked) return;
  const auto fill = [&](std::vector<std::uint64_t>& masks, const std::vector<std::vector<int>>& lists) {
    masks.assign(node_.size() * words_, 0);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      for (const int other : lists[i]) set_bit(masks.data() + i * words_, other);
    }
  };
  fill(before_mask_, before_);
  fill(needs_mask_, needs_);
  fill(needed_for_mask_, needed_for_);
  fill(takes_away_mask_, takes_away_);
}

void Landmarks::begin_successors(const Words& state, const std::uint64_t* reached) {
  parent_ = &state;
  parent_reached_ = reached;
  std::fill(parent_truth_.begin(), parent_truth_.end(), 0);
  for (int landmark = 0; landmark < size(); ++landmark) {
    if (literal_holds(state.data(), node_[landmark])) set_bit(parent_truth_.data(), landmark);
  }
  reached_bits_.assign(reached, reached + words_);
  parent_ahead_ = judge(state, reached_bits_.data());
}

// The landmark and all that it needs and that is not true.
void Landmarks::spread_wanted(int landmark) {
  set_bit(wanted_bits_.data(), landmark);
  stack_.push_back(landmark);
  while (!stack_.empty()) {
    const std::uint64_t* needs = mask(needs_mask_, stack_.back());
    stack_.pop_back();
    for (std::size_t w = 0; w < words_; ++w) {
      std::uint64_t more = needs[w] & ~truth_[w] & ~wanted_bits_[w];
      wanted_bits_[w] |= more;
      for (; more != 0; more &= more - 1) stack_.push_back(static_cast<int>(64 * w) + std::countr_zero(more));
    }
  }
}

Landmarks::Ahead Landmarks::ahead_of(const Words& successor) {
  if (needs_mask_.empty()) {
    reached_bits_.assign(parent_reached_, parent_reached_ + words_);
    return judge(successor, reached_bits_.data());
  }
  truth_ = parent_truth_;
  bool is_same = true;
  for (std::size_t word = 0; word < successor.size(); ++word) {
    for (std::uint64_t changed = successor[word] ^ (*parent_)[word]; changed != 0; changed &= changed - 1) {
      const std::size_t fact = 64 * word + static_cast<std::size_t>(std::countr_zero(changed));
      for (const std::size_t node : {2 * fact, 2 * fact + 1}) {
        const int landmark = of_node_[node];
        if (landmark < 0) continue;
        truth_[landmark >> 6] ^= std::uint64_t{1} << (landmark & 63);
        is_same = false;
      }
    }
  }
  if (is_same) return parent_ahead_;
  const auto each = [&](std::size_t w, std::uint64_t bits, const auto& visit) {
    for (; bits != 0; bits &= bits - 1) visit(static_cast<int>(64 * w) + std::countr_zero(bits));
  };
  const auto meets = [&](const std::uint64_t* a, const auto& b) {
    for (std::size_t w = 0; w < words_; ++w) {
      if ((a[w] & b(w)) != 0) return true;
    }
    return false;
  };
  std::fill(wanted_bits_.begin(), wanted_bits_.end(), 0);
  for (std::size_t w = 0; w < words_; ++w) {
    each(w, goal_mask_[w] & ~truth_[w], [&](int goal) {
      if (!bit(wanted_bits_.data(), goal)) spread_wanted(goal);
    });
  }
  for (bool changed = true; changed;) {  // goals held too early
    changed = false;
    for (std::size_t w = 0; w < words_; ++w) {
      each(w, goal_mask_[w] & ~wanted_bits_[w], [&](int goal) {
        if (!meets(mask(takes_away_mask_, goal), [&](std::size_t v) { return wanted_bits_[v]; })) return;
        spread_wanted(goal);
        changed = true;
      });
    }
  }
  for (std::size_t w = 0; w < words_; ++w) reached_bits_[w] = parent_reached_[w];
  for (std::size_t w = 0; w < words_; ++w) {
    each(w, truth_[w] & ~parent_reached_[w], [&](int landmark) {
      const bool is_turn = !meets(mask(before_mask_, landmark), [&](std::size_t v) { return ~parent_reached_[v]; });
      if (is_turn) set_bit(reached_bits_.data(), landmark);
    });
  }
  Ahead ahead;
  int reached = 0;
  for (std::size_t w = 0; w < words_; ++w) {
    const std::uint64_t wanted_goals = goal_mask_[w] & wanted_bits_[w];
    ahead.goals += std::popcount(wanted_goals);
    reached_bits_[w] &= ~wanted_goals;
    reached += std::popcount(reached_bits_[w]);
  }
  ahead.landmarks = size() - reached;
  for (std::size_t w = 0; w < words_; ++w) {
    each(w, reached_bits_[w] & ~truth_[w], [&](int landmark) {
      if (meets(mask(needed_for_mask_, landmark), [&](std::size_t v) { return ~reached_bits_[v]; })) ++ahead.landmarks;
    });
  }
  return ahead;
}

}  // namespace stampede::symbolic
