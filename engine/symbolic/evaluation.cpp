#include "engine/symbolic/evaluation.h"

#include "engine/base/error.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/solutions.h"

namespace stampede::symbolic {

const std::string& value_of(const Term& term, const Binding& binding) {
  if (!term.variable) return term.name;
  const auto found = binding.find(term.name);
  if (found == binding.end()) {
    throw Error("?" + term.name, "nothing binds this variable",
                "declare it as a parameter, or with exists or forall around its use");
  }
  return found->second;
}

Fact ground_atom(const std::string& predicate, const std::vector<Term>& terms, const Binding& binding) {
  Fact fact{predicate, {}};
  fact.arguments.reserve(terms.size());
  for (const Term& term : terms) fact.arguments.push_back(value_of(term, binding));
  return fact;
}

bool admits(const Parameter& parameter, const TypedObject& object, const View& view) {
  if (!view.domain.is_a(object.type, parameter.type)) return false;
  return std::all_of(parameter.traits.begin(), parameter.traits.end(), [&](const std::string& trait) {
    return view.facts.contains(Fact{trait, {object.name}});
  });
}

std::string argument_fault(const Parameter& parameter, const std::string& name, const View& view) {
  const auto object =
      std::find_if(view.objects.begin(), view.objects.end(), [&](const TypedObject& one) { return one.name == name; });
  if (object == view.objects.end()) return "there is no object `" + name + "`";
  if (!parameter.type.empty() && !view.domain.is_a(object->type, parameter.type))
    return name + " is a " + object->type + ", but ?" + parameter.name + " must be a " + parameter.type;
  for (const std::string& trait : parameter.traits)
    if (!view.facts.contains(Fact{trait, {name}}))
      return name + " is not " + trait + ", which ?" + parameter.name + " must be";
  return {};
}

bool evaluate(const Formula& formula, const View& view, Binding& binding) {
  using Kind = Formula::Kind;
  const auto part_holds = [&](const Formula& part) { return evaluate(part, view, binding); };
  switch (formula.kind) {
    case Kind::always:
      return true;
    case Kind::never:
      return false;
    case Kind::atom:
      return view.facts.contains(ground_atom(formula.predicate, formula.terms, binding));
    case Kind::equal:
      return value_of(formula.terms.at(0), binding) == value_of(formula.terms.at(1), binding);
    case Kind::negation:
      return !evaluate(formula.parts.at(0), view, binding);
    case Kind::conjunction:
      return std::all_of(formula.parts.begin(), formula.parts.end(), part_holds);
    case Kind::disjunction:
      return std::any_of(formula.parts.begin(), formula.parts.end(), part_holds);
    case Kind::exists:
      return !for_each_solution(formula.variables, negation_normal(formula.parts.at(0)), view, binding,
                                [] { return false; });
    case Kind::forall:
      return for_each_solution(formula.variables, negation_normal(formula.parts.at(0), true), view, binding,
                               [] { return false; });
  }
  return false;
}

Formula negation_normal(const Formula& formula, bool negated) {
  using Kind = Formula::Kind;
  if (formula.kind == Kind::negation) return negation_normal(formula.parts.at(0), !negated);
  if (formula.kind == Kind::atom || formula.kind == Kind::equal) return negated ? negation(formula) : formula;
  Formula result = formula;
  if (negated) {
    switch (formula.kind) {
      case Kind::always:
        result.kind = Kind::never;
        break;
      case Kind::never:
        result.kind = Kind::always;
        break;
      case Kind::conjunction:
        result.kind = Kind::disjunction;
        break;
      case Kind::disjunction:
        result.kind = Kind::conjunction;
        break;
      case Kind::exists:
        result.kind = Kind::forall;
        break;
      case Kind::forall:
        result.kind = Kind::exists;
        break;
      default:
        break;
    }
  }
  for (Formula& part : result.parts) part = negation_normal(part, negated);
  return result;
}

std::vector<TypedObject> all_objects(const Domain& domain, const std::vector<TypedObject>& objects) {
  std::vector<TypedObject> all = objects;
  for (const TypedObject& constant : domain.constants) {
    const bool known =
        std::any_of(objects.begin(), objects.end(), [&](const TypedObject& one) { return one.name == constant.name; });
    if (!known) all.push_back(constant);
  }
  std::sort(all.begin(), all.end());
  return all;
}

}  // namespace stampede::symbolic

namespace stampede {
namespace {

using symbolic::View;

constexpr std::size_t kMostWays = 4;  // named to a person

// Ways to make a disjunction true, by what each lacks: those that lack least, then how many others there are.
std::string nearest_ways(std::vector<std::vector<std::string>> ways) {
  std::stable_sort(ways.begin(), ways.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  std::string text = "one of:";
  for (std::size_t way = 0; way < std::min(ways.size(), kMostWays); ++way) {
    text += way == 0 ? " " : " or ";
    for (std::size_t i = 0; i < ways[way].size(); ++i) text += (i > 0 ? " and " : "") + ways[way][i];
  }
  return ways.size() <= kMostWays ? text : text + " or " + std::to_string(ways.size() - kMostWays) + " other ways";
}

// `formula` is false, in negation normal form.
void collect_unmet(const Formula& formula, const View& view, Binding& binding, std::vector<std::string>& texts) {
  using Kind = Formula::Kind;
  if (symbolic::evaluate(formula, view, binding)) return;
  switch (formula.kind) {
    case Kind::conjunction:
      for (const Formula& part : formula.parts) collect_unmet(part, view, binding, texts);
      return;
    case Kind::forall:
      symbolic::for_each_binding(formula.variables, view, binding, [&] {
        collect_unmet(formula.parts.at(0), view, binding, texts);
        return true;
      });
      return;
    case Kind::disjunction: {
      std::vector<std::vector<std::string>> ways;
      for (const Formula& part : formula.parts) collect_unmet(part, view, binding, ways.emplace_back());
      texts.push_back(nearest_ways(std::move(ways)));
      return;
    }
    default:
      break;
  }
  Formula bound = formula;
  const auto bind = [&](const auto& self, Formula& part) -> void {
    for (Term& term : part.terms) {
      const auto found = term.variable ? binding.find(term.name) : binding.end();
      if (found != binding.end()) term = {false, found->second};
    }
    for (Formula& inner : part.parts) self(self, inner);
  };
  bind(bind, bound);
  texts.push_back(symbolic::formula_text(bound, symbolic::Names::plain));
}

}  // namespace

std::vector<std::string> unmet(const Formula& formula, const Facts& facts, const Domain& domain,
                               const std::vector<TypedObject>& objects, const Binding& binding) {
  std::vector<std::string> texts;
  Binding local = binding;
  collect_unmet(symbolic::negation_normal(formula), {facts, domain, objects}, local, texts);
  std::set<std::string> seen;
  std::erase_if(texts, [&](const std::string& text) { return !seen.insert(text).second; });
  return texts;
}

}  // namespace stampede
