// What a task's formulas and steps say, against the scene that it will have. Room-internal.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scripting/library/builder.h"

namespace stampede {

using Groups = std::map<std::string, std::vector<std::string>>;  // `block*`: its members

// Of one variation: `fields` are those of the task, drawn for it. Lifetime: borrows all that it is given.
class LibraryBuilder::TaskFormulas {
 public:
  TaskFormulas(LibraryBuilder& builder, const Definition& definition, const std::map<std::string, Value>& fields,
               const SceneObjects& objects, const Groups& groups);
  void check();

 private:
  std::vector<std::string> members(const std::string& group) const;
  std::optional<std::string> object_fault(const std::string& name) const;
  void check_init();
  void check_told();
  void check_goal(const Value& goal);
  void check_subgoals(const Value& subgoals);
  void check_steps(const Value& steps);
  void check_step(const Value& call);
  // Of a literal of init: the thing that it places, or nothing.
  std::string placed_by(const Literal& literal) const;
  // Objects named in an atom must have the type and traits that its predicate asks for.
  void check_arguments(const Formula& formula);
  void check_argument(const Formula& named, std::size_t argument, const Parameter& parameter);
  void check_literal(const Literal& literal);
  void check_setting(const SkillInfo& skill, const std::string& name, const Value& value, const std::string& place);
  const Value* field(const char* name) const;

  LibraryBuilder& builder_;
  const Definition& definition_;
  const std::map<std::string, Value>& fields_;
  const SceneObjects& objects_;
  const Groups& groups_;
  std::vector<std::string> known_;  // names of objects
  FormulaContext where_;
};

}  // namespace stampede
