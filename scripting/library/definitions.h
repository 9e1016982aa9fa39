// Reaching the Lua side of definitions: one fresh state per episode, from the library's cached bytecode.
#pragma once

#include <memory>

#include "scripting/library/library.h"
#include "scripting/lua/sandbox.h"

namespace stampede {

// The words of the authoring language (task, skill, predicate, object, world, robot, is, is_not, act, one_of, between,
// sample_of, any_order, any_of, all_of, forall, exists, in_order, when, stream, each, colours, deg, pddl …) defined in
// a sandbox, so that a definition file can run there. Written mostly in Lua (scripting/library/prelude.lua, embedded).
class DefinitionState {
 public:
  explicit DefinitionState(std::shared_ptr<const Library> library, const SandboxLimits& limits = {});
  ~DefinitionState();
  Sandbox& sandbox();
  lua_State* state();
  const Library& library() const;

  // Pushes the definition's table: fields as the author wrote them, plus `kind` and `name`. Each file runs once per
  // state. Values that are to be drawn (one_of …), literals (is.on(…)) and calls (act.pick(…)) are tables with a field
  // `tag` = "one_of" | "between" | "sample_of" | "literal" | "call" | "stream" | "formula" …; prelude.lua documents
  // each form. Throws Error.
  void push(DefinitionKind kind, std::string_view name);
  // Forgets what was pushed, and the modules that it required. Not after an Error.
  void start_afresh();

 private:
  void extend(const ScriptFile& file);

  struct Impl;
  std::unique_ptr<Impl> impl_;
  std::vector<std::string> extending_;  // skills or predicates, by those that extend them
};

// The table at `variation`, what a task's functions see of one, knows the axes of the task's `variations` (at the other
// index): one that no variation has is an error that names the nearest. Call it inside a protected call.
void name_axes(lua_State* state, int variation, int variations);

}  // namespace stampede
