// Who declares numbers, and which scripts read them.
#include <set>

#include "scripting/library/checks.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

// Of a body and its regions.
void add_names(const Value& body, std::set<std::string>& names) {
  for (const auto& [name, value] : body["numbers"].fields) names.insert(name);
  for (const auto& [region, box] : body["regions"].fields)
    for (const auto& [name, value] : box["numbers"].fields) names.insert(name);
}

// Of worlds/types.lua and of objects' `declares`: traits = { hook = { "…", numbers = { lift = {…} } } }, numbers = {…};
// of predicates and skills: reads = {…}.
std::vector<NumberDeclaration> declarations_in(const LibraryDraft& draft) {
  std::vector<NumberDeclaration> found;
  const auto add = [&](const Definition& definition, const Value& numbers, const std::string& path,
                       const std::string& trait) {
    for (const auto& [name, number] : numbers.fields) found.push_back({definition, path + name, name, number, trait});
  };
  const auto add_traits = [&](const Definition& definition, const std::string& prefix, const Value& node) {
    add(definition, node["numbers"], prefix + "numbers.", {});
    for (const auto& [trait, entry] : node["traits"].fields)
      add(definition, entry["numbers"], prefix + "traits." + trait + ".numbers.", trait);
  };
  for (const Definition& definition : draft.type_files()) add_traits(definition, {}, definition.node);
  for (const auto& [name, definition] : draft.of(DefinitionKind::object))
    add_traits(definition, "declares.", definition.node["declares"]);
  for (const DefinitionKind kind : {DefinitionKind::predicate, DefinitionKind::skill})
    for (const auto& [name, definition] : draft.of(kind)) add(definition, definition.node["reads"], "reads.", {});
  return found;
}

// What a number is read `of`.
void check_readers(const NumberDeclaration& number) {
  const Value& of = number.node["of"];
  const std::vector<std::string> parameters = number.definition.parameter_names();
  for (const std::string& parameter : of.is_text() ? std::vector{of.text} : texts_of(of))
    if (!listed(parameters, parameter))
      number.definition.complain_unknown(number.path + ".of", "parameter", parameter, parameters);
}

// Names of the numbers that some object has.
std::set<std::string> names_had(const Definitions& objects) {
  std::set<std::string> had;
  for (const auto& [name, definition] : objects) {
    add_names(definition.node, had);
    for (const auto& [part, body] : definition.node["parts"].fields) add_names(body, had);
  }
  return had;
}

// w:number(…, "name") in any script.
void check_reads(LibraryDraft& draft) {
  const std::set<std::string> had = names_had(draft.of(DefinitionKind::object));
  NumberTable& table = draft.numbers();
  for (const ScriptFile& file : draft.files()) {
    if (file.source.find(":number(") == std::string::npos) continue;
    for (const auto& [name, line] : mentions_in(file.source).numbers) {
      if (table.all().contains(name)) continue;
      if (had.contains(name))
        table.take_read(name, place_in(file, line));
      else
        draft.complaints().add(unknown_number(place_in(file, line), name, keys_of(table.all())));
    }
  }
}

}  // namespace

void declare_numbers(LibraryDraft& draft) {
  const std::vector<NumberDeclaration> declarations = declarations_in(draft);
  for (const NumberDeclaration& number : declarations)
    draft.complaints().guarded([&] {
      if (!number.path.starts_with("reads."))
        check_record(*record("declared_number"), number.node, number.path, number.definition.complainer());
      if (!number.is_reference()) draft.numbers().declare(number);
    });
  for (const NumberDeclaration& number : declarations)
    draft.complaints().guarded([&] {
      if (number.is_reference()) draft.numbers().refer(number);
      check_readers(number);
    });
  check_reads(draft);
  draft.vocabulary().numbers = draft.numbers().all();
}

}  // namespace stampede
