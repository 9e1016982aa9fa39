#include "engine/learning/agreement.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <functional>
#include <set>

namespace stampede::learning {
namespace {

constexpr double kSurelyAgrees = 0.95;  // by chance hardly ever, however little there is to judge by

Bits no_bits(std::size_t count) { return Bits((count + 63) / 64, 0); }
void set(Bits& bits, std::size_t at) { bits[at / 64] |= std::uint64_t{1} << (at % 64); }
bool test(const Bits& bits, std::size_t at) { return (bits[at / 64] >> (at % 64) & 1) != 0; }

// Calls `visit` with every way to give true arguments learned ones, as many as there are of the fewer, each once.
void each_order(std::size_t truths, std::size_t learned, const std::function<void(const std::vector<int>&)>& visit) {
  std::vector<int> argument_of(truths, -1);
  const std::size_t needed = std::min(truths, learned);
  const std::function<void(std::size_t, std::size_t)> extend = [&](std::size_t at, std::size_t given) {
    if (at == truths) {
      if (given == needed) visit(argument_of);
      return;
    }
    for (std::size_t one = 0; one < learned; ++one) {
      if (std::find(argument_of.begin(), argument_of.end(), static_cast<int>(one)) != argument_of.end()) continue;
      argument_of[at] = static_cast<int>(one);
      extend(at + 1, given + 1);
      argument_of[at] = -1;
    }
    extend(at + 1, given);
  };
  extend(0, 0);
}

}  // namespace

Confusion confusion(const Bits& said, const Bits& truth, std::size_t count) {
  Confusion result;
  for (std::size_t i = 0; i < said.size(); ++i) {
    result.both += std::popcount(said[i] & truth[i]);
    result.only_said += std::popcount(said[i] & ~truth[i]);
    result.only_true += std::popcount(~said[i] & truth[i]);
  }
  result.neither = static_cast<std::int64_t>(count) - result.both - result.only_said - result.only_true;
  return result;
}

NumberedFrames::NumberedFrames(const std::vector<const JudgedFrame*>& frames) : frames_(frames) {
  for (std::size_t i = 0; i < frames_.size(); ++i)
    for (const Fact& fact : frames_[i]->truth) {
      Predicate& predicate = truths_[fact.predicate];
      predicate.arity = fact.arguments.size();
      predicate.facts.resize(frames_.size());
      predicate.facts[i].push_back(numbered(fact.arguments));
    }
  for (auto& [name, predicate] : truths_)
    for (std::size_t i = 1; i < frames_.size(); ++i)
      predicate.changes |=
          frames_[i]->objects == frames_[i - 1]->objects && predicate.facts[i] != predicate.facts[i - 1];
  find_only_ones();
}

NumberedFrames::Tuple NumberedFrames::numbered(const std::vector<std::string>& arguments) {
  Tuple tuple;
  for (const std::string& one : arguments)
    tuple.push_back(numbers_.insert({one, static_cast<int>(numbers_.size())}).first->second);
  return tuple;
}

void NumberedFrames::find_only_ones() {
  std::set<std::string> many;
  std::set<Objects> scenes;
  for (const JudgedFrame* frame : frames_) {
    if (!scenes.insert(frame->objects).second) continue;
    std::map<std::string, int> counts;
    for (const TypedObject& one : *frame->objects)
      if (++counts[one.type] > 1) many.insert(one.type);
  }
  for (auto& [name, predicate] : truths_) {
    std::vector<std::set<std::string>> types(predicate.arity);
    for (const JudgedFrame* frame : frames_) {
      std::map<std::string, const std::string*> type_of;
      for (const TypedObject& one : *frame->objects) type_of[one.name] = &one.type;
      for (const Fact& fact : frame->truth) {
        if (fact.predicate != name) continue;
        for (std::size_t i = 0; i < predicate.arity && i < fact.arguments.size(); ++i)
          if (const auto at = type_of.find(fact.arguments[i]); at != type_of.end()) types[i].insert(*at->second);
      }
    }
    for (const std::set<std::string>& one : types)
      predicate.only_of.push_back(one.size() == 1 && !many.contains(*one.begin()) ? *one.begin() : std::string());
  }
}

SaidAtoms::SaidAtoms(const std::string& predicate, std::size_t arity, NumberedFrames& frames) : arity_(arity) {
  std::vector<char> truths;
  for (std::size_t i = 0; i < frames.size(); ++i)
    for (const bool yes : {true, false})
      for (const Fact& fact : yes ? frames.frame(i).yes : frames.frame(i).no) {
        if (fact.predicate != predicate || fact.arguments.size() != arity) continue;
        atoms_.push_back({i, frames.numbered(fact.arguments)});
        truths.push_back(yes ? 1 : 0);
      }
  count_ = atoms_.size();
  std::map<std::pair<const void*, NumberedFrames::Tuple>, int> latest;
  for (std::size_t i = 0; i < count_; ++i) {
    const auto [at, fresh] = latest.insert({{frames.frame(atoms_[i].frame).objects.get(), atoms_[i].arguments}, -1});
    previous_.push_back(at->second);
    at->second = static_cast<int>(i);
  }
  said_ = no_bits(count_);
  for (std::size_t i = 0; i < count_; ++i)
    if (truths[i] != 0) set(said_, i);
}

std::size_t SaidAtoms::stretches(const Bits& bits) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < count_; ++i)
    count += previous_[i] < 0 || test(bits, i) != test(bits, static_cast<std::size_t>(previous_[i]));
  return count;
}

double SaidAtoms::least(const Bits& holds) const {
  const auto independent = static_cast<double>(std::max<std::size_t>(1, std::min(stretches(said_), stretches(holds))));
  return std::max(kLeastAgreement, std::min(kSurelyAgrees, 4 / std::sqrt(independent)));
}

Meaning SaidAtoms::meaning(const std::string& truth, const NumberedFrames::Predicate& predicate,
                           const std::vector<int>& argument_of) const {
  Meaning found;
  found.part = {truth, argument_of, std::vector<std::string>(argument_of.size()), false};
  std::vector<std::size_t> true_places, places;  // that are compared, of both sides
  for (std::size_t i = 0; i < argument_of.size(); ++i) {
    if (argument_of[i] < 0) {
      found.part.only_of[i] = predicate.only_of[i];
      continue;
    }
    true_places.push_back(i);
    places.push_back(static_cast<std::size_t>(argument_of[i]));
  }
  const auto key = [](const NumberedFrames::Tuple& tuple, const std::vector<std::size_t>& of) {
    NumberedFrames::Tuple part;
    for (const std::size_t one : of) part.push_back(tuple[one]);
    return part;
  };
  found.holds = no_bits(count_);
  std::int64_t facts = 0, spoken_of = 0;
  for (std::size_t from = 0, frame = 0; frame < predicate.facts.size(); ++frame) {
    std::set<NumberedFrames::Tuple> here, seen;
    for (const NumberedFrames::Tuple& one : predicate.facts[frame]) here.insert(key(one, true_places));
    for (; from < count_ && atoms_[from].frame == frame; ++from) {
      const NumberedFrames::Tuple tuple = key(atoms_[from].arguments, places);
      if (!here.contains(tuple)) continue;
      set(found.holds, from);
      seen.insert(tuple);
    }
    facts += static_cast<std::int64_t>(here.size());
    spoken_of += static_cast<std::int64_t>(seen.size());
  }
  found.confusion = confusion(said_, found.holds, count_);
  const double mcc = found.confusion.mcc();
  if (mcc < 0) {
    found.part.negated = true;
    for (std::uint64_t& word : found.holds) word = ~word;
    if (count_ % 64 != 0 && !found.holds.empty()) found.holds.back() &= (std::uint64_t{1} << (count_ % 64)) - 1;
    found.confusion = confusion(said_, found.holds, count_);
  }
  found.agreement = std::abs(mcc);
  found.spoken_of = facts == 0 ? 0 : static_cast<double>(spoken_of) / static_cast<double>(facts);
  found.gain = found.agreement * found.spoken_of;
  // Of meanings that agree alike, the simpler one.
  if (predicate.changes) found.gain *= 1 + 1e-6;
  if (predicate.arity == arity_) found.gain *= 1 + 1e-6;
  if (!found.part.negated) found.gain *= 1 + 1e-7;
  return found;
}

void SaidAtoms::each_meaning(const NumberedFrames& frames, const std::function<void(Meaning)>& visit) const {
  for (const auto& [truth, predicate] : frames.truths())
    each_order(predicate.arity, arity_, [&, &name = truth, &of = predicate](const std::vector<int>& argument_of) {
      visit(meaning(name, of, argument_of));
    });
}

std::map<std::string, Meaning> SaidAtoms::meanings(const NumberedFrames& frames) const {
  std::map<std::string, Meaning> best;
  each_meaning(frames, [&](Meaning one) {
    const auto known = best.find(one.part.truth);
    if (known == best.end()) {
      best.insert({one.part.truth, std::move(one)});
    } else if (one.gain > known->second.gain) {
      known->second = std::move(one);
    }
  });
  return best;
}

}  // namespace stampede::learning
