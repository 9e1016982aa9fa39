#include <algorithm>

#include "engine/bddl/bddl.h"
#include "scripting/library/builder.h"
#include "scripting/library/naming.h"
#include "scripting/library/source_lines.h"
#include "scripting/library/task_formulas.h"

namespace stampede {
namespace {

constexpr std::size_t kManyVariations = 240, kFewVariations = 3;
constexpr SandboxLimits kLimits{5'000'000, 32u << 20};

std::string with_context(const std::string& what, const std::string& text, std::size_t count) {
  return count > 1 ? what + " (variation " + text + ")" : what;
}

// The problem that a task was imported from must read, in its dialect, and its mapping must be there.
void check_problem(const Value& problem, const std::string& place, const Library& library, const Complain& complain) {
  if (!problem["text"].is_text() || !problem["dialect"].is_text()) return;  // said already
  const std::string& dialect = problem["dialect"].text;
  if (dialect != "libero" && dialect != "behavior") {
    complain("problem.dialect", "there is no dialect '" + dialect + "'", did_you_mean(dialect, {"behavior", "libero"}));
    return;
  }
  const BddlDialect read = read_bddl(problem["text"].text, place + ": problem.text").problem.dialect;
  if ((read == BddlDialect::libero) != (dialect == "libero"))
    complain("problem.dialect", "the text is " + std::string(to_string(read)) + "'s", "name that dialect");
  const Value& mapping = problem["mapping"];
  if (mapping.is_text() && library.module("worlds.bddl." + mapping.text) == nullptr)
    complain("problem.mapping", "there is no worlds/bddl/" + mapping.text + ".lua", "put the file there");
  for (const auto& [theirs, ours] : problem["names"].fields)
    if (!ours.is_text()) complain("problem.names." + theirs, "expects text, this is " + ours.type_name(), {});
}

void collect_variables(const Value& node, std::vector<std::string>& names) {
  for (const auto& [axis, value] : node.fields) names.push_back(axis);
}

}  // namespace

void LibraryBuilder::read_tasks() {
  for (const auto& [name, definition] : of(DefinitionKind::task)) {
    guarded_in(*definition.file, [&, &task = definition] { read_task(task); });
  }
}

std::size_t LibraryBuilder::most_variations(const std::string& task) const {
  const auto& named = options_.named;
  const bool thorough =
      options_.thorough == Thorough::all ||
      (options_.thorough == Thorough::named && std::find(named.begin(), named.end(), task) != named.end());
  return thorough ? kManyVariations : kFewVariations;
}

void LibraryBuilder::read_task(const Definition& definition) {
  DefinitionState state(library_, kLimits);
  Library::TaskInfo info;
  info.name = definition.file->name;
  info.description = definition.file->description;
  info.world = definition.node["world"].text;
  const Definitions& worlds = of(DefinitionKind::world);
  if (definition.node["world"].is_text() && !worlds.contains(info.world) &&
      library_->file(DefinitionKind::world, info.world) == nullptr) {
    std::vector<std::string> known;
    for (const auto& [name, unused] : worlds) known.push_back(name);
    complain(definition, "world", "there is no world '" + info.world + "'", did_you_mean(info.world, known));
  }
  if (const auto world = worlds.find(info.world); world != worlds.end()) check_observe(definition, world->second.node);
  info.is_imported = definition.node["problem"].present();
  guarded([&] {
    check_problem(definition.node["problem"], definition.file->shown_path, *library_, complainer(definition));
  });
  const Value& hand = definition.node["hand"];
  if (hand.is_text() && hand.text != "empty" && hand.text != "any")
    complain(definition, "hand", "at the end the hand is empty or any, not '" + hand.text + "'",
             did_you_mean(hand.text, {"any", "empty"}));
  info.hand = hand_of(info.world);
  info.skills = chosen_skills(definition, info.world);
  const std::vector<Value> variations = variations_of(definition, state);
  for (const Value& variation : variations) {
    std::map<std::string, std::string> axes;
    for (const auto& [axis, value] : variation.fields) axes[axis] = plain_text(value);
    info.variations.push_back(std::move(axes));
    info.variation_texts.push_back(variation_text(variation));
  }
  const Value& texts = definition.node["instructions"];
  if (texts.is_text()) info.instructions.push_back(texts.text);
  for (const Value& text : texts.items) info.instructions.push_back(text.text);
  const bool world_known = worlds.contains(info.world);  // otherwise every name of its fixtures would be a complaint
  const std::size_t stride = variations.size() / most_variations(info.name) + 1;
  for (std::size_t i = 0; world_known && i < variations.size(); i += stride) {
    const std::size_t before = complaints_.size();
    check_variation(definition, state, variations[i], variations.size() > 1 ? info.variation_texts[i] : std::string());
    if (complaints_.size() > before) break;  // the others would say the same
  }
  library_->tasks_[info.name] = std::move(info);
}

void LibraryBuilder::check_variation(const Definition& definition, DefinitionState& state, const Value& variation,
                                     const std::string& text) {
  std::map<std::string, Value> fields;
  for (const Field& field : record("task")->fields) {
    if (!field.of_variation) continue;
    const Value value = field_for(definition, state, field.name, variation);
    if (!value.present()) {
      if (!definition.node[field.name].is_function()) continue;
      complain(definition, field.name, with_context("the function returns nothing", text, text.size() + 1),
               "end it with return");
      continue;
    }
    if (!has_type(value, field.type)) {
      if (definition.node[field.name].is_function()) {
        complain(definition, field.name,
                 with_context("the function returns " + value.type_name() + ", which is not what this field holds",
                              text, text.size() + 1));
      }
      continue;
    }
    fields[field.name] = value;
  }
  SceneObjects objects = world_objects(definition.node["world"].text);
  Groups groups;
  for (const auto& [name, entry] : fields["objects"].fields) {
    const std::string path = "objects." + name;
    if (const auto fault = name_fault(name))
      complain(definition, path, "the name '" + name + "' " + *fault, "such as '" + proposed_name(name) + "'");
    check_entry(definition, entry, path, "object");
    const Value& count = entry["count"];
    std::vector<std::string> members = {name};
    if (count.is_number()) {
      if (count.number < 0 || count.number > 1000) {
        complain(definition, path + ".count", "a count is 0 … 1000");
        continue;
      }
      members.clear();
      for (int i = 1; i <= static_cast<int>(count.number); ++i) members.push_back(name + std::to_string(i));
      groups[name + "*"] = members;
    }
    for (const std::string& member : members) {
      if (objects.contains(member)) {
        complain(definition, path, "the name '" + member + "' is used twice",
                 "rename one, to " + proposed_name(member, {member}) + " for example");
      }
      add_object(objects, member, entry);
    }
    if (!members.empty()) check_stands(definition, entry, objects.at(members.front()), path);
  }
  TaskFormulas(*this, definition, fields, objects, groups).check();
  if (fields.contains("instructions")) check_instructions(definition, fields["instructions"], variation);
  if (fields.contains("subgoals"))
    for (const Value& one : fields["subgoals"].items)
      if (one.items.size() > 2) check_slots(definition, "subgoals", one.items[2].text, variation);
}

// What does not move stands where its entry says; a place in the air may also be one that init chooses.
void LibraryBuilder::check_stands(const Definition& definition, const Value& entry, const SceneObject& object,
                                  const std::string& path) {
  if (!object.known || object.free || object.positioned || entry["region"].present()) return;
  const auto found = of(DefinitionKind::object).find(entry.items.front().text);
  if (found != of(DefinitionKind::object).end() && found->second.node["region"].present()) return;
  complain(definition, path, "nothing says where it is, and what does not move is not placed by init",
           "at = on_table { 0.2, 0 }");
}

void LibraryBuilder::check_instructions(const Definition& definition, const Value& texts, const Value& variation) {
  std::vector<std::string> all;
  if (texts.is_text()) all.push_back(texts.text);
  for (const Value& text : texts.items) all.push_back(text.text);
  if (all.empty()) complain(definition, "instructions", "at least one sentence is needed", "instructions = { \"…\" }");
  for (const std::string& text : all) check_slots(definition, "instructions", text, variation);
}

// `stack {height} blocks`: of the variation's axes.
void LibraryBuilder::check_slots(const Definition& definition, const char* field, const std::string& text,
                                 const Value& variation) {
  std::vector<std::string> axes;
  collect_variables(variation, axes);
  for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    const std::size_t close = text.find('}', open);
    if (close == std::string::npos) return complain(definition, field, "a { without } in \"" + text + "\"");
    const std::string name = text.substr(open + 1, close - open - 1);
    if (std::find(axes.begin(), axes.end(), name) == axes.end())
      complain(definition, field, "there is no axis '" + name + "'", did_you_mean(name, axes));
  }
}

}  // namespace stampede
