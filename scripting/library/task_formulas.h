// What a task's formulas and steps say, against the scene that it will have. Room-internal.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "scripting/library/scene_outline.h"

namespace stampede {

// Of one variation: `fields` are those of the task, drawn for it. Lifetime: borrows all that it is given.
class TaskFormulas {
 public:
  TaskFormulas(LibraryDraft& draft, const Definition& definition, const std::map<std::string, Value>& fields,
               const SceneOutline& scene);
  void check();

 private:
  std::vector<std::string> members(const std::string& group) const;
  std::optional<std::string> object_fault(const std::string& name) const;
  void check_init();
  void check_told();
  void check_goal(const Value& goal);
  void check_order(const std::vector<Formula>& stages);
  void check_fingers(const Value& goal);
  void check_subgoals(const Value& subgoals);
  void check_steps(const Value& steps);
  void check_step(const Value& call);
  // Of a literal of init: the thing that it places, or nothing.
  std::string placed_by(const Literal& literal) const;
  // Objects named in an atom must have the type and traits that its predicate asks for.
  void check_whole(const Formula& formula);  // all that a field asks for
  void check_arguments(const Formula& formula);
  void check_argument(const Formula& named, std::size_t argument, const Parameter& parameter);
  void check_literal(const Literal& literal);
  void check_setting(const SkillInfo& skill, const std::string& name, const Value& value, const std::string& place);
  const Value* field(const char* name) const;

  LibraryDraft& draft_;
  const Domain& domain_;
  const Definition& definition_;
  const std::map<std::string, Value>& fields_;
  const SceneOutline& scene_;
  FormulaContext where_;
  std::set<Fact> said_of_start_;
};

}  // namespace stampede
