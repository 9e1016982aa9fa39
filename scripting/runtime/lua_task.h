// A task file, evaluated for one variation.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "scripting/runtime/assets.h"
#include "scripting/runtime/script_state.h"
#include "scripting/runtime/value.h"

namespace stampede {

class LuaTask : public Task {
 public:
  // Throws Error for an unknown task or variation and for mistakes in its files. Sets the hand of `tests`.
  LuaTask(TestState& tests, std::string_view name, std::string_view variation, std::int64_t seed);

  std::string name() const override { return name_; }
  std::string variation() const override { return variation_; }
  std::map<std::string, std::string> axes() const override { return axes_; }
  Scene scene(int draw) override;
  std::optional<Randomisation> randomisation() const override { return drawn_.randomisation; }
  ObservationChoice observation() const override { return drawn_.observation; }
  std::vector<std::string> unplaced() const override { return drawn_.unplaced; }
  std::vector<Literal> init() const override { return drawn_.init; }
  std::optional<Formula> where() const override { return drawn_.where; }
  Formula goal() const override { return drawn_.goal; }
  std::vector<Formula> stages() const override { return drawn_.stages; }
  std::optional<std::vector<PlanStep>> steps() const override { return drawn_.steps; }
  std::vector<std::pair<std::string, Formula>> subgoals() const override { return drawn_.subgoals; }
  bool also(const WorldView& view) override;
  bool has_also() const override;
  bool fails(const WorldView& view) override;
  double reward(const WorldView& view) override;
  double hold_s() const override { return drawn_.hold_s; }
  double horizon_s() const override { return drawn_.horizon_s; }
  std::vector<std::string> instructions() const override { return drawn_.instructions; }

  std::vector<const ScriptFile*> files() const { return drawn_.files; }  // that took part, beside predicates and skills

  // All that depends on the draw.
  struct Drawn {
    Scene scene;
    std::optional<Randomisation> randomisation;
    ObservationChoice observation;
    std::string hand;
    std::map<std::string, std::vector<std::string>> groups;  // `block` -> block1 …
    std::vector<std::string> unplaced;
    std::vector<Literal> init;
    std::optional<Formula> where;
    Formula goal;
    std::vector<Formula> stages;
    std::optional<std::vector<PlanStep>> steps;
    std::vector<std::pair<std::string, Formula>> subgoals;
    std::vector<std::string> instructions;
    std::vector<const ScriptFile*> files;
    double hold_s = 1, horizon_s = 120;
  };

 private:
  // Calls the task's own test and leaves its result on the stack; false (and nothing) where it has none.
  bool call_test(const char* field, const WorldView& view);
  Drawn make(int draw);

  TestState& tests_;
  std::string name_, variation_;
  std::int64_t seed_;
  std::map<std::string, std::string> axes_;
  int draw_ = 0;
  Assets assets_;
  Drawn drawn_;
  int keep_variation();

  std::map<std::string, int> functions_;  // registry references of the tests' state
  int v_ = 0;
  int generation_ = -1;
};

}  // namespace stampede
