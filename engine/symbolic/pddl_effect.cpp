#include <algorithm>

#include "engine/symbolic/pddl_formula.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

using Kind = Formula::Kind;

// (forall (?x - type …) …) in an effect. A variable that hides one around it gets a new name, because conditions of
// `when`s outside end up inside.
std::vector<Parameter> read_effect_variables(const Node& node, const std::vector<Parameter>& scope,
                                             const Vocabulary& vocabulary, Node& renamed) {
  if (node.items.size() != 3 || !node.items[1].is_list) fail(node, "expected (forall (?x - type …) effect)");
  renamed = node;
  const auto is_hidden = [&](const std::string& name) {
    return std::any_of(scope.begin(), scope.end(), [&](const Parameter& one) { return one.name == name; });
  };
  const auto put = [](const auto& self, Node& at, const std::string& old_word, const std::string& new_word) -> void {
    if (at.word == old_word) at.word = new_word;
    for (Node& item : at.items) self(self, item, old_word, new_word);
  };
  for (const Parameter& one : read_typed(node.items[1], 0, true, vocabulary.domain)) {
    if (!is_hidden(one.name)) continue;
    int number = 2;
    while (is_hidden(one.name + "_" + std::to_string(number))) ++number;
    put(put, renamed, "?" + name_text(one.name, Names::pddl),
        "?" + name_text(one.name, Names::pddl) + "_" + std::to_string(number));
  }
  return read_typed(renamed.items[1], 0, true, vocabulary.domain);
}

void read_cost(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary, Action& action) {
  const bool is_total = node.items.size() == 3 && node.items[1].is_list && node.items[1].items.size() == 1 &&
                        node.items[1].head() == "total-cost";
  if (!is_total) {
    fail(node, "only (increase (total-cost) N) changes a number", "count with objects and predicates");
  }
  const Node& amount = node.items[2];
  if (!amount.is_list) {
    if (amount.word.find_first_not_of("0123456789") != std::string::npos || amount.word.size() > 9) {
      fail(amount, "a cost is a whole number, got `" + amount.word + "`",
           "scale the costs: neither Fast Downward nor this planner takes fractions or negative ones");
    }
    action.cost = std::stoi(amount.word);
    return;
  }
  const std::string name = name_from_pddl(amount.head());
  const Predicate* function = nullptr;
  std::vector<std::string> known;
  for (const Predicate& one : vocabulary.domain->functions) {
    known.push_back(one.name);
    if (one.name == name) function = &one;
  }
  if (function == nullptr) {
    fail(amount, "unknown function `" + amount.head() + "`",
         known.empty() ? "a cost is a whole number or a declared function of objects" : did_you_mean(name, known));
  }
  if (amount.items.size() != function->parameters.size() + 1) {
    fail(amount, "`" + name + "` takes " + std::to_string(function->parameters.size()) + " arguments, got " +
                     std::to_string(amount.items.size() - 1));
  }
  action.cost = 1;
  action.cost_function = name;
  for (std::size_t i = 1; i < amount.items.size(); ++i) {
    action.cost_terms.push_back(read_term(amount.items[i], scope, vocabulary));
    check_type(amount.items[i], action.cost_terms.back(), {function->parameters[i - 1], name}, scope, vocabulary);
  }
}

struct EffectReader {
  const Vocabulary& vocabulary;
  Action& action;
  bool has_cost = false;

  void read(const Node& node, const std::vector<Parameter>& scope, Effect outer) {
    const std::string& head = node.head();
    if (!node.is_list) fail(node, "expected an effect in parentheses, got `" + node.word + "`");
    if (node.items.empty()) return;
    if (head == "and") {
      for (std::size_t i = 1; i < node.items.size(); ++i) read(node.items[i], scope, outer);
    } else if (head == "forall") {
      Node renamed;
      const std::vector<Parameter> variables = read_effect_variables(node, scope, vocabulary, renamed);
      std::vector<Parameter> inner = scope;
      inner.insert(inner.begin(), variables.begin(), variables.end());
      outer.forall.insert(outer.forall.end(), variables.begin(), variables.end());
      read(renamed.items[2], inner, std::move(outer));
    } else if (head == "when") {
      read_when(node, scope, std::move(outer));
    } else if (head == "increase") {
      if (outer.when.kind != Kind::always || !outer.forall.empty()) {
        fail(node, "a cost cannot be conditional or quantified", "split the action");
      }
      if (has_cost) fail(node, "a second (increase (total-cost) …) in one action", "add the two up");
      has_cost = true;
      read_cost(node, scope, vocabulary, action);
    } else {
      read_literal(node, scope, std::move(outer));
    }
  }

  void read_when(const Node& node, const std::vector<Parameter>& scope, Effect outer) {
    if (node.items.size() != 3) fail(node, "expected (when condition effect)");
    Formula when = read_formula(node.items[1], scope, vocabulary);
    take_traits(when, outer.forall, vocabulary.domain);
    if (outer.when.kind == Kind::always) {
      outer.when = std::move(when);
    } else if (when.kind != Kind::always) {  // one level: a condition inside a condition is both
      outer.when = conjunction({std::move(outer.when), std::move(when)});
    }
    read(node.items[2], scope, std::move(outer));
  }

  void read_literal(const Node& node, const std::vector<Parameter>& scope, Effect outer) {
    const std::string& head = node.head();
    for (const char* other : {"or", "exists", "imply", "="}) {
      if (head != other) continue;
      fail(node, "`" + head + "` cannot be an effect", "effects are literals, `and`, `when` and `forall`");
    }
    for (const char* numeric : {"decrease", "assign", "scale-up", "scale-down"}) {
      if (head != numeric) continue;
      fail(node, "numeric effects are not supported, except (increase (total-cost) N)",
           "count with objects and predicates");
    }
    outer.negated = head == "not";
    if (outer.negated && node.items.size() != 2) fail(node, "`not` takes 1 part");
    const Node& literal = outer.negated ? node.items[1] : node;
    if (literal.head().empty()) fail(literal, "expected a predicate and its arguments");
    Formula read = read_atom(literal, scope, vocabulary);
    const Predicate* predicate = vocabulary.domain == nullptr ? nullptr : vocabulary.domain->predicate(read.predicate);
    if (predicate != nullptr && predicate->kind == PredicateKind::derived) {
      fail(literal, "`" + read.predicate + "` is derived and cannot be an effect",
           "state the basic facts that it is derived from");
    }
    outer.predicate = std::move(read.predicate);
    outer.terms = std::move(read.terms);
    action.effects.push_back(std::move(outer));
  }
};

}  // namespace

void read_effects(const Node& node, const std::vector<Parameter>& scope, const Vocabulary& vocabulary, Action& action) {
  EffectReader{vocabulary, action}.read(node, scope, {});
}

}  // namespace stampede::symbolic
