#include "engine/symbolic/pddl_formula.h"

#include <algorithm>

#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

using Kind = Formula::Kind;

bool is_trait(const std::string& name, const Domain* domain) {
  return domain != nullptr && std::find(domain->traits.begin(), domain->traits.end(), name) != domain->traits.end();
}

Term read_term(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary) {
  if (node.is_list) fail(node, "expected a variable or an object, not a list");
  std::vector<std::string> known;
  if (node.word.starts_with("?")) {
    const std::string name = name_from_pddl(node.word.substr(1));
    for (const Parameter& one : scope) {
      if (one.name == name) return {true, name};
      known.push_back("?" + one.name);
    }
    if (vocabulary.domain == nullptr) return {true, name};
    fail(node, "unknown variable `" + node.word + "`", did_you_mean(node.word, known));
  }
  const std::string name = name_from_pddl(node.word);
  if (vocabulary.objects == nullptr) return {false, name};
  for (const TypedObject& one : *vocabulary.objects) {
    if (one.name == name) return {false, name};
    known.push_back(one.name);
  }
  fail(node, "unknown object `" + node.word + "`", did_you_mean(name, known));
}

Formula read_atom(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary) {
  const std::string name = name_from_pddl(node.head());
  std::vector<Term> terms;
  for (std::size_t i = 1; i < node.items.size(); ++i) terms.push_back(read_term(node.items[i], scope, vocabulary));
  if (vocabulary.domain == nullptr) return atom(name, std::move(terms));
  const Predicate* predicate = vocabulary.domain->predicate(name);
  if (predicate == nullptr && !is_trait(name, vocabulary.domain)) {
    std::vector<std::string> known = vocabulary.domain->traits;
    for (const Predicate& one : vocabulary.domain->predicates) known.push_back(one.name);
    fail(node.items.front(), "unknown predicate `" + node.head() + "`", did_you_mean(name, known));
  }
  const std::size_t arity = predicate == nullptr ? 1 : predicate->parameters.size();
  if (terms.size() != arity) {
    fail(node, "`" + name + "` takes " + std::to_string(arity) + " arguments, got " + std::to_string(terms.size()));
  }
  return atom(name, std::move(terms));
}

Formula read_quantified(const Node& node, std::vector<Parameter> scope, const Vocabulary& vocabulary) {
  if (node.items.size() != 3 || !node.items[1].is_list) {
    fail(node, "expected (" + node.head() + " (?x - type …) formula)");
  }
  Formula result;
  result.kind = node.head() == "exists" ? Kind::exists : Kind::forall;
  result.variables = read_typed(node.items[1], 0, true, vocabulary.domain);
  scope.insert(scope.begin(), result.variables.begin(), result.variables.end());
  const Node& body = node.items[2];
  if (result.kind == Kind::forall && body.head() == "imply" && body.items.size() == 3) {
    Formula guard = read_formula(body.items[1], scope, vocabulary);
    std::vector<Parameter> variables = result.variables;
    take_traits(guard, variables, vocabulary.domain);
    if (guard.kind == Kind::always) {
      result.variables = std::move(variables);
      result.parts.push_back(read_formula(body.items[2], scope, vocabulary));
      return result;
    }
  }
  result.parts.push_back(read_formula(body, scope, vocabulary));
  if (result.kind == Kind::exists) take_traits(result.parts.front(), result.variables, vocabulary.domain);
  return result;
}

}  // namespace

void fail(const Node& node, const std::string& what, const std::string& hint) { throw Error(node.place, what, hint); }

void take_traits(Formula& formula, std::vector<Parameter>& variables, const Domain* domain) {
  std::vector<Formula> parts = {formula};
  if (formula.kind == Kind::conjunction) parts = formula.parts;
  std::size_t taken = 0;
  for (; taken < parts.size(); ++taken) {
    const Formula& one = parts[taken];
    if (one.kind != Kind::atom || !is_trait(one.predicate, domain) || !one.terms[0].variable) break;
    const auto variable = std::find_if(variables.begin(), variables.end(),
                                       [&](const Parameter& v) { return v.name == one.terms[0].name; });
    if (variable == variables.end()) break;
    variable->traits.push_back(one.predicate);
  }
  if (taken == 0) return;
  formula = conjunction({parts.begin() + static_cast<std::ptrdiff_t>(taken), parts.end()});
}

std::vector<Parameter> read_typed(const Node& list, std::size_t from, bool variables, const Domain* domain) {
  std::vector<Parameter> result;
  std::size_t untyped = 0;
  for (std::size_t i = from; i < list.items.size(); ++i) {
    const Node& item = list.items[i];
    if (item.is_list) fail(item, "expected a name, not a list");
    if (item.word != "-") {
      if (variables != item.word.starts_with("?")) {
        fail(item, variables ? "expected a variable such as `?x`, got `" + item.word + "`"
                             : "expected a name without `?`, got `" + item.word + "`");
      }
      result.push_back({name_from_pddl(variables ? item.word.substr(1) : item.word), "", {}});
      continue;
    }
    if (++i >= list.items.size()) fail(item, "`-` without a type after it", "write `- object` where any type will do");
    const Node& type = list.items[i];
    if (type.is_list) {
      fail(type, "`either` types are not supported", "give the types a common parent, or use a static predicate");
    }
    const std::string name = name_from_pddl(type.word);
    if (domain != nullptr && name != "object" && !domain->types.contains(name)) {
      std::vector<std::string> known = {"object"};
      for (const auto& [one, parent] : domain->types) known.push_back(one);
      fail(type, "unknown type `" + type.word + "`", did_you_mean(name, known));
    }
    for (; untyped < result.size(); ++untyped) result[untyped].type = name == "object" ? "" : name;
  }
  return result;
}

Formula read_formula(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary) {
  if (!node.is_list) fail(node, "expected a formula in parentheses, got `" + node.word + "`");
  if (node.items.empty()) return {};
  const std::string& head = node.head();
  const auto parts = [&] {
    std::vector<Formula> all;
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      all.push_back(read_formula(node.items[i], scope, vocabulary));
    }
    return all;
  };
  const auto expect = [&](std::size_t count) {
    if (node.items.size() != count + 1) {
      fail(node,
           "`" + head + "` takes " + std::to_string(count) + " parts, got " + std::to_string(node.items.size() - 1));
    }
  };
  if (head == "and") return conjunction(parts());
  if (head == "or") return disjunction(parts());
  if (head == "not") return expect(1), negation(parts().front());
  if (head == "imply") {
    expect(2);
    std::vector<Formula> both = parts();
    both[0] = negation(both[0]);
    return disjunction(std::move(both));
  }
  if (head == "exists" || head == "forall") return read_quantified(node, scope, vocabulary);
  if (head == "=") {
    expect(2);
    Formula result;
    result.kind = Kind::equal;
    result.terms = {read_term(node.items[1], scope, vocabulary), read_term(node.items[2], scope, vocabulary)};
    return result;
  }
  if (head.empty()) fail(node, "a formula begins with a word", "such as `and`, `not` or a predicate");
  for (const char* numeric : {"<", ">", "<=", ">="}) {
    if (head == numeric) fail(node, "numeric conditions are not supported", "count with objects and predicates");
  }
  return read_atom(node, scope, vocabulary);
}

void read_effects(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary, Effect outer,
                  std::vector<Effect>& effects, int& cost) {
  const std::string& head = node.head();
  if (!node.is_list) fail(node, "expected an effect in parentheses, got `" + node.word + "`");
  if (node.items.empty()) return;
  if (head == "and") {
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      read_effects(node.items[i], scope, vocabulary, outer, effects, cost);
    }
  } else if (head == "forall") {
    if (node.items.size() != 3) fail(node, "expected (forall (?x - type …) effect)");
    std::vector<Parameter> variables = read_typed(node.items[1], 0, true, vocabulary.domain);
    std::vector<Parameter> inner = scope;
    inner.insert(inner.begin(), variables.begin(), variables.end());
    outer.forall.insert(outer.forall.end(), variables.begin(), variables.end());
    read_effects(node.items[2], inner, vocabulary, outer, effects, cost);
  } else if (head == "when") {
    if (node.items.size() != 3) fail(node, "expected (when condition effect)");
    Formula when = read_formula(node.items[1], scope, vocabulary);
    take_traits(when, outer.forall, vocabulary.domain);
    outer.when = outer.when.kind == Kind::always ? when : conjunction({outer.when, when});
    read_effects(node.items[2], scope, vocabulary, outer, effects, cost);
  } else if (head == "increase") {
    if (node.items.size() != 3 || node.items[1].head() != "total-cost" || node.items[2].is_list ||
        node.items[2].word.find_first_not_of("0123456789") != std::string::npos || node.items[2].word.size() > 9) {
      fail(node, "only (increase (total-cost) N) with a whole number N is supported");
    }
    cost = std::stoi(node.items[2].word);
  } else if (head == "or" || head == "exists" || head == "imply") {
    fail(node, "`" + head + "` cannot be an effect", "effects are literals, `and`, `when` and `forall`");
  } else {
    outer.negated = head == "not";
    if (outer.negated && node.items.size() != 2) fail(node, "`not` takes 1 part");
    const Node& literal = outer.negated ? node.items[1] : node;
    if (literal.head().empty()) fail(literal, "expected a predicate and its arguments");
    Formula read = read_atom(literal, scope, vocabulary);
    outer.predicate = std::move(read.predicate);
    outer.terms = std::move(read.terms);
    effects.push_back(std::move(outer));
  }
}

}  // namespace stampede::symbolic
