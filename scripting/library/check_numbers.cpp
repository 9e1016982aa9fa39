// Who declares numbers, and which scripts read them.
#include <functional>
#include <set>

#include "engine/base/nearest.h"
#include "scripting/library/builder.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

// Of a body and its regions.
void add_names(const Value& body, std::set<std::string>& names) {
  for (const auto& [name, value] : body["numbers"].fields) names.insert(name);
  for (const auto& [region, box] : body["regions"].fields)
    for (const auto& [name, value] : box["numbers"].fields) names.insert(name);
}

}  // namespace

void LibraryBuilder::each_declaration(
    const std::function<void(const Definition&, const std::string& path, const std::string& name, const Value& number,
                             const std::string& trait)>& visit) {
  const auto each = [&](const Definition& definition, const Value& numbers, const std::string& path,
                        const std::string& trait) {
    for (const auto& [name, number] : numbers.fields)
      guarded([&, &name = name, &number = number] { visit(definition, path + name, name, number, trait); });
  };
  const auto of_traits = [&](const Definition& definition, const std::string& prefix, const Value& node) {
    each(definition, node["numbers"], prefix + "numbers.", {});
    for (const auto& [trait, entry] : node["traits"].fields)
      each(definition, entry["numbers"], prefix + "traits." + trait + ".numbers.", trait);
  };
  for (const Definition& definition : type_files_) of_traits(definition, {}, definition.node);
  for (const auto& [name, definition] : of(DefinitionKind::object))
    of_traits(definition, "declares.", definition.node["declares"]);
  for (const DefinitionKind kind : {DefinitionKind::predicate, DefinitionKind::skill})
    for (const auto& [name, definition] : of(kind)) each(definition, definition.node["reads"], "reads.", {});
}

// Of worlds/types.lua and of objects' `declares`: traits = { hook = { "…", numbers = { lift = {…} } } }, numbers = {…};
// of predicates and skills: reads = {…}.
void LibraryBuilder::declare_numbers() {
  each_declaration([&](const Definition& definition, const std::string& path, const std::string& name,
                       const Value& number, const std::string& trait) {
    if (!path.starts_with("reads.")) check_record(*record("declared_number"), number, path, complainer(definition));
    if (NumberTable::is_reference(number)) return;
    const std::string place = error_at(definition, path, {}, {}).where();
    numbers_.declare(name, number, trait, path, place, complainer(definition));
  });
  each_declaration([&](const Definition& definition, const std::string& path, const std::string& name,
                       const Value& number, const std::string& trait) {
    if (NumberTable::is_reference(number)) numbers_.refer(name, trait, path, complainer(definition));
    const Value& of = number["of"];
    const std::vector<std::string> parameters = parameter_names(definition.node);
    for (const Value& parameter : of.is_text() ? std::vector<Value>{of} : of.items)
      if (!listed(parameters, parameter.text))
        complain(definition, path + ".of", "there is no parameter '" + parameter.text + "'",
                 did_you_mean(parameter.text, parameters));
  });
  std::set<std::string> had;
  for (const auto& [name, definition] : of(DefinitionKind::object)) {
    add_names(definition.node, had);
    for (const auto& [part, body] : definition.node["parts"].fields) add_names(body, had);
  }
  check_reads(had);
  library_->numbers_ = numbers_.all();
}

// w:number(…, "name") in any script. `had`: names of the numbers that some object has.
void LibraryBuilder::check_reads(const std::set<std::string>& had) {
  for (const ScriptFile& file : library_->files_) {
    if (file.source.find(":number(") == std::string::npos) continue;
    for (const auto& [name, line] : mentions_in(file.source).numbers) {
      if (numbers_.all().contains(name)) continue;
      const std::string place = file.shown_path + ":" + std::to_string(line);
      if (had.contains(name)) {
        numbers_.take_read(name, place);
      } else {
        add(unknown_number(place, name, numbers_.names()));
      }
    }
  }
}

}  // namespace stampede
