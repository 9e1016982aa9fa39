// Predicates of one episode.
#pragma once

#include <string>
#include <unordered_map>

#include "scripting/runtime/script_state.h"

namespace stampede {

class LuaSymbols : public Symbols {
 public:
  explicit LuaSymbols(TestState& tests) : tests_(tests) {}
  const Domain& domain() const override { return tests_.library()->domain(); }
  PredicateTraits traits(const std::string& predicate) const override;
  // Traits and attributes are read from the scene's objects, all else by the predicate's `holds`.
  Value value(const Fact& fact, const WorldView& view) override;
  // In a fresh state each time: a sample depends on its arguments only.
  std::vector<Placement> sample(const Fact& fact, const WorldView& view, CollisionSpace& space, RandomKey key,
                                int most) override;

 private:
  int holds_of(const std::string& predicate);  // registry reference, 0: it has none
  Value call(int holds, const Fact& fact, const WorldView& view);

  TestState& tests_;
  std::unordered_map<std::string, int> holds_;  // looked up only
  int generation_ = -1;
};

}  // namespace stampede
