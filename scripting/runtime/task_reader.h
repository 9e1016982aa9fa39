// From the task's Lua table to what one draw of it says. For the runtime's own use; call it inside a protected call.
#pragma once

#include "scripting/library/formula_reader.h"
#include "scripting/runtime/lua_task.h"
#include "scripting/runtime/scene_builder.h"
#include "scripting/runtime/stage.h"

namespace stampede {

class TaskReader {
 public:
  TaskReader(ScriptState& scripts, const ScriptFile& file, const std::map<std::string, std::string>& axes,
             RandomKey key, Assets& assets);
  LuaTask::Drawn read(lua_State* state, int further_things);
  // What stands around whatever the task: a world's fixtures, or nothing, and a robot. `file` is then the world's or
  // the robot's own.
  Stage read_stage(lua_State* state, const StageRequest& request);
  // A world as every task has it; `file` is the world's.
  Scene read_world_alone(lua_State* state);

 private:
  Value field(const char* name);  // of the task, drawn
  bool has_function(const char* name);
  bool push_field(const char* name);  // called if it is a function; false (nothing pushed): absent
  void read_world(const std::string& name, const Value& world);
  void read_robot(const Value& robot, bool driven);
  void read_looks(const Value& world, const std::filesystem::path& folder);  // light, randomisation, classes
  void set_classes();
  void read_calibration(const Value& file, const std::filesystem::path& folder);
  void forget_absent_classes();
  void read_objects();
  void add_group(const std::string& name, int index);
  void add_clutter(int further_things);
  void place_clutter();
  void read_init();
  void read_told();
  void read_goal();
  void read_subgoals();
  void read_steps();
  void read_instructions();
  std::string filled(const std::string& text) const;

  ObjectSource source_of(const Value& spec, const std::string& name, const std::string& path);
  Value definition(DefinitionKind kind, const std::string& name, const std::string& path, const Value& where,
                   std::vector<std::string> skip = {});
  const ScriptFile& used(DefinitionKind kind, const std::string& name, const Value& where);
  std::vector<std::string> members(const std::string& group) const;
  FormulaContext context_of(const std::string& field) const;

  ScriptState& scripts_;
  const ScriptFile& file_;
  const std::map<std::string, std::string>& axes_;
  RandomKey key_;
  Assets& assets_;
  lua_State* state_ = nullptr;
  int task_ = 0, variation_ = 0;  // stack indices
  Colours colours_;
  std::unique_ptr<SceneBuilder> builder_;
  std::optional<double> table_top_;  // what on_table means in this world, m
  LuaTask::Drawn drawn_;
};

}  // namespace stampede
