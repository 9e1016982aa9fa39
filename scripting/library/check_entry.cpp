// Entries of worlds and tasks: { "cube", colour = "red" }.
#include <algorithm>

#include "scripting/library/checks.h"

namespace stampede {
namespace {

// Of what its entry begins with; nullptr: not known, and said.
const Definition* class_of(const LibraryDraft& draft, const Definition& definition, const Value& entry,
                           const std::string& path, DefinitionKind kind) {
  const std::string what(to_string(kind));
  if (!entry.is_table() || entry.items.empty() || !entry.items[0].is_text()) {
    const bool drawn = entry.is_table() && !entry.items.empty() && !entry.items[0].tag().empty();
    if (!drawn) definition.complain(path, "an entry begins with the name of its " + what, "such as { \"cube\" }");
    return nullptr;
  }
  const std::string& name = entry.items[0].text;
  const Definition* found = draft.find(kind, name);
  if (found != nullptr || draft.library()->file(kind, name) != nullptr) return found;  // its own file has complaints
  std::string hint = did_you_mean(name, keys_of(draft.of(kind)));
  if (hint.empty() && kind == DefinitionKind::object)
    hint = "`stampede list objects` names those that there are, `stampede new object` makes one";
  definition.complain(path, "there is no " + what + " '" + name + "'", hint);
  return nullptr;
}

// What an entry sets of its file's numbers, by their names; and what traits of its own need.
void check_entry_numbers(LibraryDraft& draft, const Definition& definition, const Value& entry, const Value& node,
                         const std::string& path) {
  Value own;
  own.kind = Value::Kind::table;
  for (const auto& [name, value] : node["numbers"].fields)
    if (entry[name].present()) own.fields[name] = entry[name];
  draft.numbers().check_values(own, path + ".", definition.complainer());
  std::vector<std::string> has = keys_of(node["numbers"].fields);
  for (const auto& [name, value] : entry["numbers"].fields) has.push_back(name);
  draft.numbers().check_needed(texts_of(entry["traits"]), has, path, definition.complainer());
}

// Fields of an object's file that its entry says anew.
Value replaced_fields(const Value& entry) {
  Value replaced;
  replaced.kind = Value::Kind::table;
  for (const std::string& name : field_names(*record("object")))
    if (const Value& value = entry[name]; value.present()) replaced.fields[name] = value;
  return replaced;
}

// Where an arm starts: its own joints, each once.
void check_start(const Definition& definition, const Value& joints, const Value& arm, const std::string& path) {
  const std::vector<std::string> names = texts_of(arm);
  for (const auto& [joint, position] : joints.fields) {
    if (!listed(names, joint))
      definition.complain(path, "the arm has no joint '" + joint + "'", did_you_mean(joint, names));
    if (!has_type(position, "number"))
      definition.complain(path + "." + joint, "expects a number, this is " + position.type_name(),
                          "such as " + joint + " = between(-0.2, 0.2)");
  }
}

// Where an object's parts start.
void check_parts(const Definition& definition, const Value& entry, const Value& node, const std::string& path) {
  const Value& parts = node["parts"];
  for (const auto& [part, position] : entry["joints"].fields)
    if (!parts[part].present() && !node["urdf"].present())
      definition.complain(path + ".joints", "'" + entry.items[0].text + "' has no part '" + part + "'",
                          did_you_mean(part, keys_of(parts.fields)));
}

}  // namespace

void check_entry(LibraryDraft& draft, const Definition& definition, const Value& entry, const std::string& path,
                 DefinitionKind kind) {
  const Definition* found = class_of(draft, definition, entry, path, kind);
  if (found == nullptr) return;
  const Value& node = found->node;
  std::vector<std::string> known = field_names(*record(to_string(kind)));
  for (const char* table : {"numbers", "attributes"})
    for (const auto& [name, unused] : node[table].fields) known.push_back(name);
  const bool robot = kind == DefinitionKind::robot;
  check_record(*record("entry"), entry, path, definition.complainer(), known);
  if (!robot) check_record(*record("object"), replaced_fields(entry), path, definition.complainer());
  check_body(draft, definition, entry, path);
  check_entry_numbers(draft, definition, entry, node, path);
  check_tip(definition, entry, path);
  if (entry.items.size() > 1) definition.complain(path, "an entry has one class, this one lists more");
  if (robot)
    check_start(definition, entry["joints"], node["arm"], path + ".joints");
  else
    check_parts(definition, entry, node, path);
}

}  // namespace stampede
