// Skills that take the place of others, where a world or a task asks for them.
#include <algorithm>

#include "scripting/library/checks.h"

namespace stampede {
namespace {

using ChosenSkills = std::map<std::string, std::string>;  // by the skill whose place they take

// What this world or task asks for goes before what was chosen so far.
void choose(LibraryDraft& draft, const Definition& definition, ChosenSkills& chosen) {
  const Library& library = *draft.library();
  std::vector<std::string> known;
  for (const auto& [name, info] : draft.vocabulary().skills)
    if (!info.replaces.empty()) known.push_back(name);
  std::set<std::string> taken;
  for (const Value& item : definition.node["skills"].items) {
    if (library.file(DefinitionKind::skill, item.text) == nullptr) {
      definition.complain_unknown("skills", "skill", item.text, known);
      continue;
    }
    const SkillInfo* info = library.skill(item.text);
    if (info == nullptr) continue;  // its file has its own complaint
    if (info->replaces.empty()) {
      definition.complain("skills", "'" + item.text + "' neither extends nor replaces another skill",
                          "leave it out: every task has it; or say in its file what it replaces");
    } else if (!taken.insert(info->replaces).second) {
      definition.complain(
          "skills",
          "'" + item.text + "' and '" + chosen[info->replaces] + "' both take the place of '" + info->replaces + "'",
          "choose one of them");
    } else {
      chosen[info->replaces] = item.text;
    }
  }
}

// Values that a formula names: `lid` of `?x.lid`.
void collect_values(const Formula& formula, const Domain& domain, std::set<std::string>& names) {
  for (const Formula& part : formula.parts) collect_values(part, domain, names);
  const Predicate* predicate = formula.kind == Formula::Kind::atom ? domain.predicate(formula.predicate) : nullptr;
  if (predicate == nullptr) return;
  for (std::size_t i = 0; i < formula.terms.size() && i < predicate->parameters.size(); ++i)
    if (!formula.terms[i].variable && predicate->parameters[i].type == "value") names.insert(formula.terms[i].name);
}

// What actions and derived predicates name is there in every problem, also where no object has such a part.
void name_constants(Domain& domain) {
  std::set<std::string> names;
  for (const Action& action : domain.actions) {
    collect_values(action.precondition, domain, names);
    for (const Effect& effect : action.effects) collect_values(effect.when, domain, names);
  }
  for (const Predicate& predicate : domain.predicates)
    if (predicate.kind == PredicateKind::derived) collect_values(predicate.derived, domain, names);
  for (const std::string& name : names) domain.constants.push_back({name, "value"});
}

}  // namespace

std::vector<std::string> chosen_skills(LibraryDraft& draft, const Definition& task, const std::string& world) {
  ChosenSkills chosen;
  if (const Definition* found = draft.find(DefinitionKind::world, world)) choose(draft, *found, chosen);
  choose(draft, task, chosen);
  std::vector<std::string> names;
  for (const auto& [replaced, name] : chosen) names.push_back(name);
  std::sort(names.begin(), names.end());
  return names;
}

void make_domains(LibraryDraft& draft) {
  auto& vocabulary = draft.vocabulary();
  const auto& skills = vocabulary.skills;
  Domain& base = vocabulary.domain;
  base.name = "stampede";
  std::sort(base.actions.begin(), base.actions.end(), [](const Action& a, const Action& b) { return a.name < b.name; });
  const Domain all = base;
  const auto replaces = [&](const Action& action) { return skills.at(action.skill).replaces; };
  std::erase_if(base.actions, [&](const Action& action) { return !replaces(action).empty(); });
  for (const auto& [name, task] : vocabulary.tasks) {
    if (task.skills.empty()) continue;
    std::set<std::string> replaced;
    for (const std::string& chosen : task.skills) replaced.insert(skills.at(chosen).replaces);
    const auto [made, fresh] = vocabulary.domains.emplace(task.skills, all);
    if (!fresh) continue;
    std::erase_if(made->second.actions, [&](const Action& action) {
      return replaced.contains(action.skill) || (!replaces(action).empty() && !listed(task.skills, action.skill));
    });
    name_constants(made->second);
  }
  name_constants(base);
}

}  // namespace stampede
