#include "engine/bddl/express.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

using Kind = BddlFormula::Kind;

constexpr int kDeepestDefinition = 20;  // derived predicates in derived predicates; recursive ones never end

bool is_constant(const BddlFormula& formula, bool value) {
  return formula.kind == (value ? Kind::conjunction : Kind::disjunction) && formula.parts.empty();
}

BddlFormula constant(bool value) {
  BddlFormula formula;
  formula.kind = value ? Kind::conjunction : Kind::disjunction;
  return formula;
}

}  // namespace

BddlExpression::BddlExpression(const BddlScene& scene, const BddlMapping& mapping, const Domain& domain,
                               BddlNaming& naming, BddlExport& result)
    : scene_(scene), mapping_(mapping), domain_(domain), naming_(naming), result_(result) {
  for (const BddlThing& thing : scene.things) objects_.push_back({thing.name, thing.type});
  std::sort(objects_.begin(), objects_.end());
}

BddlFormula BddlExpression::join(std::vector<BddlFormula> parts, bool all) const {
  BddlFormula result = constant(all);
  for (BddlFormula& part : parts) {
    if (is_constant(part, !all)) return std::move(part);
    if (is_constant(part, all)) continue;
    if (part.kind == result.kind) {  // flatten
      for (BddlFormula& inner : part.parts) result.parts.push_back(std::move(inner));
    } else {
      result.parts.push_back(std::move(part));
    }
  }
  std::vector<BddlFormula> once;  // folded parts say the same twice
  for (BddlFormula& part : result.parts) {
    if (std::find(once.begin(), once.end(), part) == once.end()) once.push_back(std::move(part));
  }
  if (once.size() == 1) return std::move(once.front());
  result.parts = std::move(once);
  return result;
}

bool BddlExpression::fixed(const std::string& predicate) const {
  const Predicate* declared = domain_.predicate(predicate);
  if (declared != nullptr) return declared->kind == PredicateKind::fixed;
  return std::find(domain_.traits.begin(), domain_.traits.end(), predicate) != domain_.traits.end();
}

// Within a region of theirs that has ranges: those are flat.
bool BddlExpression::within_flat(const std::string& predicate, const BddlThing* last) const {
  return mapping_.dialect == BddlDialect::libero && predicate == mapping_.within && last != nullptr &&
         last->kind == BddlThing::Kind::region && !last->area.empty();
}

BddlFormula BddlExpression::atom_by(const BddlPredicateRule& rule, const std::vector<std::string>& names) {
  BddlFormula atom;
  atom.predicate = rule.theirs;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::string& name = names.at(rule.order.empty() ? i : static_cast<std::size_t>(rule.order.at(i)));
    const bool variable = name.starts_with('?');
    atom.terms.push_back({variable, variable ? name.substr(1) : naming_.theirs(name)});
    if (mapping_.dialect == BddlDialect::libero) naming_.declare(name);
  }
  return atom;
}

void BddlExpression::put_on_fixture(const std::string& ours, const BddlThing& fixture, BddlFormula& atom) {
  if (fixture.area.empty()) {
    naming_.remark(ours + ": no area is known, so theirs asks that the centres are within 3 cm of one another");
  } else {
    atom.terms.back().name = naming_.surface(fixture);
  }
}

// How far theirs means the same. `last`: the literal's last argument, where it is a thing.
BddlNote BddlExpression::note_of(const BddlPredicateRule& rule, const std::string& predicate, const BddlThing* last,
                                 bool negated) const {
  const bool their_negation = rule.negated != negated;
  BddlNote note{(their_negation ? "not " : "") + rule.theirs, (negated ? "not " : "") + predicate,
                negated ? opposite(rule.meaning) : rule.meaning, rule.why};
  if (within_flat(predicate, last)) {
    note.meaning = negated ? BddlMeaning::stronger : BddlMeaning::weaker;
    note.why = "theirs asks also for contact with what the region lies on";
  }
  const bool libero = mapping_.dialect == BddlDialect::libero;
  if (libero || last == nullptr || last->kind != BddlThing::Kind::part) return note;
  note.why += "; the part is folded into its body, whose other parts count there too";
  // Their `open` of the whole is weaker still; their `not open` needs all parts shut, which ours of one part does not.
  if (their_negation || note.meaning == BddlMeaning::equal) note.meaning = BddlMeaning::incomparable;
  return note;
}

BddlFormula BddlExpression::literal(const std::string& predicate, const std::vector<std::string>& names, bool negated) {
  const std::string ours = to_text(Fact{predicate, names});
  const BddlThing* last = names.empty() ? nullptr : naming_.thing(names.back());
  const bool over_region = within_flat(predicate, last);
  const BddlPredicateRule* rule = mapping_.from_ours(over_region ? mapping_.support : predicate, negated);
  if (rule == nullptr) {
    throw Refusal{ours + ": " + std::string(to_string(mapping_.dialect)) + " has no predicate for `" + predicate +
                  "`; add one to the mapping, or leave it out of the goal"};
  }
  BddlFormula formula = atom_by(*rule, names);
  const bool on_fixture = mapping_.dialect == BddlDialect::libero && last != nullptr &&
                          last->kind == BddlThing::Kind::fixture && predicate == mapping_.support && names.size() == 2;
  if (on_fixture) put_on_fixture(ours, *last, formula);
  result_.notes.insert(note_of(*rule, predicate, last, negated));
  if (rule->negated == negated) return formula;
  BddlFormula negation;
  negation.kind = Kind::negation;
  negation.parts = {formula};
  return negation;
}

BddlFormula BddlExpression::atom_formula(const Formula& formula, bool negated) {
  std::vector<std::string> names;
  for (const Term& term : formula.terms) {
    const auto bound = binding_.find(term.name);
    if (term.variable && bound == binding_.end()) {
      throw Error("goal", "`?" + term.name + "` is bound by nothing", "name an object or add a quantifier");
    }
    names.push_back(term.variable ? bound->second : term.name);
  }
  if (formula.kind == Formula::Kind::equal) return constant((names.at(0) == names.at(1)) != negated);
  if (fixed(formula.predicate)) return constant((scene_.facts.count({formula.predicate, names}) > 0) != negated);
  if (++atoms_ > kMostBddlAtoms) {
    throw Refusal{"the goal grows to more than " + std::to_string(kMostBddlAtoms) + " atoms; take fewer objects"};
  }
  const Predicate* declared = domain_.predicate(formula.predicate);
  const bool mapped = mapping_.from_ours(formula.predicate, negated) != nullptr;
  if (mapped || declared == nullptr || declared->kind != PredicateKind::derived) {
    return literal(formula.predicate, names, negated);
  }
  if (++depth_ > kDeepestDefinition) {
    throw Refusal{"`" + formula.predicate + "` is defined by itself, which BDDL cannot say; leave it out of the goal"};
  }
  Binding outer;
  for (std::size_t i = 0; i < names.size(); ++i) outer[declared->parameters.at(i).name] = names[i];
  std::swap(outer, binding_);
  BddlFormula result = this->formula(declared->derived, negated);
  std::swap(outer, binding_);
  --depth_;
  return result;
}

BddlFormula BddlExpression::formula(const Formula& formula, bool negated) {
  std::vector<BddlFormula> parts;
  switch (formula.kind) {
    case Formula::Kind::always:
    case Formula::Kind::never:
      return constant((formula.kind == Formula::Kind::always) != negated);
    case Formula::Kind::atom:
    case Formula::Kind::equal:
      return atom_formula(formula, negated);
    case Formula::Kind::negation:
      return this->formula(formula.parts.at(0), !negated);
    case Formula::Kind::conjunction:
    case Formula::Kind::disjunction:
      for (const Formula& part : formula.parts) parts.push_back(this->formula(part, negated));
      return join(std::move(parts), (formula.kind == Formula::Kind::conjunction) != negated);
    case Formula::Kind::exists:
    case Formula::Kind::forall:
      return quantified(formula, negated);
  }
  return constant(true);
}

// Only predicates that are written as they stand: nothing that depends on which object the variable is.
bool BddlExpression::plain(const Formula& formula) const {
  if (formula.kind == Formula::Kind::equal) return false;
  if (formula.kind == Formula::Kind::atom) {
    return mapping_.from_ours(formula.predicate, false) != nullptr && !fixed(formula.predicate);
  }
  const auto traits = [](const Parameter& variable) { return !variable.traits.empty(); };
  return std::none_of(formula.variables.begin(), formula.variables.end(), traits) &&
         std::all_of(formula.parts.begin(), formula.parts.end(), [&](const Formula& part) { return plain(part); });
}

// Whether the variable ranges over exactly the instances of one category.
bool BddlExpression::keep(const Formula& formula, std::string& category) const {
  if (mapping_.dialect != BddlDialect::behavior || formula.variables.size() != 1 || !plain(formula.parts.at(0))) {
    return false;
  }
  std::set<std::string> values;
  for (const TypedObject& object : objects_) {
    if (!admits(formula.variables[0], object, {scene_.facts, domain_, objects_})) continue;
    const auto name = result_.names.find(object.name);
    if (name == result_.names.end() || !values.insert(name->second).second) return false;
    if (naming_.thing(object.name)->kind == BddlThing::Kind::part) return false;
  }
  for (const BddlGroup& group : result_.problem.objects) {
    if (std::set<std::string>(group.names.begin(), group.names.end()) != values) continue;
    category = group.category;
    const auto same = [&](const auto& bound) { return bound.second == "?" + category; };
    return std::none_of(binding_.begin(), binding_.end(), same);
  }
  return false;
}

BddlFormula BddlExpression::quantified(const Formula& formula, bool negated) {
  const bool all = (formula.kind == Formula::Kind::forall) != negated;
  std::string category;
  if (keep(formula, category)) {
    const std::string& variable = formula.variables[0].name;
    const Binding outer = binding_;
    binding_[variable] = "?" + category;
    BddlFormula result;
    result.kind = all ? Kind::forall : Kind::exists;
    result.variables = {{category, category, {}}};
    result.parts = {this->formula(formula.parts.at(0), negated)};
    binding_ = outer;
    const bool decided = is_constant(result.parts[0], true) || is_constant(result.parts[0], false);
    return decided ? std::move(result.parts[0]) : result;
  }
  std::vector<BddlFormula> parts;
  for_each_binding(formula.variables, {scene_.facts, domain_, objects_}, binding_, [&] {
    parts.push_back(this->formula(formula.parts.at(0), negated));
    return true;
  });
  return join(std::move(parts), all);
}

}  // namespace stampede::symbolic
