#include "engine/base/naming.h"
#include "scripting/library/library.h"

namespace stampede {

std::string new_file(DefinitionKind kind, std::string_view name) {
  if (const auto fault = name_fault(name)) {
    throw Error(std::string(name), "the name '" + std::string(name) + "' " + *fault,
                "such as '" + proposed_name(name) + "'");
  }
  switch (kind) {
    case DefinitionKind::task:
      return "-- Lift a cube: say here in one line what is to be done.\n"
             "return task {\n"
             "  objects = { item = { \"cube\", colour = \"red\" } },\n"
             "  init = { is.on(\"item\", \"table\") },\n"
             "  goal = is.lifted(\"item\"),\n"
             "  instructions = { \"pick up the cube\" },\n"
             "}\n";
    case DefinitionKind::skill:
      return "-- Hold still for a while: say here in one line what the arm does.\n"
             "return skill {\n"
             "  params = { \"obj: movable\" },\n"
             "  precondition = { is.holding(\"obj\") },\n"
             "  effect = { is.holding(\"obj\") },\n"
             "  continuous = { duration = { 0.5, min = 0.1, max = 5, unit = \"s\" } },\n"
             "  label = \"hold the {obj} still\",\n"
             "  run = function(robot, p, c) robot:wait(c.duration) end,\n"
             "}\n";
    case DefinitionKind::predicate:
      return "-- The object is higher than 1 m above the floor: say here when the fact holds.\n"
             "return predicate {\n"
             "  params = { \"obj: movable\" },\n"
             "  label = \"the {obj} is high up\",\n"
             "  settle = 0.1, -- s\n"
             "  holds = function(w, obj) return w:bottom(obj) > 1.0 end,\n"
             "}\n";
    case DefinitionKind::object:
      return "-- A small block: say here in one line what it is.\n"
             "return object {\n"
             "  type = \"block\", traits = { \"movable\", \"graspable\" },\n"
             "  shape = box { 0.04, 0.04, 0.04 }, mass = 0.05, colour = \"red\",\n"
             "}\n";
    case DefinitionKind::world:
      return "-- One arm behind a table: say here in one line where tasks take place.\n"
             "return world {\n"
             "  robot = { \"panda\", at = { -0.30, 0, 0.75 } },\n"
             "  fixtures = { table = { \"work_table\", at = { 0.19, 0, 0.75 } } },\n"
             "}\n";
    default:
      throw Error(std::string(to_string(kind)), "there is no template for this kind",
                  "task, skill, predicate, object or world");
  }
}

}  // namespace stampede
