// A task's file as a function of its variation. Room-internal.
#pragma once

#include <string>
#include <vector>

#include "scripting/library/draft.h"

namespace stampede {

// All throw Error where the script fails.
class TaskScript {
 public:
  TaskScript(const Definition& definition, DefinitionState& state) : definition_(definition), state_(state) {}
  // The product of the axes or the list, without what `where` leaves out.
  std::vector<Value> variations();
  // What the field is in this variation: functions of it are called.
  Value field(const char* name, const Value& variation);

 private:
  std::vector<Value> product(const Value& axes) const;
  bool keeps(const Value& variation);
  void push_function(const char* field, const Value& variation);

  const Definition& definition_;
  DefinitionState& state_;
};

std::string variation_text(const Value& variation);  // `colour=red,height=3`

}  // namespace stampede
