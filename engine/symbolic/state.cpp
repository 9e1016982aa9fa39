#include "engine/symbolic/state.h"

#include <algorithm>

namespace stampede::symbolic {

Semantics::Semantics(const GroundTask& task)
    : task_(task), axioms_(task), words_(std::max<std::size_t>(1, (static_cast<std::size_t>(task.facts) + 63) / 64)) {}

Words Semantics::initial() const {
  Words state(words_, 0);
  for (const int fact : task_.initial) assign(state.data(), fact, true);
  axioms_.derive(state.data());
  return state;
}

bool Semantics::applicable(const Words& state, int op) const {
  const Literals& precondition = task_.operators[op].precondition;
  return std::all_of(precondition.begin(), precondition.end(),
                     [&](Literal one) { return literal_holds(state.data(), one); });
}

void Semantics::apply(const Words& state, int op, Words& next) const {
  next = state;
  const Operator& taken = task_.operators[op];
  for (const Literal one : taken.effects) assign(next.data(), one >> 1, (one & 1) == 0);
  for (const bool adding : {false, true}) {  // additions last: they win
    for (const ConditionalEffect& effect : taken.conditional) {
      if (((effect.effect & 1) == 0) != adding) continue;
      const bool fires = std::all_of(effect.when.begin(), effect.when.end(),
                                     [&](Literal one) { return literal_holds(state.data(), one); });
      if (fires) assign(next.data(), effect.effect >> 1, adding);
    }
  }
  if (!taken.conditional.empty()) {
    for (const Literal one : taken.effects) {
      if ((one & 1) == 0) assign(next.data(), one >> 1, true);
    }
  }
  axioms_.update(state.data(), next.data());
}

bool Semantics::is_goal(const Words& state) const {
  return std::all_of(task_.goal.begin(), task_.goal.end(),
                     [&](Literal one) { return literal_holds(state.data(), one); });
}

std::uint64_t StatePool::hash(const std::uint64_t* state) const {
  std::uint64_t value = 0x9e3779b97f4a7c15ULL;
  for (std::size_t i = 0; i < words_; ++i) {
    value = (value ^ state[i]) * 0xff51afd7ed558ccdULL;
    value ^= value >> 32;
  }
  return value;
}

std::pair<int, bool> StatePool::insert(const Words& state) {
  if (static_cast<std::size_t>(count_) * 2 >= slots_.size()) grow();
  const std::size_t mask = slots_.size() - 1;
  std::size_t at = hash(state.data()) & mask;
  while (slots_[at] >= 0) {
    if (std::equal(state.begin(), state.end(), pool_.begin() + static_cast<std::ptrdiff_t>(slots_[at] * words_))) {
      return {slots_[at], false};
    }
    at = (at + 1) & mask;
  }
  slots_[at] = count_;
  pool_.insert(pool_.end(), state.begin(), state.end());
  return {count_++, true};
}

Words StatePool::get(int number) const {
  const auto begin = pool_.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(number) * words_);
  return Words(begin, begin + static_cast<std::ptrdiff_t>(words_));
}

std::int64_t StatePool::bytes() const {
  return static_cast<std::int64_t>(pool_.capacity() * sizeof(std::uint64_t) + slots_.capacity() * sizeof(int));
}

void StatePool::grow() {
  std::vector<int> slots(slots_.size() * 2, -1);
  const std::size_t mask = slots.size() - 1;
  for (int number = 0; number < count_; ++number) {
    std::size_t at = hash(pool_.data() + static_cast<std::size_t>(number) * words_) & mask;
    while (slots[at] >= 0) at = (at + 1) & mask;
    slots[at] = number;
  }
  slots_ = std::move(slots);
}

}  // namespace stampede::symbolic
