// Skills and the actions that they are in the domain.
#include <algorithm>

#include "engine/model/operation.h"
#include "scripting/library/checks.h"

namespace stampede {
namespace {

class SkillReader {
 public:
  SkillReader(LibraryDraft& draft, const Definition& definition)
      : draft_(draft), domain_(draft.vocabulary().domain), definition_(definition), node_(definition.node) {}

  SkillInfo read() {
    info_.name = definition_.file->name;
    read_parameters();
    info_.label = node_["label"].text;
    info_.stiffness = node_["stiffness"].number;
    check_label(definition_, info_.parameters);
    info_.moves = texts_of(node_["moves"]);
    info_.verbs = texts_of(node_["verbs"]);
    if (info_.verbs.empty()) info_.verbs.push_back(info_.label.substr(0, info_.label.find(" the {")));
    if (const std::string& name = node_["controller"].text; !name.empty()) read_controller(name);
    info_.forgets = texts_of(node_["forgets"]);
    for (const std::string& forgotten : info_.forgets)
      if (domain_.predicate(forgotten) == nullptr)
        definition_.complain_unknown("forgets", "predicate", forgotten, names_of(domain_.predicates));
    read_continuous(draft_, definition_, info_);
    read_replaced();
    read_cases();
    for (const std::string& moved : info_.moves) end_moved(moved);
    for (const Action& action : domain_.actions)
      if (action.skill == info_.name) info_.actions.push_back(action.name);
    return std::move(info_);
  }

 private:
  void read_parameters() {
    std::vector<Parameter>& parameters = info_.parameters;
    parameters = parameters_of(draft_, definition_);
    const bool has_hand =
        std::any_of(parameters.begin(), parameters.end(), [](const Parameter& one) { return one.type == "hand"; });
    if (!has_hand) parameters.push_back({"hand", "hand", {}});
  }

  void read_controller(const std::string& name) {
    if (const auto kind = controller_from(name))
      info_.controller = *kind;
    else
      definition_.complain_unknown("controller", "controller", name, controller_names());
  }

  void read_replaced() {
    const Value &extends = node_["extends"], &replaces = node_["replaces"];
    if (extends.present() && replaces.present())
      definition_.complain("replaces", "what extends a skill replaces that one", "take this field out");
    info_.replaces = extends.is_text() ? extends.text : replaces.text;
    if (!replaces.present()) return;
    std::vector<std::string> others = names_of(draft_.library()->files(DefinitionKind::skill));
    std::erase(others, info_.name);
    if (!listed(others, info_.replaces))
      definition_.complain_unknown("replaces", "other skill", info_.replaces, others);
  }

  void read_cases() {
    const Value& cases = node_["cases"];
    if (!cases.present()) return read_action(node_, {});
    for (const char* field : {"precondition", "effect"})
      if (node_[field].present())
        definition_.complain(field, "a skill with cases says it in each case", "move it into the cases");
    for (const auto& [name, fields] : cases.fields) read_action(fields, name);
  }

  void read_action(const Value& fields, const std::string& case_name) {
    Action action;
    action.skill = info_.name;
    action.case_name = case_name;
    action.name = case_name.empty() ? info_.name : info_.name + "_" + case_name;
    action.parameters = info_.parameters;
    const Value& cost = fields["cost"].present() ? fields["cost"] : node_["cost"];
    if (cost.is_number()) action.cost = static_cast<int>(cost.number);
    if (action.cost < 0) definition_.complain("cost", "a cost is not negative");
    const std::string prefix = case_name.empty() ? "" : "cases." + case_name + ".";
    const auto context = [&](const char* field) {
      return draft_.schema(definition_, prefix + field, info_.parameters);
    };
    const Value &precondition = fields["precondition"], &effect = fields["effect"];
    bool sound = draft_.complaints().guarded([&] {
      if (precondition.present()) action.precondition = formula_from(precondition, context("precondition"));
    });
    sound &= draft_.complaints().guarded([&] {
      if (effect.present()) action.effects = effects_from(effect, context("effect"));
    });
    action.may_equal = read_may_equal();
    if (!sound) return;
    check_hand(action, prefix + "effect");
    domain_.actions.push_back(std::move(action));
  }

  bool is_held(const std::string& predicate) const {
    const auto& all = draft_.vocabulary().predicate_traits;
    const auto found = all.find(predicate);
    return found != all.end() && found->second.requires_pairs == Pairs::held;
  }

  bool asks_for_held(const Formula& formula) const {
    if (formula.kind == Formula::Kind::atom) return is_held(formula.predicate);
    return formula.kind == Formula::Kind::conjunction &&
           std::ranges::any_of(formula.parts, [&](const Formula& part) { return asks_for_held(part); });
  }

  // Taking something ends `hand_empty`, letting go of it makes that true: who forgets it has plans that take two
  // things.
  void check_hand(const Action& action, const std::string& path) const {
    if (domain_.predicate("hand_empty") == nullptr) return;
    bool takes = false, lets_go = false, full = false, empty = false;
    for (const Effect& effect : action.effects) {
      const Predicate* predicate = domain_.predicate(effect.predicate);
      const bool of_hand = predicate != nullptr && hand_position(predicate->parameters, domain_) >= 0;
      if (effect.predicate == "hand_empty") (effect.negated ? full : empty) = true;
      if (!is_held(effect.predicate) || effect.when.kind != Formula::Kind::always) continue;
      takes |= !effect.negated;
      lets_go |= effect.negated && of_hand && effect.forall.empty();
    }
    if (takes && !full && !asks_for_held(action.precondition))
      definition_.complain(path, "it takes something into the hand, and does not say that this is no longer empty",
                           "add is_not.hand_empty()");
    if (lets_go && !takes && !empty)
      definition_.complain(path, "it lets go of what the hand holds, and does not say that this is empty then",
                           "add is.hand_empty()");
  }

  std::vector<std::pair<std::string, std::string>> read_may_equal() const {
    std::vector<std::pair<std::string, std::string>> pairs;
    for (const Value& pair : node_["may_equal"].items) {
      if (pair.items.size() != 2) {
        definition_.complain("may_equal", "a pair has two parameters", "such as may_equal = { { \"from\", \"to\" } }");
        continue;
      }
      for (const Value& name : pair.items) require_parameter("may_equal", name.text);
      pairs.emplace_back(pair.items[0].text, pair.items[1].text);
    }
    return pairs;
  }

  bool require_parameter(const char* field, const std::string& name) const {
    const std::vector<std::string> names = names_of(info_.parameters);
    if (listed(names, name)) return true;
    definition_.complain_unknown(field, "parameter", name, names);
    return false;
  }

  // What it moves ends the facts that say so of themselves.
  void end_moved(const std::string& moved) {
    if (!require_parameter("moves", moved)) return;
    const auto& all_traits = draft_.vocabulary().predicate_traits;
    for (const Predicate& predicate : domain_.predicates) {
      const auto traits = all_traits.find(predicate.name);
      if (traits == all_traits.end() || !traits->second.ends_when_moved) continue;
      for (std::size_t i = 0; i < predicate.parameters.size(); ++i) {
        if (!may_be(moved, predicate.parameters[i].type)) continue;
        const Effect effect = ended(predicate, i, moved);
        for (Action& action : domain_.actions)
          if (action.skill == info_.name) action.effects.push_back(effect);
      }
    }
  }

  // Can the skill's parameter be of this type?
  bool may_be(const std::string& parameter, const std::string& asked) const {
    const auto found = std::find_if(info_.parameters.begin(), info_.parameters.end(),
                                    [&](const Parameter& one) { return one.name == parameter; });
    const std::string& given = found->type;
    return asked.empty() || given.empty() || domain_.is_a(asked, given) || domain_.is_a(given, asked);
  }

  // Of what is moved as this argument of the predicate: forall others, when it holds.
  Effect ended(const Predicate& predicate, std::size_t argument, const std::string& moved) const {
    Effect effect;
    effect.predicate = predicate.name;
    effect.negated = true;
    for (std::size_t k = 0; k < predicate.parameters.size(); ++k) {
      Parameter other = predicate.parameters[k];
      while (k != argument && listed(names_of(info_.parameters), other.name)) other.name += "_of_it";
      effect.terms.push_back({true, k == argument ? moved : other.name});
      if (k != argument) effect.forall.push_back(other);
    }
    std::vector<Formula> when = {atom(effect.predicate, effect.terms)};
    for (std::size_t k = 0; k < effect.terms.size(); ++k)
      if (k != argument) when.push_back(negation(load_of(effect.terms[k], effect.terms[argument])));
    effect.when = conjunction(std::move(when));
    return effect;
  }

  // Does it lie on or in the thing, or on or in what does so? Then it goes along with it.
  Formula load_of(const Term& load, const Term& thing) const {
    const Term between{true, "what_bears_it"};
    Formula on_another;
    on_another.kind = Formula::Kind::exists;
    on_another.variables = {{between.name, "", {}}};
    on_another.parts = {conjunction({lies_on(load, between), lies_on(between, thing)})};
    return disjunction({lies_on(load, thing), std::move(on_another)});
  }

  Formula lies_on(const Term& load, const Term& thing) const {
    const auto known = [&](const char* name) {
      const Predicate* predicate = domain_.predicate(name);
      return predicate != nullptr && predicate->parameters.size() == 2;
    };
    std::vector<Formula> ways;
    if (known("on")) ways.push_back(atom("on", {load, thing}));
    if (!known("inside")) return disjunction(std::move(ways));
    const Term space{true, "space_of_it"};
    Formula in_part;
    in_part.kind = Formula::Kind::exists;
    in_part.variables = {{space.name, "", {}}};
    in_part.parts = {conjunction({atom("part_of", {space, thing}), atom("inside", {load, space})})};
    ways.push_back(atom("inside", {load, thing}));
    ways.push_back(std::move(in_part));
    return disjunction(std::move(ways));
  }

  LibraryDraft& draft_;
  Domain& domain_;
  const Definition& definition_;
  const Value& node_;
  SkillInfo info_;
};

// Relations that skills make by where they put things: who makes them, and who ends them.
void relate(LibraryDraft& draft) {
  auto& vocabulary = draft.vocabulary();
  for (const auto& [name, definition] : draft.of(DefinitionKind::predicate)) {
    PredicateTraits& traits = vocabulary.predicate_traits[name];
    const std::vector<std::string> said = traits.made_by;
    if (said.empty()) continue;
    for (const std::string& skill : said)
      if (draft.library()->file(DefinitionKind::skill, skill) == nullptr)
        definition.complain_unknown("made_by", "skill", skill, names_of(draft.library()->files(DefinitionKind::skill)));
    for (const auto& [skill, info] : vocabulary.skills) {
      if (listed(said, info.replaces)) traits.made_by.push_back(skill);
      for (const std::string& moved : info.moves) traits.moved_by.emplace_back(skill, moved);
    }
  }
}

}  // namespace

void read_skills(LibraryDraft& draft) {
  auto& vocabulary = draft.vocabulary();
  const Definitions& skills = draft.of(DefinitionKind::skill);
  for (const auto& [name, definition] : skills) vocabulary.skills[name] = SkillReader(draft, definition).read();
  relate(draft);
  std::map<std::string, std::string> owner;
  for (const Action& action : vocabulary.domain.actions) {
    const auto [found, fresh] = owner.emplace(action.name, action.skill);
    if (fresh || found->second == action.skill) continue;
    skills.at(action.skill)
        .complain({}, "the action '" + action.name + "' is also one of skill '" + found->second + "'",
                  "rename the skill or its case");
  }
}

}  // namespace stampede
