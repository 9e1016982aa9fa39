#include "engine/symbolic/pddl_formula.h"

#include <algorithm>

#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

using Kind = Formula::Kind;

bool is_trait(const std::string& name, const Domain* domain) {
  return domain != nullptr && std::find(domain->traits.begin(), domain->traits.end(), name) != domain->traits.end();
}

const TypedObject* find_object(const std::string& name, const Vocabulary& vocabulary) {
  if (vocabulary.objects == nullptr) return nullptr;
  const auto found = std::lower_bound(vocabulary.objects->begin(), vocabulary.objects->end(), name,
                                      [](const TypedObject& one, const std::string& text) { return one.name < text; });
  return found != vocabulary.objects->end() && found->name == name ? &*found : nullptr;
}

Formula read_quantified(const Node& node, std::vector<Parameter> scope, const Vocabulary& vocabulary) {
  if (node.items.size() != 3 || !node.items[1].is_list) {
    fail(node, "expected (" + node.head() + " (?x - type …) formula)");
  }
  Formula result;
  result.kind = node.head() == "exists" ? Kind::exists : Kind::forall;
  result.variables = read_typed(node.items[1], 0, true, vocabulary.domain);
  const bool is_exists = result.kind == Kind::exists;
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
  if (is_constant(result, result.kind)) return is_exists ? disjunction({}) : Formula{};
  if (is_exists) take_traits(result.parts.front(), result.variables, vocabulary.domain);
  return result;
}

}  // namespace

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
  if (vocabulary.objects == nullptr || find_object(name, vocabulary) != nullptr) return {false, name};
  for (const TypedObject& one : *vocabulary.objects) known.push_back(one.name);
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
  for (std::size_t i = 0; predicate != nullptr && i < arity; ++i) {
    check_type(node.items[i + 1], terms[i], {predicate->parameters[i], name}, scope, vocabulary);
  }
  return atom(name, std::move(terms));
}

void check_type(const Node& node, const Term& term, const Slot& slot, const std::vector<Parameter>& scope,
                const Vocabulary& vocabulary) {
  const Parameter& parameter = slot.parameter;
  if (parameter.type.empty() || vocabulary.domain == nullptr) return;
  const std::string wanted = ", but ?" + parameter.name + " of `" + slot.of + "` must be a " + parameter.type;
  if (!term.variable) {
    const TypedObject* object = find_object(term.name, vocabulary);
    if (object == nullptr || vocabulary.domain->is_a(object->type, parameter.type)) return;
    fail(node, term.name + " is a " + object->type + wanted);
  }
  for (const Parameter& one : scope) {
    if (one.name != term.name) continue;
    if (could_be_equal(one, parameter, *vocabulary.domain)) return;
    fail(node, "?" + one.name + " is a " + one.type + wanted);
  }
}

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

namespace {

bool is_among(const std::vector<Parameter>& parameters, const std::string& name) {
  return std::any_of(parameters.begin(), parameters.end(), [&](const Parameter& one) { return one.name == name; });
}

std::string read_type(const Node& type, const Domain* domain) {
  if (type.is_list) {
    if (type.head() != "either") fail(type, "expected the name of a type");
    fail(type, "`either` types are not supported", "give the types a common parent, or use a static predicate");
  }
  if (type.word == "-" || type.word.starts_with("?")) {
    fail(type, "expected the name of a type after `-`, got `" + type.word + "`",
         "write `- object` where any type will do");
  }
  const std::string name = name_from_pddl(type.word);
  if (domain != nullptr && name != "object" && !domain->types.contains(name)) {
    std::vector<std::string> known = {"object"};
    for (const auto& [one, parent] : domain->types) known.push_back(one);
    fail(type, "unknown type `" + type.word + "`", did_you_mean(name, known));
  }
  return name == "object" ? "" : name;
}

}  // namespace

std::vector<Parameter> read_typed(const Node& list, std::size_t from, bool variables, const Domain* domain,
                                  Repeats repeats) {
  std::vector<Parameter> result;
  std::size_t untyped = 0;
  for (std::size_t i = from; i < list.items.size(); ++i) {
    const Node& item = list.items[i];
    if (item.is_list) fail(item, "expected a name, not a list");
    if (item.word != "-") {
      if (variables != item.word.starts_with("?") || item.word == "?") {
        fail(item, variables ? "expected a variable such as `?x`, got `" + item.word + "`"
                             : "expected a name without `?`, got `" + item.word + "`");
      }
      const std::string name = name_from_pddl(variables ? item.word.substr(1) : item.word);
      std::string own = name;
      if (variables && is_among(result, name)) {
        if (repeats == Repeats::refused) {
          fail(item, "`" + item.word + "` is declared twice", "PDDL does not tell capital letters from small ones");
        }
        for (int number = 2; is_among(result, own); ++number) own = name + "_" + std::to_string(number);
      }
      result.push_back({own, "", {}});
      continue;
    }
    if (++i >= list.items.size()) fail(item, "`-` without a type after it", "write `- object` where any type will do");
    const std::string type = read_type(list.items[i], domain);
    for (; untyped < result.size(); ++untyped) result[untyped].type = type;
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
  if (head == "not") return expect(1), negation(std::move(parts().front()));
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
  if (head == "when") fail(node, "`when` belongs into effects");
  return read_atom(node, scope, vocabulary);
}

}  // namespace stampede::symbolic
