#include "engine/symbolic/landmarks.h"

#include <algorithm>

namespace stampede::symbolic {

Landmarks::Landmarks(const GroundTask& task, const Relaxation& relaxation, const Words& start)
    : graph_(task, relaxation, start), bits_(graph_), wanted_(graph_.node.size(), 0), now_(graph_.words(), 0) {}

void Landmarks::progress(const Words& state, std::uint64_t* reached) {
  std::fill(now_.begin(), now_.end(), 0);
  for (int landmark = 0; landmark < size(); ++landmark) {  // those reached now count as earlier ones only afterwards
    if (has_bit(reached, landmark) || !literal_holds(state.data(), graph_.node[landmark])) continue;
    const bool is_turn = std::all_of(graph_.before[landmark].begin(), graph_.before[landmark].end(),
                                     [&](int earlier) { return has_bit(reached, earlier); });
    if (is_turn) set_bit(now_.data(), landmark);
  }
  for (std::size_t w = 0; w < words(); ++w) reached[w] |= now_[w];
}

// Marks the goals still to be achieved, those held too early included, and what they need first; their number.
int Landmarks::find_wanted(const Words& state) {
  const auto is_true = [&](int landmark) { return literal_holds(state.data(), graph_.node[landmark]); };
  std::fill(wanted_.begin(), wanted_.end(), 0);
  int goals = 0;
  for (const int goal : graph_.goals) {
    if (!is_true(goal)) stack_.push_back(goal);
  }
  while (!stack_.empty()) {
    goals += static_cast<int>(stack_.size());
    while (!stack_.empty()) {
      const int at = stack_.back();
      stack_.pop_back();
      if (wanted_[at]) continue;
      wanted_[at] = 1;
      for (const int before : graph_.needs[at]) {
        if (!wanted_[before] && !is_true(before)) stack_.push_back(before);
      }
    }
    for (const int goal : graph_.goals) {
      const std::vector<int>& away = graph_.takes_away[goal];
      if (wanted_[goal]) continue;
      if (std::any_of(away.begin(), away.end(), [&](int one) { return wanted_[one] != 0; })) stack_.push_back(goal);
    }
  }
  return goals;
}

Landmarks::Ahead Landmarks::judge(const Words& state, std::uint64_t* reached) {
  const auto is_true = [&](int landmark) { return literal_holds(state.data(), graph_.node[landmark]); };
  Ahead ahead;
  ahead.goals = find_wanted(state);
  progress(state, reached);
  for (const int goal : graph_.goals) {
    if (wanted_[goal]) reached[goal >> 6] &= ~(std::uint64_t{1} << (goal & 63));
  }
  for (int landmark = 0; landmark < size(); ++landmark) {
    if (!has_bit(reached, landmark)) {
      ++ahead.landmarks;
    } else if (!is_true(landmark)) {
      const std::vector<int>& later = graph_.needed_for[landmark];
      const bool is_needed = std::any_of(later.begin(), later.end(), [&](int one) { return !has_bit(reached, one); });
      if (is_needed) ++ahead.landmarks;
    }
  }
  return ahead;
}

void Landmarks::begin_successors(const Words& state, const std::uint64_t* reached) {
  parent_reached_ = reached;
  if (bits_.empty()) return;
  reached_.assign(reached, reached + words());
  bits_.begin_successors(state, reached, judge(state, reached_.data()));
}

Landmarks::Ahead Landmarks::ahead_of(const Words& successor) {
  if (!bits_.empty()) return bits_.ahead_of(successor);
  reached_.assign(parent_reached_, parent_reached_ + words());
  return judge(successor, reached_.data());
}

}  // namespace stampede::symbolic
