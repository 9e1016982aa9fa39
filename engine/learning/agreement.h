// How well a learned predicate agrees with true ones, over many atoms at once. Room-internal.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "engine/learning/abstraction.h"

namespace stampede::learning {

using Bits = std::vector<std::uint64_t>;
Confusion confusion(const Bits& said, const Bits& truth, std::size_t count);

// Frames with numbers for names, facts by predicate.
class NumberedFrames {
 public:
  using Tuple = std::vector<int>;
  explicit NumberedFrames(const std::vector<const JudgedFrame*>& frames);

  struct Predicate {
    std::size_t arity = 0;
    bool changes = false;                   // within one scene
    std::vector<std::string> only_of;       // by argument: the type that has one object in every scene; empty: none
    std::vector<std::vector<Tuple>> facts;  // by frame
  };
  const std::map<std::string, Predicate>& truths() const { return truths_; }
  std::size_t size() const { return frames_.size(); }
  const JudgedFrame& frame(std::size_t index) const { return *frames_[index]; }
  Tuple numbered(const std::vector<std::string>& arguments);

 private:
  void find_only_ones();
  std::vector<const JudgedFrame*> frames_;
  std::map<std::string, int> numbers_;
  std::map<std::string, Predicate> truths_;
};

// All that is said of one learned predicate, and each meaning that a single true literal can give it.
struct Meaning {
  LinkPart part;
  Bits holds;            // by atom, of the part as it is (negated or not)
  double agreement = 0;  // not negative: `part.negated` takes the sign
  double spoken_of = 0;  // share of the true facts that the table has a row for
  double gain = 0;       // agreement times that
  Confusion confusion;
};

class SaidAtoms {
 public:
  SaidAtoms(const std::string& predicate, std::size_t arity, NumberedFrames& frames);
  std::size_t count() const { return count_; }
  const Bits& said() const { return said_; }
  // Agreement that chance does not give: as many independent values as either has stretches without a change.
  double least(const Bits& holds) const;
  // By true predicate: the best order of arguments.
  std::map<std::string, Meaning> meanings(const NumberedFrames& frames) const;
  void each_meaning(const NumberedFrames& frames, const std::function<void(Meaning)>& visit) const;

 private:
  struct Atom {
    std::size_t frame;
    NumberedFrames::Tuple arguments;
  };
  Meaning meaning(const std::string& truth, const NumberedFrames::Predicate& predicate,
                  const std::vector<int>& argument_of) const;
  std::size_t stretches(const Bits& bits) const;
  std::size_t arity_, count_ = 0;
  std::vector<Atom> atoms_;    // by frame
  std::vector<int> previous_;  // by atom: the same one in the frame before, -1: none
  Bits said_;
};

}  // namespace stampede::learning
