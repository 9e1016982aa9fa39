// What a script's function could carry from one call to the next.
#pragma once

#include <optional>
#include <vector>

struct lua_State;

namespace stampede {

struct KeptValue {
  int type = 0;
  const void* pointer = nullptr;  // of strings and functions
  double number = 0;
  long long integer = 0;  // of booleans, too
  friend bool operator==(const KeptValue&, const KeptValue&) = default;
};

// The variables outside the function on top of the stack that it and the functions it calls by them can assign to, in
// order. Nothing where one of them is a table or the like, which might change in itself. Equal before and after a call
// of a function that requires no modules: the call has left no trace.
std::optional<std::vector<KeptValue>> kept_values(lua_State* state);

}  // namespace stampede
