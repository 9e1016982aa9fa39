// Types, traits, predicates, attributes.
#include <algorithm>
#include <functional>

#include "scripting/library/builder.h"
#include "scripting/library/naming.h"
#include "scripting/library/source_lines.h"

namespace stampede {
namespace {

constexpr const char kRoot[] = "object";

// Every predicate that a formula reads, with whether it stands under a negation.
void predicates_in(const Formula& formula, bool negated, const std::function<void(const std::string&, bool)>& visit) {
  if (formula.kind == Formula::Kind::atom) visit(formula.predicate, negated);
  const bool flips = formula.kind == Formula::Kind::negation;
  const bool both =
      formula.kind == Formula::Kind::forall;  // forall is not exists not: what it ranges over counts as negated
  for (const Formula& part : formula.parts) predicates_in(part, flips ? !negated : (negated || both), visit);
}

}  // namespace

// worlds/types.lua of each root, and what objects declare for themselves: types = { cube = { parent = "block" } } or
// { cube = "block" }; traits by name or as a list.
void LibraryBuilder::read_types() {
  library_->domain_.types = {{"hand", kRoot}, {"region", kRoot}};
  TypeOrigins origins;
  for (const ScriptFile* file : library_->files(DefinitionKind::types)) {
    if (file->bytecode.empty()) continue;
    Definition& definition = type_files_.emplace_back(Definition{file, {}, field_lines(file->source)});
    const bool read = guarded([&] {
      DefinitionState state(library_);
      state.push(DefinitionKind::types, file->name);
      definition.node = value_as_written(state.state(), -1, file->shown_path);
    });
    if (read) declare_types(definition, "", definition.node, origins);
  }
  for (const auto& [name, definition] : of(DefinitionKind::object))
    if (const Value& declared = definition.node["declares"]; declared.is_table())
      declare_types(definition, "declares.", declared, origins);
  check_type_tree(origins);
}

void LibraryBuilder::declare_types(const Definition& definition, const std::string& prefix, const Value& node,
                                   TypeOrigins& origins) {
  Domain& domain = library_->domain_;
  for (const auto& [name, entry] : node["types"].fields) {
    const Value& parent = entry.is_table() ? entry["parent"] : entry;
    domain.types[name] = parent.is_text() ? parent.text : kRoot;
    origins[name] = {&definition, prefix + "types." + name};
    if (const auto fault = name_fault(name))
      complain(definition, prefix + "types." + name, "the type name '" + name + "' " + *fault,
               "such as '" + proposed_name(name) + "'");
  }
  std::vector<std::string> traits;
  for (const Value& item : node["traits"].items) traits.push_back(item.text);
  for (const auto& [name, description] : node["traits"].fields) traits.push_back(name);
  for (const auto& [name, entry] : node["traits"].fields)
    for (const auto& [key, value] : entry.fields)
      if (key != "numbers")
        complain(definition, prefix + "traits." + name + "." + key, "a trait has no field '" + key + "'",
                 name + " = { \"what can be done with it\", numbers = { … } }");
  for (const std::string& name : traits) {
    const auto place = std::lower_bound(domain.traits.begin(), domain.traits.end(), name);
    if (place == domain.traits.end() || *place != name) domain.traits.insert(place, name);
    origins["trait " + name] = {&definition, prefix + "traits." + name};
    if (const auto fault = name_fault(name))
      complain(definition, prefix + "traits." + name, "the trait name '" + name + "' " + *fault,
               "such as '" + proposed_name(name) + "'");
  }
  for (const auto& [key, value] : node.fields)
    if (key != "types" && key != "traits" && key != "numbers")
      complain(definition, prefix + key, "there is no field '" + key + "' beside types, traits and numbers",
               did_you_mean(key, {"types", "traits", "numbers"}));
}

void LibraryBuilder::check_type_tree(const TypeOrigins& origins) {
  Domain& domain = library_->domain_;
  const auto complain_of = [&](const std::string& name, const std::string& what, const std::string& hint) {
    const auto found = origins.find(name);
    if (found != origins.end()) complain(*found->second.first, found->second.second, what, hint);
  };
  std::vector<std::string> known;
  for (const auto& [name, parent] : domain.types) known.push_back(name);
  for (auto& [name, parent] : domain.types) {
    if (parent != kRoot && !domain.types.contains(parent)) {
      complain_of(name, "its parent '" + parent + "' is not a type", did_you_mean(parent, known));
      parent = kRoot;
    }
  }
  for (auto& [name, parent] : domain.types) {
    std::string chain = name, at = name;
    for (std::size_t step = 0; at != kRoot && step <= domain.types.size(); ++step) {
      at = domain.types.at(at);
      chain += " < " + at;
      if (at != name) continue;
      complain_of(name, "a cycle of types: " + chain, "every type ends at object");
      parent = kRoot;
      break;
    }
  }
  for (const std::string& name : domain.traits)
    if (domain.types.contains(name))
      complain_of("trait " + name, "'" + name + "' is a type too", "call the trait " + proposed_name(name, {name}));
}

std::vector<Parameter> LibraryBuilder::parameters_of(const Definition& definition, bool add_hand) {
  std::vector<Parameter> result;
  const std::string place = definition.file->shown_path + ":" + std::to_string(line_of(definition.lines, "params"));
  for (const Value& text : definition.node["params"].items) {
    if (!text.is_text()) continue;
    guarded([&] {
      Parameter parameter;
      try {
        parameter = parameter_from(text.text, library_->domain_, place);
      } catch (const Error& error) {
        add(Error(error.where(), "params: " + error.message(), error.hint()));
        parameter.name = text.text.substr(0, text.text.find(':'));  // kept, so that one fault is one complaint
      }
      for (const Parameter& other : result) {
        if (other.name == parameter.name)
          throw Error(place, "params: two parameters are called '" + parameter.name + "'", "rename one");
      }
      result.push_back(std::move(parameter));
    });
  }
  const bool has_hand =
      std::any_of(result.begin(), result.end(), [](const Parameter& one) { return one.type == "hand"; });
  if (add_hand && !has_hand) result.push_back({"hand", "hand", {}});
  return result;
}

void LibraryBuilder::check_label(const Definition& definition, const std::string& label,
                                 const std::vector<Parameter>& parameters) {
  std::vector<std::string> names;
  for (const Parameter& parameter : parameters) names.push_back(parameter.name);
  for (std::size_t open = label.find('{'); open != std::string::npos; open = label.find('{', open + 1)) {
    const std::size_t close = label.find('}', open);
    const std::string name = label.substr(open + 1, close == std::string::npos ? close : close - open - 1);
    if (close == std::string::npos) return complain(definition, "label", "a { without }");
    if (std::find(names.begin(), names.end(), name) == names.end()) {
      complain(definition, "label", "there is no parameter '" + name + "'", did_you_mean(name, names));
    }
  }
}

void LibraryBuilder::declare_predicates() {
  Domain& domain = library_->domain_;
  for (const auto& [name, definition] : of(DefinitionKind::predicate)) {
    const bool taken = domain.types.contains(name) ||
                       std::find(domain.traits.begin(), domain.traits.end(), name) != domain.traits.end();
    if (taken) {
      complain(definition, {}, "'" + name + "' is already a type or trait of worlds/types.lua",
               "rename the file, to " + proposed_name(name, {name}) + ".lua for example");
      continue;
    }
    Predicate predicate;
    predicate.name = name;
    predicate.parameters = parameters_of(definition, false);
    predicate.label = definition.node["label"].text;
    const bool derived = definition.node["derived"].present();
    if (derived) predicate.kind = PredicateKind::derived;
    if (!derived && definition.node["static"].boolean) predicate.kind = PredicateKind::fixed;
    if (definition.node["start_only"].boolean) {
      predicate.kind = PredicateKind::start;
      for (const char* other : {"derived", "static", "momentary", "remember", "settle", "observable"})
        if (definition.node[other].present())
          complain(definition, other, "a predicate that is only asked of starts has no '" + std::string(other) + "'",
                   "leave it out, or leave start_only out");
    }
    check_label(definition, predicate.label, predicate.parameters);
    if (derived && definition.node["holds"].present()) {
      complain(definition, "derived", "a predicate has holds or derived, not both", "keep one");
    } else if (!derived && !definition.node["holds"].present()) {
      complain(definition, {}, "a predicate needs holds or derived", "holds = function(w, …) return … end");
    }
    domain.predicates.push_back(std::move(predicate));
  }
}

// (colour block1 red): a constraint or goal that a run brings along may speak of it, whatever the files do.
void LibraryBuilder::declare_attributes() {
  Domain& domain = library_->domain_;
  attributes_ = {"colour", "part_name", "part_of"};
  for (const auto& [name, definition] : of(DefinitionKind::object)) {
    for (const auto& [attribute, value] : definition.node["attributes"].fields) attributes_.insert(attribute);
    for (const auto& [part_name, part] : definition.node["parts"].fields) {
      for (const auto& [attribute, value] : part["attributes"].fields) attributes_.insert(attribute);
    }
  }
  for (const std::string& attribute : attributes_) {
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
    domain.types["value"] = kRoot;
    domain.predicates.push_back(std::move(predicate));
  }
  std::sort(domain.predicates.begin(), domain.predicates.end(),
            [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
}

void LibraryBuilder::define_predicates() {
  for (const auto& [name, definition] : of(DefinitionKind::predicate)) {
    const auto found = std::find_if(library_->domain_.predicates.begin(), library_->domain_.predicates.end(),
                                    [&, wanted = name](const Predicate& one) { return one.name == wanted; });
    if (found == library_->domain_.predicates.end()) continue;
    const Value& node = definition.node;
    PredicateTraits traits;
    traits.settle_s = node["settle"].number;
    traits.momentary = node["momentary"].boolean;
    traits.remember = node["remember"].boolean;
    traits.margin_unit = node["margin_unit"].text;
    const std::string& pairs = node["requires"].text;
    if (pairs == "touching") traits.requires_pairs = Pairs::touching;
    if (pairs == "near") traits.requires_pairs = Pairs::near;
    if (pairs == "held") traits.requires_pairs = Pairs::held;
    if (!pairs.empty() && pairs != "touching" && pairs != "near" && pairs != "held" && pairs != "all") {
      complain(definition, "requires", "'" + pairs + "' is not a kind of pairs",
               did_you_mean(pairs, {"all", "held", "near", "touching"}));
    }
    const std::string& ends = node["ends_when"].text;
    traits.ends_when_moved = ends == "moved";
    if (!ends.empty() && ends != "moved")
      complain(definition, "ends_when", "'" + ends + "' is nothing that ends a fact", "write \"moved\"");
    if (traits.ends_when_moved && (node["derived"].present() || node["static"].boolean || node["start_only"].boolean))
      complain(definition, "ends_when", "only what holds by itself can end so", "take it out of this file");
    if (traits.settle_s < 0) complain(definition, "settle", "a settle time is not negative");
    if (traits.momentary && traits.settle_s > 0) {
      complain(definition, "settle", "a momentary predicate has no settle time", "remove one of both");
    }
    read_exclusions(definition, *found, traits);
    library_->predicate_traits_[name] = traits;
    const Value& observable = node["observable"];
    const bool hides = observable.present() && !(observable.kind == Value::Kind::boolean && observable.boolean);
    if (hides && node["derived"].present()) {
      complain(definition, "observable", "what a derived predicate lets be seen follows from what it is derived of",
               "say observable there");
    } else if (hides) {
      library_->hiding_.insert(name);
    }
    if (!node["derived"].present()) continue;
    guarded([&] {
      FormulaContext where = context(definition, "derived");
      where.schema = true;
      where.parameters = found->parameters;
      found->derived = formula_from(node["derived"], where);
    });
  }
}

// What cannot hold together: a constraint that asks for it is refused before anything is placed.
void LibraryBuilder::read_exclusions(const Definition& definition, const Predicate& predicate,
                                     PredicateTraits& traits) {
  std::vector<std::string> names;
  for (const Parameter& parameter : predicate.parameters) names.push_back(parameter.name);
  const Value& functional = definition.node["functional"];
  const std::string last = names.empty() ? "" : names.back();
  const std::string wanted = functional.kind == Value::Kind::text ? functional.text : functional.boolean ? last : "";
  if (functional.present() && !wanted.empty()) {
    const auto at = std::find(names.begin(), names.end(), wanted);
    if (at == names.end())
      complain(definition, "functional", "it has no parameter '" + wanted + "'", did_you_mean(wanted, names));
    else
      traits.functional = static_cast<int>(at - names.begin());
  }
  for (const Value& other : definition.node["mutex"].items) {
    traits.mutex.push_back(other.text);
    if (library_->domain_.predicate(other.text) != nullptr) continue;
    std::vector<std::string> known;
    for (const Predicate& one : library_->domain_.predicates) known.push_back(one.name);
    complain(definition, "mutex", "there is no predicate '" + other.text + "'", did_you_mean(other.text, known));
  }
}

// A derived predicate may not depend on its own negation: then no order of evaluation gives it a meaning.
void LibraryBuilder::check_strata() {
  const Domain& domain = library_->domain_;
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
  for (const Predicate& predicate : domain.predicates) {
    if (stratum[predicate.name] <= most) continue;
    const auto found = of(DefinitionKind::predicate).find(predicate.name);
    complain(found->second, "derived", "'" + predicate.name + "' depends on its own negation",
             "break the circle: derive it from basic predicates");
  }
}

}  // namespace stampede
