// Predicates and attributes.
#include <algorithm>
#include <functional>

#include "engine/base/naming.h"
#include "scripting/library/checks.h"

namespace stampede {
namespace {

// Every predicate that a formula reads, with whether it stands under a negation.
void predicates_in(const Formula& formula, bool negated, const std::function<void(const std::string&, bool)>& visit) {
  if (formula.kind == Formula::Kind::atom) visit(formula.predicate, negated);
  const bool flips = formula.kind == Formula::Kind::negation;
  const bool both =
      formula.kind == Formula::Kind::forall;  // forall is not exists not: what it ranges over counts as negated
  for (const Formula& part : formula.parts) predicates_in(part, flips ? !negated : (negated || both), visit);
}

PredicateKind kind_of(const Value& node) {
  if (node["start_only"].boolean) return PredicateKind::start;
  if (node["derived"].present()) return PredicateKind::derived;
  return node["static"].boolean ? PredicateKind::fixed : PredicateKind::basic;
}

Predicate declared(LibraryDraft& draft, const Definition& definition) {
  const Value& node = definition.node;
  Predicate predicate;
  predicate.name = definition.file->name;
  predicate.parameters = parameters_of(draft, definition);
  predicate.label = node["label"].text;
  predicate.kind = kind_of(node);
  if (predicate.kind == PredicateKind::start) {
    for (const char* other : {"derived", "static", "momentary", "remember", "settle", "observable"})
      if (node[other].present())
        definition.complain(other, "a predicate that is only asked of starts has no '" + std::string(other) + "'",
                            "leave it out, or leave start_only out");
  }
  check_label(definition, predicate.parameters);
  const bool derived = node["derived"].present(), holds = node["holds"].present();
  if (derived && holds) definition.complain("derived", "a predicate has holds or derived, not both", "keep one");
  if (!derived && !holds)
    definition.complain({}, "a predicate needs holds or derived", "holds = function(w, …) return … end");
  return predicate;
}

std::set<std::string> attributes_of(const Definitions& objects) {
  std::set<std::string> attributes = {"colour", "part_name", "part_of"};
  for (const auto& [name, definition] : objects) {
    for (const auto& [attribute, value] : definition.node["attributes"].fields) attributes.insert(attribute);
    for (const auto& [part_name, part] : definition.node["parts"].fields)
      for (const auto& [attribute, value] : part["attributes"].fields) attributes.insert(attribute);
  }
  return attributes;
}

// (colour block1 red): a constraint or goal that a run brings along may speak of it, whatever the files do.
void declare_attributes(LibraryDraft& draft) {
  Domain& domain = draft.vocabulary().domain;
  for (const std::string& attribute : attributes_of(draft.of(DefinitionKind::object))) {
    if (domain.predicate(attribute) != nullptr) continue;
    Predicate predicate;
    predicate.name = attribute;
    predicate.kind = PredicateKind::fixed;
    predicate.parameters = {{"obj", "", {}}, {"value", "value", {}}};
    predicate.label = "the " + attribute + " of the {obj} is {value}";
    if (attribute == "part_of") {
      predicate.parameters = {{"part", "", {}}, {"whole", "", {}}};
      predicate.label.clear();  // nobody says so of what they see
    }
    domain.types["value"] = kRootType;
    domain.predicates.push_back(std::move(predicate));
  }
}

// What is measured for it.
Pairs required_pairs(const Definition& definition) {
  const std::string& name = definition.node["requires"].text;
  if (name == "touching") return Pairs::touching;
  if (name == "near") return Pairs::near;
  if (name == "held") return Pairs::held;
  if (!name.empty() && name != "all")
    definition.complain("requires", "'" + name + "' is not a kind of pairs",
                        did_you_mean(name, {"all", "held", "near", "touching"}));
  return Pairs::all;
}

bool ends_when_moved(const Definition& definition) {
  const Value& node = definition.node;
  const std::string& ends = node["ends_when"].text;
  if (!ends.empty() && ends != "moved")
    definition.complain("ends_when", "'" + ends + "' is nothing that ends a fact", "write \"moved\"");
  if (ends == "moved" && kind_of(node) != PredicateKind::basic)
    definition.complain("ends_when", "only what holds by itself can end so", "take it out of this file");
  return ends == "moved";
}

PredicateTraits traits_of(const Definition& definition) {
  const Value& node = definition.node;
  PredicateTraits traits;
  traits.settle_s = node["settle"].number;
  traits.momentary = node["momentary"].boolean;
  traits.remember = node["remember"].boolean;
  traits.margin_unit = node["margin_unit"].text;
  traits.requires_pairs = required_pairs(definition);
  traits.only_named = node["only_named"].boolean;
  traits.made_by = texts_of(node["made_by"]);
  traits.sampled = node["sample"].present();
  for (const char* field : {"only_named", "made_by"})
    if (node[field].present() && kind_of(node) != PredicateKind::basic)
      definition.complain(field, "only a predicate whose `holds` is read all the time has it",
                          "take it out of this file");
  traits.ends_when_moved = ends_when_moved(definition);
  if (traits.settle_s < 0) definition.complain("settle", "a settle time is not negative");
  if (traits.momentary && traits.settle_s > 0)
    definition.complain("settle", "a momentary predicate has no settle time", "remove one of both");
  return traits;
}

// What cannot hold together: a constraint that asks for it is refused before anything is placed.
void read_exclusions(const Definition& definition, const Predicate& predicate, const Domain& domain,
                     PredicateTraits& traits) {
  const std::vector<std::string> names = names_of(predicate.parameters);
  const Value& functional = definition.node["functional"];
  const std::string last = names.empty() ? "" : names.back();
  const std::string wanted = functional.kind == Value::Kind::text ? functional.text : functional.boolean ? last : "";
  if (functional.present() && !wanted.empty()) {
    const auto at = std::find(names.begin(), names.end(), wanted);
    if (at == names.end())
      definition.complain("functional", "it has no parameter '" + wanted + "'", did_you_mean(wanted, names));
    else
      traits.functional = static_cast<int>(at - names.begin());
  }
  for (const Value& other : definition.node["mutex"].items) {
    traits.mutex.push_back(other.text);
    if (domain.predicate(other.text) == nullptr)
      definition.complain_unknown("mutex", "predicate", other.text, names_of(domain.predicates));
  }
}

// Whether its facts can be hidden from everybody's eyes.
bool hides(const Definition& definition) {
  const Value& observable = definition.node["observable"];
  if (!observable.present() || (observable.kind == Value::Kind::boolean && observable.boolean)) return false;
  if (!definition.node["derived"].present()) return true;
  definition.complain("observable", "what a derived predicate lets be seen follows from what it is derived of",
                      "say observable there");
  return false;
}

void define(LibraryDraft& draft, const Definition& definition, Predicate& predicate) {
  auto& vocabulary = draft.vocabulary();
  PredicateTraits traits = traits_of(definition);
  read_exclusions(definition, predicate, vocabulary.domain, traits);
  vocabulary.predicate_traits[predicate.name] = std::move(traits);
  if (hides(definition)) vocabulary.hiding.insert(predicate.name);
  const Value& derived = definition.node["derived"];
  if (derived.present())
    draft.complaints().guarded(
        [&] { predicate.derived = formula_from(derived, draft.schema(definition, "derived", predicate.parameters)); });
}

// A derived predicate may not depend on its own negation: then no order of evaluation gives it a meaning.
void check_strata(LibraryDraft& draft) {
  const Domain& domain = draft.vocabulary().domain;
  std::map<std::string, int> stratum;
  const int most = static_cast<int>(domain.predicates.size());
  bool changed = true;
  while (changed) {
    changed = false;
    for (const Predicate& predicate : domain.predicates) {
      if (predicate.kind != PredicateKind::derived) continue;
      int level = 0;
      predicates_in(predicate.derived, false, [&](const std::string& name, bool negated) {
        const Predicate* used = domain.predicate(name);
        if (used != nullptr && used->kind == PredicateKind::derived)
          level = std::max(level, stratum[name] + (negated ? 1 : 0));
      });
      if (level <= stratum[predicate.name] || stratum[predicate.name] > most) continue;
      stratum[predicate.name] = level;
      changed = true;
    }
  }
  for (const Predicate& predicate : domain.predicates)
    if (stratum[predicate.name] > most)
      draft.of(DefinitionKind::predicate)
          .at(predicate.name)
          .complain("derived", "'" + predicate.name + "' depends on its own negation",
                    "break the circle: derive it from basic predicates");
}

}  // namespace

void declare_predicates(LibraryDraft& draft) {
  Domain& domain = draft.vocabulary().domain;
  for (const auto& [name, definition] : draft.of(DefinitionKind::predicate)) {
    if (domain.types.contains(name) || listed(domain.traits, name))
      definition.complain({}, "'" + name + "' is already a type or trait of worlds/types.lua",
                          "rename the file, to " + proposed_name(name, {name}) + ".lua for example");
    else
      domain.predicates.push_back(declared(draft, definition));
  }
  declare_attributes(draft);
  std::sort(domain.predicates.begin(), domain.predicates.end(),
            [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
}

void define_predicates(LibraryDraft& draft) {
  std::vector<Predicate>& predicates = draft.vocabulary().domain.predicates;
  for (const auto& [name, definition] : draft.of(DefinitionKind::predicate)) {
    const auto found = std::find_if(predicates.begin(), predicates.end(),
                                    [&, wanted = name](const Predicate& one) { return one.name == wanted; });
    if (found != predicates.end()) define(draft, definition, *found);
  }
  check_strata(draft);
}

}  // namespace stampede
