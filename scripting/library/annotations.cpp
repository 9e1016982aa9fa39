#include "scripting/library/annotations.h"

#include <algorithm>
#include <map>
#include <set>
#include <string_view>
#include <vector>

#include "scripting/library/embedded.h"
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
  if (type == "on_table" || type == "literal" || type == "formula" || type == "effect" || type == "call")
    return class_name(type);
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

// A function's parameters are those that its description begins with: "function(w, …): does it hold".
std::string signature(std::string_view description) {
  static const std::map<std::string_view, std::string_view> kTypes = {{"v", "table<string, any>"},
                                                                      {"w", "stampede.world_view"},
                                                                      {"robot", "stampede.robot_view"},
                                                                      {"p", "table<string, any>"},
                                                                      {"c", "table<string, any>"}};
  constexpr std::string_view kHead = "function(";
  const std::string more = "...: any): any, any?";  // a test may return its margin second
  if (!description.starts_with(kHead)) return "fun(" + more;
  description = description.substr(kHead.size(), description.find(')') - kHead.size());
  std::string text = "fun(";
  while (!description.empty()) {
    const std::string_view name = description.substr(0, description.find(", "));
    const auto type = kTypes.find(name);
    if (type == kTypes.end()) return text + more;  // names of objects, perhaps a random stream
    text += std::string(name) + ": " + std::string(type->second);
    description.remove_prefix(std::min(name.size() + 2, description.size()));
    if (!description.empty()) text += ", ";
  }
  return text + "): any, any?";
}

// Texts that names.lua knows all of. Others are no error: a file may be about to be written.
std::string type_of(const Field& field) {
  const std::string_view name = field.name;
  if (name == "world") return "stampede.world_name|string";
  if (name == "type") return "stampede.type_name|string";
  if (name == "numbers") return class_name("numbers");
  if (name == "traits") return "(stampede.trait_name|string)[]";
  std::string type = lua_type(field.type);
  const std::size_t function = type.find("function");
  if (function == std::string::npos) return type;
  return type.replace(function, 8, "(" + signature(field.description) + ")");
}

std::string annotation(const Field& field, bool required) {
  std::string text = "---@field " + std::string(field.name) + (required ? " " : "? ") + type_of(field);
  if (field.of_variation) text += "|fun(v: table<string, any>): any";
  text += "  ";
  text += field.description;
  if (*field.unit != 0) text += std::string(" [") + field.unit + "]";
  if (*field.otherwise != 0) text += std::string(" (default ") + field.otherwise + ")";
  return text + "\n";
}

std::string class_of(const Record& one) {
  const std::string_view name = one.name;
  std::string text = "\n-- " + std::string(one.description) + "\n---@class " + class_name(name);
  if (name == "entry") text += ": stampede.object";  // its fields go before those of the file
  if (name == "task" || name == "world" || name == "robot") text += ": stampede.closed";
  text += "\n";
  if (*one.head != 0) {
    text += "---@field [integer] " + (name == "entry" ? "stampede.object_name|string" : lua_type(one.head)) + "\n";
  }
  // What extends another may leave anything out.
  const bool extends = std::any_of(one.fields.begin(), one.fields.end(),
                                   [](const Field& field) { return field.name == std::string_view("extends"); });
  for (const Field& field : one.fields) text += annotation(field, field.required && !extends);
  return text;
}

std::string alias(std::string_view name, const std::set<std::string>& values) {
  std::string text = "\n---@alias " + class_name(name) + "\n";
  for (const std::string& value : values) text += "---| \"" + value + "\"\n";
  return text;
}

std::set<std::string> names(const std::vector<const ScriptFile*>& files) {
  std::set<std::string> result;
  for (const ScriptFile* file : files) result.insert(file->name);
  return result;
}

// Those that things can have, and their names for w:number.
std::string numbers_class(const Numbers& numbers) {
  std::string text = "\n---@class " + class_name("numbers") + "\n";
  std::set<std::string> all;
  for (const auto& [name, number] : numbers) {
    all.insert(name);
    text += "---@field " + name + "? number  " + number.description;
    if (!number.unit.empty()) text += " [" + number.unit + "]";
    if (!number.trait.empty()) text += " (" + number.trait + ")";
    text += "\n";
  }
  return text + alias("number_name", all);
}

// A field of `is`, `is_not` or `act`: its name, its parameters but for the hand, what it is in words.
std::string symbol(std::string_view name, const std::vector<Parameter>& parameters, bool call, std::string_view label) {
  std::string arguments, types;
  for (const Parameter& one : parameters) {
    if (one.type == "hand") continue;
    const bool first = arguments.empty();
    // A call may name its arguments instead, act.place { "cup", to = "shelf" }, and leave some to be found.
    arguments += (first ? "" : ", ") + one.name + (!call ? ": string" : first ? ": string|table" : "?: string");
    std::string type = one.type;
    for (const std::string& trait : one.traits) type += (type.empty() ? "" : " & ") + trait;
    types += (first ? "" : ", ") + one.name + (type.empty() ? "" : ": " + type);
  }
  return "---@field " + std::string(name) + " fun(" + arguments +
         "): " + (call ? "stampede.call" : "stampede.literal") + "  " + std::string(label) +
         (types.empty() ? "" : " (" + types + ")") + "\n";
}

}  // namespace

std::string word_annotations() { return kWordsSource; }

std::string field_annotations() {
  std::string text =
      "---@meta\n-- Made by `stampede doc` from the field tables of scripting/library/fields.cpp: do not edit.\n";
  for (const Record& one : records()) text += class_of(one);
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

std::string name_annotations(const Library& library) {
  const Domain& domain = library.domain();
  std::set<std::string> predicates, types, traits(domain.traits.begin(), domain.traits.end());
  std::string literals, calls;
  for (const Predicate& one : domain.predicates) {
    predicates.insert(one.name);
    literals += symbol(one.name, one.parameters, false, one.label);
  }
  for (const std::string& trait : traits)  // a predicate too
    if (!predicates.contains(trait)) literals += symbol(trait, {{"x", "", {}}}, false, "it has the trait");
  for (const ScriptFile* file : library.files(DefinitionKind::skill)) {
    const SkillInfo* skill = library.skill(file->name);
    if (skill != nullptr) calls += symbol(file->name, skill->parameters, true, skill->label);
  }
  for (const auto& [name, parent] : domain.types) types.insert(name);

  std::string text = "---@meta\n-- Made by `stampede doc` from the Lua files: do not edit.\n";
  text += "\n---@class stampede.is\n" + literals + "\n---@class stampede.is_not\n" + literals;
  text += "\n---@class stampede.act\n" + calls;
  text += numbers_class(library.numbers());
  text += alias("predicate_name", predicates) + alias("type_name", types) + alias("trait_name", traits);
  text += alias("world_name", names(library.files(DefinitionKind::world)));
  return text + alias("object_name", names(library.files(DefinitionKind::object)));
}

}  // namespace stampede
