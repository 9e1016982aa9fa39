#include "engine/bddl/translate.h"

#include <algorithm>

#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

using Kind = BddlFormula::Kind;

Formula never() { return disjunction({}); }

// Calls visit for each choice of `count` of 0 … of - 1, in order.
void for_each_subset(std::size_t of, std::size_t count,
                     const std::function<void(const std::vector<std::size_t>&)>& visit,
                     std::vector<std::size_t> chosen = {}) {
  if (chosen.size() == count) {
    visit(chosen);
    return;
  }
  for (std::size_t i = chosen.empty() ? 0 : chosen.back() + 1; i < of; ++i) {
    chosen.push_back(i);
    for_each_subset(of, count, visit, chosen);
    chosen.pop_back();
  }
}

// Calls visit for each list of `count` different numbers of 0 … of - 1.
void for_each_injection(std::size_t of, std::size_t count,
                        const std::function<void(const std::vector<std::size_t>&)>& visit,
                        std::vector<std::size_t> chosen = {}) {
  if (chosen.size() == count) {
    visit(chosen);
    return;
  }
  for (std::size_t i = 0; i < of; ++i) {
    if (std::find(chosen.begin(), chosen.end(), i) != chosen.end()) continue;
    chosen.push_back(i);
    for_each_injection(of, count, visit, chosen);
    chosen.pop_back();
  }
}

double subsets(std::size_t of, std::size_t count) {
  double number = count > of ? 0 : 1;
  for (std::size_t i = 0; i < count && i < of; ++i) {
    number *= static_cast<double>(of - i) / static_cast<double>(i + 1);
  }
  return number;
}

double injections(std::size_t of, std::size_t count) {
  double number = count > of ? 0 : 1;
  for (std::size_t i = 0; i < count && i < of; ++i) number *= static_cast<double>(of - i);
  return number;
}

std::string signed_name(const std::string& name, bool negated) { return (negated ? "not " : "") + name; }

}  // namespace

BddlTranslator::BddlTranslator(const BddlProblem& problem, const BddlMapping& mapping, BddlTask& task)
    : problem_(problem), mapping_(mapping), task_(task), scope_(problem) {}

Formula BddlTranslator::join(std::vector<Formula> parts, bool all) const {
  const auto decides = all ? Formula::Kind::never : Formula::Kind::always;
  const auto idle = all ? Formula::Kind::always : Formula::Kind::never;
  std::vector<Formula> kept;
  for (Formula& part : parts) {
    if (part.kind == decides) return std::move(part);
    if (part.kind != idle) kept.push_back(std::move(part));
  }
  return all ? conjunction(std::move(kept)) : disjunction(std::move(kept));
}

const BddlMadeRegion* BddlTranslator::made_region(const std::string& theirs) const {
  for (const BddlMadeRegion& region : task_.regions) {
    if (region.theirs == theirs) return &region;
  }
  return nullptr;
}

Formula BddlTranslator::literal(const Fact& atom, bool negated) {
  if (problem_.dialect == BddlDialect::libero) {
    if (atom.predicate == "true" || atom.predicate == "printjointstate") return negated ? never() : Formula{};
    if (atom.predicate == "false") return negated ? Formula{} : never();
  }
  for (const std::string& name : atom.arguments) {
    if (task_.names.count(name) == 0) throw Refusal{"`" + name + "` stands for nothing here"};
  }
  const std::string& last = task_.names.at(atom.arguments.back());
  static const std::set<std::string> kOfParts = {"open", "close", "in", "inside"};
  const auto* parts = kOfParts.count(atom.predicate) > 0 ? parts_of(atom.arguments.back()) : nullptr;
  if (parts == nullptr) return plain_literal(atom, negated, last);
  std::vector<Formula> of_parts;
  for (const std::string& part : *parts) of_parts.push_back(plain_literal(atom, negated, last + "." + part));
  return join(std::move(of_parts), (atom.predicate == "close") != negated);
}

const std::vector<std::string>* BddlTranslator::parts_of(const std::string& theirs) const {
  for (const auto* things : {&task_.fixtures, &task_.objects}) {
    for (const BddlObject& thing : *things) {
      if (thing.theirs != theirs) continue;
      const auto found = mapping_.parts.find(thing.class_name);
      return found == mapping_.parts.end() || found->second.empty() ? nullptr : &found->second;
    }
  }
  return nullptr;
}

Formula BddlTranslator::plain_literal(const Fact& atom, bool negated, const std::string& last) {
  const BddlPredicateRule* rule = mapping_.from_theirs(atom.predicate, negated);
  if (rule == nullptr) {
    throw Refusal{to_text(atom) + ": `" + atom.predicate + "` has no counterpart of ours; add one to the mapping"};
  }
  std::vector<Term> terms(atom.arguments.size());
  for (std::size_t i = 0; i < atom.arguments.size(); ++i) {
    const std::size_t at = rule->order.empty() ? i : static_cast<std::size_t>(rule->order.at(i));
    terms.at(at) = {false, i + 1 == atom.arguments.size() ? last : task_.names.at(atom.arguments[i])};
  }
  const bool ours_negated = (rule->negated != negated) != (rule->toggles && on_at_start(atom));
  BddlNote note{signed_name(atom.predicate, negated), signed_name(rule->ours, ours_negated),
                ours_negated ? opposite(rule->meaning) : rule->meaning, rule->why};
  std::vector<Formula> parts;
  const BddlMadeRegion* region = atom.arguments.empty() ? nullptr : made_region(atom.arguments.back());
  if (region != nullptr && rule->ours == mapping_.support && !rule->negated) {
    parts.push_back(stampede::atom(mapping_.within, terms));
    for (Term& term : terms) {
      if (term.name == region->name) term.name = region->on;
    }
    note.ours += " and " + mapping_.within;
    note.meaning = negated ? BddlMeaning::weaker : BddlMeaning::stronger;
    note.why = "of a region both ask that the object is over it; ours also that the surface carries it";
  }
  parts.insert(parts.begin(), with_choices(atom.predicate, rule->ours, terms, 0));
  task_.notes.insert(note);
  Formula result = conjunction(std::move(parts));
  if (ours_negated) result = negation(std::move(result));
  return result;
}

// Our atom; of the parts that it can be said of, where it cannot be said of a thing as a whole.
Formula BddlTranslator::with_choices(const std::string& theirs, const std::string& ours, std::vector<Term> terms,
                                     std::size_t from) {
  for (std::size_t i = from; i < terms.size(); ++i)
    for (const auto* things : {&task_.fixtures, &task_.objects})
      for (const BddlObject& thing : *things) {
        const auto found = mapping_.choices.find({thing.class_name, ours, i});
        if (thing.name != terms[i].name || found == mapping_.choices.end()) continue;
        std::vector<Formula> each;
        for (const std::string& part : found->second) {
          terms[i].name = thing.name + "." + part;
          each.push_back(with_choices(theirs, ours, terms, i + 1));
        }
        return join(std::move(each), theirs == "close");
      }
  return stampede::atom(ours, std::move(terms));
}

bool BddlTranslator::on_at_start(const Fact& atom) const {
  return std::any_of(problem_.init.begin(), problem_.init.end(), [&](const BddlLiteral& literal) {
    return literal.atom.predicate == "turnon" && !literal.negated && literal.atom.arguments == atom.arguments;
  });
}

Formula BddlTranslator::atom_formula(const BddlFormula& formula, bool negated) {
  if (++atoms_ > kMostBddlAtoms) {
    throw Refusal{"the goal grows to more than " + std::to_string(kMostBddlAtoms) +
                  " ground atoms; take fewer objects"};
  }
  Fact fact{formula.predicate, {}};
  for (const Term& term : formula.terms) {
    const auto bound = binding_.find(term.name);
    fact.arguments.push_back(bound == binding_.end() ? term.name : bound->second);
  }
  Formula result = literal(fact, negated);
  const bool constant = result.kind == Formula::Kind::always || result.kind == Formula::Kind::never;
  if (!constant) task_.literals.emplace(std::pair{fact, negated}, result);
  return result;
}

Formula BddlTranslator::formula(const BddlFormula& formula, bool negated) {
  std::vector<Formula> parts;
  switch (formula.kind) {
    case Kind::atom:
      return atom_formula(formula, negated);
    case Kind::negation:
      return this->formula(formula.parts.at(0), !negated);
    case Kind::conjunction:
    case Kind::disjunction:
      for (const BddlFormula& part : formula.parts) parts.push_back(this->formula(part, negated));
      return join(std::move(parts), (formula.kind == Kind::conjunction) != negated);
    case Kind::implication:
      parts.push_back(this->formula(formula.parts.at(0), !negated));
      parts.push_back(this->formula(formula.parts.at(1), negated));
      return join(std::move(parts), negated);
    case Kind::forall:
    case Kind::exists:
      return each(formula, (formula.kind == Kind::forall) != negated, negated);
    case Kind::forn:
      return exactly(formula, negated);
    case Kind::forpairs:
    case Kind::fornpairs:
      return pairs(formula, negated);
  }
  return {};
}

std::vector<std::string> BddlTranslator::instances(const Parameter& variable) const {
  const auto* names = scope_.instances(variable.type);
  std::vector<std::string> result = names == nullptr ? std::vector<std::string>{} : *names;
  if (!result.empty() && is_wildcard(result.back())) {
    throw Refusal{"the goal counts `" + result.back() + "`, which is not expanded; say how many the room has"};
  }
  return result;
}

Formula BddlTranslator::with_value(const BddlFormula& formula, std::size_t variable, const std::string& value,
                                   bool negated) {
  const std::string& name = formula.variables.at(variable).name;
  binding_[name] = value;
  Formula result = this->formula(formula.parts.at(0), negated);
  binding_.erase(name);
  return result;
}

Formula BddlTranslator::each(const BddlFormula& formula, bool all, bool negated) {
  std::vector<Formula> parts;
  for (const std::string& value : instances(formula.variables.at(0))) {
    parts.push_back(with_value(formula, 0, value, negated));
  }
  return join(std::move(parts), all);
}

void BddlTranslator::limit(const BddlFormula& formula, double disjuncts) const {
  if (disjuncts <= kMostBddlDisjuncts) return;
  throw Refusal{to_text(formula) + " needs more than " + std::to_string(kMostBddlDisjuncts) +
                " cases when it is written out; take fewer objects"};
}

Formula BddlTranslator::exactly(const BddlFormula& formula, bool negated) {
  const std::vector<std::string> values = instances(formula.variables.at(0));
  const auto count = static_cast<std::size_t>(formula.count);
  limit(formula, subsets(values.size(), count));
  std::vector<Formula> cases;
  for_each_subset(values.size(), count, [&](const std::vector<std::size_t>& chosen) {
    std::vector<Formula> parts;
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool wanted = std::find(chosen.begin(), chosen.end(), i) != chosen.end();
      parts.push_back(with_value(formula, 0, values[i], wanted == negated));
    }
    cases.push_back(join(std::move(parts), !negated));
  });
  return join(std::move(cases), negated);
}

Formula BddlTranslator::pairs(const BddlFormula& formula, bool negated) {
  const std::vector<std::string> rows = instances(formula.variables.at(0)),
                                 columns = instances(formula.variables.at(1));
  const bool all = formula.kind == Kind::forpairs;
  const std::size_t count = all ? std::min(rows.size(), columns.size()) : static_cast<std::size_t>(formula.count);
  limit(formula, subsets(rows.size(), count) * injections(columns.size(), count));
  task_.notes.insert({signed_name(all ? "forpairs" : "fornpairs", negated), signed_name("a matching", negated),
                      negated ? BddlMeaning::weaker : BddlMeaning::stronger,
                      "theirs counts rows and columns with a true entry: one object may serve several pairs"});
  std::vector<Formula> cases;
  for_each_subset(rows.size(), count, [&](const std::vector<std::size_t>& chosen) {
    for_each_injection(columns.size(), count, [&](const std::vector<std::size_t>& partner) {
      std::vector<Formula> parts;
      for (std::size_t i = 0; i < count; ++i) {
        if (rows[chosen[i]] == columns[partner[i]]) return;  // nothing is paired with itself
        binding_[formula.variables.at(0).name] = rows[chosen[i]];
        parts.push_back(with_value(formula, 1, columns[partner[i]], negated));
      }
      cases.push_back(join(std::move(parts), !negated));
    });
  });
  binding_.erase(formula.variables.at(0).name);
  return join(std::move(cases), negated);
}

}  // namespace stampede::symbolic
