// Which files a file is made of, as its words tell: what it does not name, it can do without.
#include <algorithm>
#include <cctype>

#include "scripting/library/library.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

bool is_word(unsigned char c) { return std::isalnum(c) != 0 || c == '_'; }

std::set<std::string> words_of(std::string_view text) {
  std::set<std::string> words;
  for (std::size_t at = 0; at < text.size();) {
    std::size_t end = at;
    while (end < text.size() && is_word(static_cast<unsigned char>(text[end]))) ++end;
    if (end > at) words.emplace(text.substr(at, end - at));
    at = end + 1;
  }
  return words;
}

// In text too: `excludes = { "on" }`, pddl("(and (on ?x table))").
bool names_predicate(const Mentions& mentions, const std::string& name) {
  const auto in_formula = [&](const std::string& text) {
    const std::size_t start = text.find_first_not_of(" \n\t");
    return start != std::string::npos && text[start] == '(' && words_of(text).contains(name);
  };
  return mentions.after_is.contains(name) || mentions.texts.contains(name) ||
         std::any_of(mentions.texts.begin(), mentions.texts.end(), in_formula);
}

bool names(const Mentions& mentions, const ScriptFile& file) {
  std::string required = file.shown_path.substr(0, file.shown_path.rfind('.'));
  std::replace(required.begin(), required.end(), '/', '.');
  switch (file.kind) {
    case DefinitionKind::predicate:
      return names_predicate(mentions, file.name);
    case DefinitionKind::skill:
      return mentions.after_act.contains(file.name) || mentions.texts.contains(file.name);
    case DefinitionKind::module:
      return mentions.texts.contains(required) || mentions.texts.contains(file.name);
    case DefinitionKind::task:
      return false;
    default:
      return mentions.texts.contains(file.name);
  }
}

// Nothing that a skill could do would make a derived predicate true, or one of starts, by itself.
bool achieved(const Domain& domain, const std::string& name) {
  const Predicate* predicate = domain.predicate(name);
  if (predicate != nullptr && predicate->kind != PredicateKind::basic) return true;
  const auto is_of = [&](const Effect& effect) { return effect.predicate == name; };
  return std::any_of(domain.actions.begin(), domain.actions.end(), [&](const Action& action) {
    return std::any_of(action.effects.begin(), action.effects.end(), is_of);
  });
}

// Of what was left out: what stands in the place of an earlier root's file, and what names such a one and so cannot be
// read. A plan without it would be another than its author's library makes.
std::vector<const ScriptFile*> missed_in(const std::vector<ScriptFile>& left_out) {
  std::vector<const ScriptFile*> missed;
  for (const ScriptFile& file : left_out)
    if (file.replaces) missed.push_back(&file);
  for (std::size_t i = 0; i < missed.size(); ++i)
    for (const ScriptFile& file : left_out)
      if (std::ranges::find(missed, &file) == missed.end() && names(mentions_in(file.source), *missed[i]))
        missed.push_back(&file);
  return missed;
}

}  // namespace

std::vector<const ScriptFile*> Library::used_by(const std::vector<const ScriptFile*>& files) const {
  std::vector<const ScriptFile*> known = all_files();
  for (const ScriptFile& file : left_out_) known.push_back(&file);
  std::vector<const ScriptFile*> used = files;
  const auto add = [&](const ScriptFile* file) {
    if (std::find(used.begin(), used.end(), file) == used.end()) used.push_back(file);
  };
  for (std::size_t i = 0; i < used.size(); ++i) {
    const Mentions mentions = mentions_in(used[i]->source);
    for (const ScriptFile* file : known)
      if (names(mentions, *file)) add(file);
    if (used[i]->kind != DefinitionKind::task || mentions.fields.contains("steps")) continue;
    // Its plan may use every skill. One that could not be read is missed where nothing else makes true what is asked.
    for (const ScriptFile* file : missed_in(left_out_))
      if (file->kind == DefinitionKind::skill) add(file);
    for (const std::string& predicate : mentions.after_is) {
      if (achieved(vocabulary_.domain, predicate)) continue;
      for (const ScriptFile& file : left_out_)
        if (file.kind == DefinitionKind::skill && mentions_in(file.source).after_is.contains(predicate)) add(&file);
    }
  }
  return used;
}

}  // namespace stampede
