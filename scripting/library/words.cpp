// A library's words: worlds/words.lua of each root, nouns of types and objects, verbs of skills.
#include "scripting/library/checks.h"
#include "scripting/library/english_reader.h"

namespace stampede {

void read_words(LibraryDraft& draft) {
  const auto english = std::make_shared<English>();
  for (const auto& [name, definition] : draft.of(DefinitionKind::words)) read_english(definition, *english);
  WordsOfThings things(english);
  const auto add_types = [&](const Value& types) {
    for (const auto& [name, entry] : types.fields) things.add_nouns(name, entry["nouns"]);
  };
  for (const Definition& file : draft.type_files()) add_types(file.node["types"]);
  for (const auto& [name, definition] : draft.of(DefinitionKind::object)) {
    things.add_nouns(name, definition.node["nouns"]);
    add_types(definition.node["declares"]["types"]);
    for (const auto& [part, entry] : definition.node["parts"].fields) things.add_nouns(part, entry["nouns"]);
  }
  for (const auto& [name, skill] : draft.vocabulary().skills) things.add_verbs(name, skill.verbs);
  draft.vocabulary().english = english;
}

}  // namespace stampede
