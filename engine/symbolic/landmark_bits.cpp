#include "engine/symbolic/landmark_bits.h"

#include <algorithm>
#include <bit>

namespace stampede::symbolic {
namespace {

constexpr std::size_t kMostMasked = 8000;  // landmarks: 32 MB of masks

// Calls visit(number) for each bit of word `w` of a set.
template <typename Visit>
void for_bits(std::size_t w, std::uint64_t bits, const Visit& visit) {
  for (; bits != 0; bits &= bits - 1) visit(static_cast<int>(64 * w) + std::countr_zero(bits));
}

}  // namespace

LandmarkBits::LandmarkBits(const LandmarkGraph& graph) : graph_(graph), words_(graph.words()) {
  if (graph.node.size() > kMostMasked) return;
  parent_truth_.assign(words_, 0);
  truth_ = wanted_ = reached_ = goals_ = parent_truth_;
  for (const int goal : graph.goals) set_bit(goals_.data(), goal);
  const auto fill = [&](Bits& masks, const std::vector<std::vector<int>>& lists) {
    masks.assign(graph.node.size() * words_, 0);
    for (std::size_t i = 0; i < lists.size(); ++i) {
      for (const int other : lists[i]) set_bit(masks.data() + i * words_, other);
    }
  };
  fill(before_, graph.before);
  fill(needs_, graph.needs);
  fill(needed_for_, graph.needed_for);
  fill(takes_away_, graph.takes_away);
}

void LandmarkBits::begin_successors(const Words& state, const std::uint64_t* reached, LandmarksAhead same) {
  parent_ = &state;
  parent_reached_ = reached;
  same_ = same;
  std::fill(parent_truth_.begin(), parent_truth_.end(), 0);
  for (int landmark = 0; landmark < graph_.size(); ++landmark) {
    if (literal_holds(state.data(), graph_.node[landmark])) set_bit(parent_truth_.data(), landmark);
  }
}

// False: the same landmarks are true as in the state before.
bool LandmarkBits::find_truth(const Words& successor) {
  truth_ = parent_truth_;
  bool differs = false;
  for (std::size_t word = 0; word < successor.size(); ++word) {
    for_bits(word, successor[word] ^ (*parent_)[word], [&](int fact) {
      for (const int node : {2 * fact, 2 * fact + 1}) {
        const int landmark = graph_.of_node[node];
        if (landmark < 0) continue;
        truth_[landmark >> 6] ^= std::uint64_t{1} << (landmark & 63);
        differs = true;
      }
    });
  }
  return differs;
}

// The landmark and all that it needs and that is not true.
void LandmarkBits::spread_wanted(int landmark) {
  set_bit(wanted_.data(), landmark);
  stack_.push_back(landmark);
  while (!stack_.empty()) {
    const std::uint64_t* needs = mask(needs_, stack_.back());
    stack_.pop_back();
    for (std::size_t w = 0; w < words_; ++w) {
      const std::uint64_t more = needs[w] & ~truth_[w] & ~wanted_[w];
      wanted_[w] |= more;
      for_bits(w, more, [&](int needed) { stack_.push_back(needed); });
    }
  }
}

void LandmarkBits::find_wanted() {
  std::fill(wanted_.begin(), wanted_.end(), 0);
  for (std::size_t w = 0; w < words_; ++w) {
    for_bits(w, goals_[w] & ~truth_[w], [&](int goal) {
      if (!has_bit(wanted_.data(), goal)) spread_wanted(goal);
    });
  }
  for (bool changed = true; changed;) {  // goals held too early
    changed = false;
    for (std::size_t w = 0; w < words_; ++w) {
      for_bits(w, goals_[w] & ~wanted_[w], [&](int goal) {
        const std::uint64_t* away = mask(takes_away_, goal);
        for (std::size_t v = 0; v < words_; ++v) {
          if ((away[v] & wanted_[v]) == 0) continue;
          spread_wanted(goal);
          changed = true;
          return;
        }
      });
    }
  }
}

// As Landmarks::judge leaves it.
void LandmarkBits::find_reached() {
  const auto is_turn = [&](int landmark) {
    const std::uint64_t* before = mask(before_, landmark);
    for (std::size_t v = 0; v < words_; ++v) {
      if ((before[v] & ~parent_reached_[v]) != 0) return false;
    }
    return true;
  };
  for (std::size_t w = 0; w < words_; ++w) reached_[w] = parent_reached_[w];
  for (std::size_t w = 0; w < words_; ++w) {
    for_bits(w, truth_[w] & ~parent_reached_[w], [&](int landmark) {
      if (is_turn(landmark)) set_bit(reached_.data(), landmark);
    });
  }
  for (std::size_t w = 0; w < words_; ++w) reached_[w] &= ~(goals_[w] & wanted_[w]);
}

LandmarksAhead LandmarkBits::count() const {
  const auto is_needed = [&](int landmark) {
    const std::uint64_t* later = mask(needed_for_, landmark);
    for (std::size_t v = 0; v < words_; ++v) {
      if ((later[v] & ~reached_[v]) != 0) return true;
    }
    return false;
  };
  LandmarksAhead ahead;
  ahead.landmarks = graph_.size();
  for (std::size_t w = 0; w < words_; ++w) {
    ahead.goals += std::popcount(goals_[w] & wanted_[w]);
    ahead.landmarks -= std::popcount(reached_[w]);
    for_bits(w, reached_[w] & ~truth_[w], [&](int landmark) { ahead.landmarks += is_needed(landmark) ? 1 : 0; });
  }
  return ahead;
}

LandmarksAhead LandmarkBits::ahead_of(const Words& successor) {
  if (!find_truth(successor)) return same_;
  find_wanted();
  find_reached();
  return count();
}

}  // namespace stampede::symbolic
