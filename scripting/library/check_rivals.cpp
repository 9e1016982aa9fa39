// An author's skills that could take the place of the library's in any plan: no mistake, and seldom meant.
#include <algorithm>
#include <map>

#include "scripting/library/checks.h"

namespace stampede {
namespace {

using Renaming = std::map<std::string, std::string>;  // one action's parameters as another's

Formula renamed(Formula formula, const Renaming& names) {
  for (Term& term : formula.terms)
    if (const auto found = names.find(term.name); term.variable && found != names.end()) term.name = found->second;
  for (Formula& part : formula.parts) part = renamed(std::move(part), names);
  return formula;
}

std::vector<Formula> conditions_of(const Action& action) {
  if (action.precondition.kind == Formula::Kind::always) return {};
  if (action.precondition.kind != Formula::Kind::conjunction) return {action.precondition};
  return action.precondition.parts;
}

// What it makes true in any case.
std::vector<Formula> made_by(const Action& action) {
  std::vector<Formula> made;
  for (const Effect& effect : action.effects)
    if (!effect.negated && effect.forall.empty() && effect.when.kind == Formula::Kind::always)
      made.push_back(atom(effect.predicate, effect.terms));
  return made;
}

bool all_among(const std::vector<Formula>& some, const Renaming& names, const std::vector<Formula>& all) {
  return std::ranges::all_of(
      some, [&](const Formula& one) { return std::ranges::find(all, renamed(one, names)) != all.end(); });
}

// Whoever may do the one may do the other, and gets at least as much of it.
class Rivals {
 public:
  Rivals(const Domain& domain, const Action& wide, const Action& narrow)
      : domain_(domain), wide_(wide), narrow_(narrow), asked_(conditions_of(narrow)), made_(made_by(narrow)) {}

  bool found() {
    return !made_.empty() && wide_.cost <= narrow_.cost && wide_.parameters.size() <= narrow_.parameters.size() &&
           try_from(0);
  }

 private:
  bool try_from(std::size_t parameter) {
    if (parameter == wide_.parameters.size()) return covers();
    const Parameter& own = wide_.parameters[parameter];
    for (const Parameter& other : narrow_.parameters) {
      if (!takes(own, other) || std::ranges::any_of(names_, [&](const auto& one) { return one.second == other.name; }))
        continue;
      names_[own.name] = other.name;
      if (try_from(parameter + 1)) return true;
      names_.erase(own.name);
    }
    return false;
  }

  bool takes(const Parameter& own, const Parameter& other) const {
    const bool type = own.type.empty() || (!other.type.empty() && domain_.is_a(other.type, own.type));
    return type && std::ranges::all_of(own.traits, [&](const auto& trait) { return listed(other.traits, trait); });
  }

  bool covers() const {
    std::vector<Formula> made;
    for (const Formula& one : made_by(wide_)) made.push_back(renamed(one, names_));
    return all_among(conditions_of(wide_), names_, asked_) && all_among(made_, {}, made);
  }

  const Domain& domain_;
  const Action &wide_, &narrow_;
  const std::vector<Formula> asked_, made_;
  Renaming names_;
};

}  // namespace

void check_rivals(LibraryDraft& draft) {
  const auto& vocabulary = draft.vocabulary();
  const Domain& domain = vocabulary.domain;
  const auto in_every_task = [&](const Action& action) { return vocabulary.skills.at(action.skill).replaces.empty(); };
  for (const auto& [name, definition] : draft.of(DefinitionKind::skill)) {
    if (definition.file->root == 0) continue;
    for (const Action& own : domain.actions) {
      if (own.skill != name || !in_every_task(own)) continue;
      for (const Action& other : domain.actions) {
        const ScriptFile* file = draft.library()->file(DefinitionKind::skill, other.skill);
        if (file->root >= definition.file->root || !in_every_task(other)) continue;
        if (Rivals(domain, own, other).found())
          draft.remark(definition.error("precondition",
                                        "'" + name + "' may be done wherever '" + other.skill +
                                            "' may, and makes true all that it does: plans of "
                                            "any task may take it instead",
                                        "ask for more, or for types of your own; or extends = \"" + other.skill +
                                            "\", and skills = { \"" + name + "\" } in the tasks that want it"));
      }
    }
  }
}

}  // namespace stampede
