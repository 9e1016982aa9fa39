#include <map>

#include "engine/base/error.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/solutions.h"
#include "engine/symbolic/symbols.h"

namespace stampede::symbolic {
namespace {

// Raises `level` of `predicate` above what its definition uses: equal for positive uses, one more for negated ones.
bool raise(const Formula& formula, bool negated, std::map<std::string, int>& levels, int& level) {
  bool raised = false;
  if (formula.kind == Formula::Kind::atom) {
    const auto used = levels.find(formula.predicate);
    if (used != levels.end() && used->second + (negated ? 1 : 0) > level) {
      level = used->second + (negated ? 1 : 0);
      raised = true;
    }
  }
  const bool inner = negated != (formula.kind == Formula::Kind::negation);
  for (const Formula& part : formula.parts) raised |= raise(part, inner, levels, level);
  return raised;
}

}  // namespace

std::vector<std::vector<const Predicate*>> strata(const Domain& domain) {
  std::map<std::string, int> levels;
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::derived) levels[predicate.name] = 0;
  }
  const int count = static_cast<int>(levels.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (const Predicate& predicate : domain.predicates) {
      if (predicate.kind != PredicateKind::derived) continue;
      int& level = levels[predicate.name];
      changed |= raise(predicate.derived, false, levels, level);
      if (level > count) {
        throw Error("predicate " + predicate.name, "is derived from its own negation",
                    "define it so that no chain of `derived` leads back to it through is_not");
      }
    }
  }
  std::vector<std::vector<const Predicate*>> result(static_cast<std::size_t>(count) + 1);
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::derived) result[levels[predicate.name]].push_back(&predicate);
  }
  std::erase_if(result, [](const auto& stratum) { return stratum.empty(); });
  return result;
}

}  // namespace stampede::symbolic

namespace stampede {
namespace {

using symbolic::View;

// The atoms of a predicate that its definition makes true and that are not known yet.
std::vector<Fact> newly_true(const Predicate& predicate, const Formula& definition, const View& view) {
  std::vector<Term> terms;
  for (const Parameter& parameter : predicate.parameters) terms.push_back({true, parameter.name});
  std::vector<Fact> found;
  Binding binding;
  symbolic::for_each_solution(predicate.parameters, definition, view, binding, [&] {
    Fact fact = symbolic::ground_atom(predicate.name, terms, binding);
    if (!view.facts.contains(fact)) found.push_back(std::move(fact));
    return true;
  });
  return found;
}

bool uses(const Formula& formula, const std::vector<const Predicate*>& stratum) {
  if (formula.kind == Formula::Kind::atom) {
    for (const Predicate* predicate : stratum) {
      if (predicate->name == formula.predicate) return true;
    }
  }
  for (const Formula& part : formula.parts) {
    if (uses(part, stratum)) return true;
  }
  return false;
}

}  // namespace

void symbolic::collect_derived(const Formula& formula, const Domain& domain, std::set<std::string>& predicates) {
  if (formula.kind == Formula::Kind::atom) {
    const Predicate* predicate = domain.predicate(formula.predicate);
    if (predicate != nullptr && predicate->kind == PredicateKind::derived &&
        predicates.insert(predicate->name).second) {
      collect_derived(predicate->derived, domain, predicates);
    }
  }
  for (const Formula& part : formula.parts) collect_derived(part, domain, predicates);
}

std::vector<Fact> symbolic::add_derived(Facts& facts, const Domain& domain, const std::vector<TypedObject>& objects,
                                        const std::set<std::string>& predicates) {
  std::vector<Fact> added;
  if (predicates.empty()) return added;
  for (std::vector<const Predicate*> stratum : strata(domain)) {
    std::erase_if(stratum, [&](const Predicate* one) { return !predicates.contains(one->name); });
    bool recursive = false;
    std::vector<Formula> definitions;
    for (const Predicate* predicate : stratum) {
      recursive |= uses(predicate->derived, stratum);
      definitions.push_back(negation_normal(predicate->derived));
    }
    for (bool changed = true; changed;) {
      changed = false;
      for (std::size_t i = 0; i < stratum.size(); ++i) {
        for (Fact& fact : newly_true(*stratum[i], definitions[i], {facts, domain, objects})) {
          if (!facts.insert(fact).second) continue;
          changed = true;
          added.push_back(std::move(fact));
        }
      }
      changed &= recursive;
    }
  }
  return added;
}

Facts with_derived(const Facts& basic, const Domain& domain, const std::vector<TypedObject>& objects) {
  Facts facts = basic;
  std::set<std::string> all;
  for (const Predicate& predicate : domain.predicates) {
    if (predicate.kind == PredicateKind::derived) all.insert(predicate.name);
  }
  symbolic::add_derived(facts, domain, objects, all);
  return facts;
}

}  // namespace stampede
