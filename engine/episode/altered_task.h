// A task with what the run's options change of it: its start is constrained further, or its goal is another.
#pragma once

#include "engine/episode/runner.h"

namespace stampede {

// Lifetime: refers to the task. With another goal the task's own steps, stages, subgoals and tests are left out.
class AlteredTask : public Task {
 public:
  // Throws Error for a goal that speaks of what the task's scene does not have.
  AlteredTask(Task& task, const Symbols& symbols, const RunOptions& options);
  std::string name() const override { return task_.name(); }
  std::string variation() const override { return task_.variation(); }
  std::map<std::string, std::string> axes() const override { return task_.axes(); }
  Scene scene(int draw) override { return task_.scene(draw); }
  std::optional<Randomisation> randomisation() const override { return task_.randomisation(); }
  ObservationChoice observation() const override { return task_.observation(); }
  std::vector<std::string> unplaced() const override { return task_.unplaced(); }
  std::vector<Literal> init() const override { return task_.init(); }
  std::optional<Formula> where() const override { return where_; }
  Formula goal() const override { return goal_ ? *goal_ : task_.goal(); }
  std::vector<Formula> stages() const override { return goal_ ? std::vector<Formula>{} : task_.stages(); }
  std::optional<std::vector<PlanStep>> steps() const override { return goal_ ? std::nullopt : task_.steps(); }
  std::vector<std::pair<std::string, Formula>> subgoals() const override {
    return goal_ ? std::vector<std::pair<std::string, Formula>>{} : task_.subgoals();
  }
  bool also(const WorldView& view) override { return goal_ || task_.also(view); }
  bool has_also() const override { return !goal_ && task_.has_also(); }
  bool fails(const WorldView& view) override { return !goal_ && task_.fails(view); }
  double reward(const WorldView& view) override { return goal_ ? 0 : task_.reward(view); }
  double hold_s() const override { return task_.hold_s(); }
  double horizon_s() const override { return task_.horizon_s(); }
  std::vector<std::string> instructions() const override { return goal_ ? instructions_ : task_.instructions(); }

 private:
  Task& task_;
  std::optional<Formula> where_, goal_;
  std::vector<std::string> instructions_;
};

}  // namespace stampede
