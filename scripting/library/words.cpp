// A library's words: worlds/words.lua of each root, nouns of types and objects, verbs of skills.
#include "scripting/library/checks.h"
#include "scripting/library/english_reader.h"

namespace stampede {

void read_words(LibraryDraft& draft) {
  auto english = std::make_shared<English>();
  for (const auto& [name, definition] : draft.of(DefinitionKind::words))
    read_english(definition.node, *english, definition.complainer());
  const auto add_types = [&](const Value& types) {
    for (const auto& [name, entry] : types.fields) add_nouns(name, entry["nouns"], *english);
  };
  for (const Definition& file : draft.type_files()) add_types(file.node["types"]);
  for (const auto& [name, definition] : draft.of(DefinitionKind::object)) {
    add_nouns(name, definition.node["nouns"], *english);
    add_types(definition.node["declares"]["types"]);
    for (const auto& [part, entry] : definition.node["parts"].fields) add_nouns(part, entry["nouns"], *english);
  }
  for (const auto& [name, skill] : draft.vocabulary().skills) add_verbs(name, skill.verbs, *english);
  draft.vocabulary().english = std::move(english);
}

}  // namespace stampede
