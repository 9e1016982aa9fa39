// The editor's definition file (LuaLS), made from the field tables.
#include <algorithm>
#include <string>

#include "scripting/library/fields.h"

namespace stampede {
namespace {

std::string class_name(std::string_view record) { return "stampede." + std::string(record); }

std::string one_type(std::string_view type) {
  if (type.front() == '{') return "table<string, " + one_type(type.substr(1, type.size() - 2)) + ">";
  if (type.ends_with("[]")) return one_type(type.substr(0, type.size() - 2)) + "[]";
  if (type == "vector" || type == "range" || type == "size" || type == "numbers") return "number[]";
  if (type == "colour") return "string|number[]";
  if (type == "cover") return "string|" + class_name("texture");
  if (type == "function") return "fun(...): any";
  if (type == "literal" || type == "formula" || type == "effect" || type == "call") return class_name(type);
  return record(type) != nullptr ? class_name(type) : std::string(type);
}

std::string lua_type(std::string_view type) {
  std::string result;
  while (!type.empty()) {
    const std::size_t end = std::min(type.find('|'), type.size());
    result += (result.empty() ? "" : "|") + one_type(type.substr(0, end));
    type.remove_prefix(std::min(end + 1, type.size()));
  }
  return result;
}

std::string annotation(const Field& field) {
  std::string text = "---@field " + std::string(field.name) + (field.required ? " " : "? ") + lua_type(field.type);
  if (field.of_variation) text += "|fun(v: table): any";
  text += "  ";
  text += field.description;
  if (*field.unit != 0) text += std::string(" [") + field.unit + "]";
  if (*field.otherwise != 0) text += std::string(" (default ") + field.otherwise + ")";
  return text + "\n";
}

constexpr const char kWords[] = R"lua(
---@class stampede.draw
---@class stampede.literal: stampede.formula, stampede.effect
---@class stampede.formula
---@class stampede.effect
---@class stampede.call

---@type table<string, fun(...: string): stampede.literal>
is = {}
---@type table<string, fun(...: string): stampede.literal>|fun(part: stampede.formula): stampede.formula
is_not = {}
---@type table<string, fun(...: string): stampede.call>
act = {}

---@return stampede.formula
function all_of(...) end
---@return stampede.formula
function any_of(...) end
---@return stampede.formula
function in_order(...) end
---@param group string
---@param n integer
---@param f fun(b: string[], i: integer): stampede.formula
---@return stampede.formula
function any_order(group, n, f) end
---@return stampede.formula
function forall(...) end
---@return stampede.formula
function exists(...) end
---@return stampede.formula
function equal(a, b) end
---@param text string
---@return stampede.formula
function pddl(text) end
---@return stampede.effect
function when(condition, effects) end
function stream(source, object) end
---@return stampede.draw
function one_of(...) end
---@return stampede.draw
function sample_of(values, n) end
---@param low number
---@param high number
---@return stampede.draw
function between(low, high) end
---@param degrees number
---@return number
function deg(degrees) end
function mm(x) end
function cm(x) end
function each(list, f) end
function range(first, last, step) end
---@type { names: string[], except: (fun(...): string[]), rgb: fun(name: string): number[] }
colours = {}
-- The world, as tests and skills read it; scripting/runtime/README.md lists the other methods.
---@class stampede.world_view
local world_view = {}
-- Does it hold now (debounced, as verdicts and catalogues have it)? Not in predicates.
---@param predicate string
---@param ... string
---@return boolean
function world_view:fact(predicate, ...) end
-- Is it known to hold: what can be hidden as it was when it was last seen. Not in predicates.
---@param predicate string
---@param ... string
---@return boolean
function world_view:observed(predicate, ...) end
-- All facts, or those of one predicate: { { "on", "cup", "table" }, … }. Not in predicates.
---@param predicate? string
---@return string[][]
function world_view:facts(predicate) end
)lua";

}  // namespace

std::string luals_annotations() {
  std::string text =
      "---@meta\n-- Made by `stampede doc` from the field tables of scripting/library/fields.cpp: do not edit.\n";
  text += kWords;
  for (const Record& one : records()) {
    text += "\n-- " + std::string(one.description) + "\n---@class " + class_name(one.name) + "\n";
    if (*one.head != 0) text += "---@field [integer] " + lua_type(one.head) + "\n";
    for (const Field& field : one.fields) text += annotation(field);
  }
  for (const char* kind : {"task", "skill", "predicate", "object", "world", "robot"}) {
    text += "\n---@param fields " + class_name(kind) + "\n---@return " + class_name(kind) + "\nfunction " + kind +
            "(fields) end\n";
  }
  for (const char* shape : {"box", "sphere", "cylinder", "capsule", "cone", "hull", "lathe", "mesh"}) {
    text += "\n---@return " + class_name("shape") + "\nfunction " + shape + "(fields) end\n";
  }
  for (const char* texture : {"texture", "checker", "stripes", "noise"}) {
    text += "\n---@return " + class_name("texture") + "\nfunction " + texture + "(fields) end\n";
  }
  return text;
}

}  // namespace stampede
