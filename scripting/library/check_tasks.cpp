// Tasks: what is the same in all variations, and a few or many of these.
#include <algorithm>

#include "engine/base/naming.h"
#include "engine/bddl/bddl.h"
#include "scripting/library/checks.h"
#include "scripting/library/task_formulas.h"
#include "scripting/library/task_script.h"

namespace stampede {
namespace {

constexpr std::size_t kManyVariations = 240, kFewVariations = 3;

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

std::vector<std::string> sentences(const Value& instructions) {
  std::vector<std::string> all = texts_of(instructions);
  if (instructions.is_text()) all.push_back(instructions.text);
  return all;
}

// What does not move stands where its entry says; a place in the air may also be one that init chooses.
void check_stands(const LibraryDraft& draft, const Definition& definition, const Value& entry,
                  const OutlinedThing& thing, const std::string& path) {
  if (!thing.known || thing.free || thing.positioned || entry["region"].present()) return;
  const Definition* found = draft.find(DefinitionKind::object, entry.items.front().text);
  if (found != nullptr && found->node["region"].present()) return;
  definition.complain(path, "nothing says where it is, and what does not move is not placed by init",
                      "at = on_table { 0.2, 0 }");
}

// One variation of a task, called by its text where there are several.
class VariationCheck {
 public:
  VariationCheck(LibraryDraft& draft, const Definition& definition, const Value& variation, const std::string& text)
      : draft_(draft),
        definition_(definition),
        variation_(variation),
        called_(text.empty() ? "" : " (variation " + text + ")"),
        scene_(outline_of(definition.node["world"].text, draft)) {}

  void check(TaskScript& script) {
    read_fields(script);
    for (const auto& [name, entry] : fields_["objects"].fields) check_object(name, entry);
    TaskFormulas(draft_, definition_, fields_, scene_).check();
    if (fields_.contains("instructions")) check_instructions(sentences(fields_["instructions"]));
    if (fields_.contains("subgoals"))
      for (const Value& one : fields_["subgoals"].items)
        if (one.items.size() > 2) check_slots("subgoals", one.items[2].text);
  }

 private:
  void read_fields(TaskScript& script) {
    for (const Field& field : record("task")->fields) {
      if (!field.of_variation) continue;
      const Value value = script.field(field.name, variation_);
      const bool computed = definition_.node[field.name].is_function();
      if (value.present() && has_type(value, field.type))
        fields_[field.name] = value;
      else if (computed && !value.present())
        definition_.complain(field.name, "the function returns nothing" + called_, "end it with return");
      else if (computed)
        definition_.complain(
            field.name, "the function returns " + value.type_name() + ", which is not what this field holds" + called_);
    }
  }

  void check_object(const std::string& name, const Value& entry) {
    const std::string path = "objects." + name;
    check_name(name, path, definition_.complainer());
    check_entry(draft_, definition_, entry, path, DefinitionKind::object);
    const Value& count = entry["count"];
    std::vector<std::string> members = {name};
    if (count.is_number()) {
      if (count.number < 0 || count.number > 1000) return definition_.complain(path + ".count", "a count is 0 … 1000");
      members.clear();
      for (int i = 1; i <= static_cast<int>(count.number); ++i) members.push_back(name + std::to_string(i));
      scene_.groups[name + "*"] = members;
    }
    for (const std::string& member : members) {
      if (scene_.things.contains(member))
        definition_.complain(path, "the name '" + member + "' is used twice",
                             "rename one, to " + proposed_name(member, {member}) + " for example");
      scene_.add(member, entry, draft_);
    }
    if (!members.empty()) check_stands(draft_, definition_, entry, scene_.things.at(members.front()), path);
  }

  void check_instructions(const std::vector<std::string>& texts) {
    if (texts.empty())
      definition_.complain("instructions", "at least one sentence is needed", "instructions = { \"…\" }");
    for (const std::string& text : texts) check_slots("instructions", text);
  }

  // `stack {height} blocks`: of the variation's axes.
  void check_slots(const char* field, const std::string& text) {
    const std::vector<std::string> axes = keys_of(variation_.fields);
    for (std::size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
      const std::size_t close = text.find('}', open);
      if (close == std::string::npos) return definition_.complain(field, "a { without } in \"" + text + "\"");
      const std::string name = text.substr(open + 1, close - open - 1);
      if (!listed(axes, name)) definition_.complain_unknown(field, "axis", name, axes);
    }
  }

  LibraryDraft& draft_;
  const Definition& definition_;
  const Value& variation_;
  const std::string called_;
  SceneOutline scene_;
  std::map<std::string, Value> fields_;
};

// Predicates of which the task says what can be seen: facts that are read from the world as it is.
std::set<std::string> hiding_in(LibraryDraft& draft, const Definition& definition) {
  const Domain& domain = draft.vocabulary().domain;
  std::set<std::string> hiding;
  for (const auto& [name, sees] : definition.node["observable"].fields) {
    const std::string path = "observable." + name;
    const Predicate* predicate = domain.predicate(name);
    if (predicate == nullptr)
      definition.complain_unknown(path, "predicate", name, names_of(domain.predicates));
    else if (predicate->kind == PredicateKind::derived)
      definition.complain(path, "'" + name + "' is derived: what can be seen of it follows from what it is derived of",
                          "say it of these");
    else if (predicate->kind == PredicateKind::start)
      definition.complain(path, "'" + name + "' is only asked of starts and is no fact", "leave it out");
    else
      hiding.insert(name);
    if (!sees.is_function() && !(sees.kind == Value::Kind::boolean && !sees.boolean))
      definition.complain(path, "expects function(w, …) or false, this is " + sees.type_name(),
                          name + " = function(w, …) return … end");
  }
  return hiding;
}

// What is the same in all variations.
Library::TaskInfo info_of(LibraryDraft& draft, const Definition& definition) {
  const Value& node = definition.node;
  Library::TaskInfo info;
  info.name = definition.file->name;
  info.description = definition.file->description;
  info.world = node["world"].text;
  const Definition* world = draft.find(DefinitionKind::world, info.world);
  if (world != nullptr)
    check_observe(definition, world->node);
  else if (node["world"].is_text() && draft.library()->file(DefinitionKind::world, info.world) == nullptr)
    definition.complain_unknown("world", "world", info.world, keys_of(draft.of(DefinitionKind::world)));
  info.is_imported = node["problem"].present();
  draft.complaints().guarded(
      [&] { check_problem(node["problem"], definition.file->shown_path, *draft.library(), definition.complainer()); });
  const Value& hand = node["hand"];
  if (hand.is_text() && hand.text != "empty" && hand.text != "any")
    definition.complain("hand", "at the end the hand is empty or any, not '" + hand.text + "'",
                        did_you_mean(hand.text, {"any", "empty"}));
  info.hand = hand_of(info.world, draft);
  info.skills = chosen_skills(draft, definition, info.world);
  info.hiding = hiding_in(draft, definition);
  info.instructions = sentences(node["instructions"]);
  return info;
}

// At most so many variations are tried: the first, and others at equal distances.
void read_task(LibraryDraft& draft, const Definition& definition, std::size_t most) {
  TaskScript script(definition, draft.fresh_state());
  Library::TaskInfo info = info_of(draft, definition);
  const std::vector<Value> variations = script.variations();
  for (const Value& variation : variations) {
    std::map<std::string, std::string> axes;
    for (const auto& [axis, value] : variation.fields) axes[axis] = plain_text(value);
    info.variations.push_back(std::move(axes));
    info.variation_texts.push_back(variation_text(variation));
  }
  const std::size_t stride = variations.size() / most + 1;
  const bool known = draft.find(DefinitionKind::world, info.world) != nullptr;  // else its fixtures would be complaints
  for (std::size_t i = 0; known && i < variations.size(); i += stride) {
    const std::size_t before = draft.complaints().count();
    const std::string text = variations.size() > 1 ? info.variation_texts[i] : std::string();
    VariationCheck(draft, definition, variations[i], text).check(script);
    if (draft.complaints().count() > before) break;  // the others would say the same
  }
  draft.vocabulary().tasks[info.name] = std::move(info);
}

}  // namespace

void read_tasks(LibraryDraft& draft, const BuilderOptions& options) {
  for (const auto& [name, definition] : draft.of(DefinitionKind::task)) {
    const std::size_t most = options.is_thorough(name) ? kManyVariations : kFewVariations;
    draft.guarded_in(*definition.file, [&, &task = definition] { read_task(draft, task, most); });
  }
}

}  // namespace stampede
