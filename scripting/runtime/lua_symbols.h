// Predicates of one episode.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "engine/start/predicates.h"
#include "scripting/runtime/kept_values.h"
#include "scripting/runtime/script_state.h"

namespace stampede {

class LuaSymbols : public Symbols {
 public:
  LuaSymbols(TestState& tests, std::string_view task)
      : tests_(tests), task_(task), domain_(tests.library()->domain_of(task)) {}
  const Domain& domain() const override { return domain_; }
  PredicateTraits traits(const std::string& predicate) const override;
  // Traits and attributes are read from the scene's objects, all else by the predicate's `holds`.
  Value value(const Fact& fact, const WorldView& view) override;
  // A predicate hides where its file or the task says `observable`, which are then asked of a fact at a moment.
  bool can_hide(const std::string& predicate) const override;
  bool observable(const Fact& fact, const WorldView& view) override;
  // A sample depends on its arguments only: each has a fresh state, or one in which no other sample has left anything.
  std::vector<Placement> sample(const Fact& fact, const WorldView& view, const CollisionState& state, RandomKey key,
                                int most) override;
  void watch(std::vector<Looked>* turned_down) override { turned_down_ = turned_down; }
  std::string asked_at(const Fact& fact) const override;

 private:
  // A predicate's function, as registry reference; 0: it has none.
  using Functions = std::unordered_map<std::string, int>;  // looked up only
  int function_of(Functions& known, const char* field, const std::string& predicate);
  void forget_void();
  bool hidden_by_task(const std::string& predicate) const;
  int seen_in_task(const std::string& predicate);  // the task's own function, or 0
  Value call(int function, const Fact& fact, const WorldView& view);

  struct Sampler {  // a predicate's `sample` in a state of its own
    std::unique_ptr<ScriptState> scripts;
    int function = 0;  // 0: it has none
    std::optional<std::vector<KeptValue>> kept;
  };
  Sampler sampler(const std::string& predicate);

  // What a predicate complains of, at the place where the task asked for the fact.
  Error asked_by_task(const Fact& fact, const Error& error) const;

  TestState& tests_;
  std::string task_;
  const Domain& domain_;
  std::unordered_map<std::string, Sampler> samplers_;  // as good as fresh
  Functions holds_, observable_, seen_in_task_;
  int generation_ = -1;
  std::vector<Looked>* turned_down_ = nullptr;
};

}  // namespace stampede
