#include "engine/symbolic/pddl_text.h"

#include <algorithm>
#include <cctype>

namespace stampede::symbolic {

std::string name_text(std::string_view name, Names names) {
  if (names == Names::plain) return std::string(name);
  std::string text;
  for (const char c : name) {
    if (c == '.') {
      text += "--";
    } else {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
  }
  return text;
}

std::string name_from_pddl(std::string_view name) {
  std::string text;
  for (std::size_t i = 0; i < name.size(); ++i) {
    if (name.substr(i, 2) == "--") {
      text += '.';
      ++i;
    } else {
      text += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
    }
  }
  return text;
}

std::string variables_text(const std::vector<Parameter>& variables, Names names) {
  std::string text;
  const bool typed = names == Names::pddl || std::any_of(variables.begin(), variables.end(),
                                                         [](const Parameter& v) { return !v.type.empty(); });
  for (const Parameter& variable : variables) {
    if (!text.empty()) text += ' ';
    text += "?" + name_text(variable.name, names);
    if (typed) text += " - " + (variable.type.empty() ? "object" : name_text(variable.type, names));
  }
  return text;
}

std::string atom_text(const std::string& predicate, const std::vector<Term>& terms, Names names) {
  std::string text = "(" + name_text(predicate, names);
  for (const Term& term : terms) text += (term.variable ? " ?" : " ") + name_text(term.name, names);
  return text + ")";
}

// Inside another formula VAL takes no `(and)` or `(or)` without parts and Fast Downward no `()`; these both take.
const char* const kAlways = "(forall (?any - object) (= ?any ?any))";
const char* const kNever = "(exists (?any - object) (not (= ?any ?any)))";

bool is_constant(const Formula& formula, Formula::Kind quantifier) {
  using Kind = Formula::Kind;
  if (formula.kind != quantifier || formula.variables != std::vector<Parameter>{{"any", "", {}}}) return false;
  const Formula* body = &formula.parts.at(0);
  if (quantifier == Kind::exists) {
    if (body->kind != Kind::negation) return false;
    body = &body->parts.at(0);
  }
  return body->kind == Kind::equal && body->terms == std::vector<Term>{{true, "any"}, {true, "any"}};
}

std::string formula_text(const Formula& formula, Names names) {
  using Kind = Formula::Kind;
  const auto list = [&](const char* word) {
    std::string text = std::string("(") + word;
    for (const Formula& part : formula.parts) text += " " + formula_text(part, names);
    return text + ")";
  };
  const auto quantified = [&](const char* word, const char* guard_word) {
    std::string body = formula_text(formula.parts.at(0), names);
    const std::vector<Formula> guards = trait_guards(formula.variables);
    if (!guards.empty()) {
      std::string guard;
      for (const Formula& one : guards) guard += (guard.empty() ? "" : " ") + formula_text(one, names);
      const bool implication = std::string_view(guard_word) == "imply";
      body = implication ? "(imply (and " + guard + ") " + body + ")" : "(and " + guard + " " + body + ")";
    }
    return std::string("(") + word + " (" + variables_text(formula.variables, names) + ") " + body + ")";
  };
  switch (formula.kind) {
    case Kind::always:
      return names == Names::pddl ? kAlways : "(and)";
    case Kind::never:
      return names == Names::pddl ? kNever : "(or)";
    case Kind::atom:
      return atom_text(formula.predicate, formula.terms, names);
    case Kind::equal:
      return atom_text("=", formula.terms, names);
    case Kind::negation:
      return list("not");
    case Kind::conjunction:
      return list("and");
    case Kind::disjunction:
      return list("or");
    case Kind::exists:
      return quantified("exists", "and");
    case Kind::forall:
      return quantified("forall", "imply");
  }
  return {};
}

std::vector<Formula> trait_guards(const std::vector<Parameter>& parameters) {
  std::vector<Formula> guards;
  for (const Parameter& parameter : parameters) {
    for (const std::string& trait : parameter.traits) guards.push_back(atom(trait, {{true, parameter.name}}));
  }
  return guards;
}

bool could_be_equal(const Parameter& a, const Parameter& b, const Domain& domain) {
  return a.type.empty() || b.type.empty() || a.type == "object" || b.type == "object" || domain.is_a(a.type, b.type) ||
         domain.is_a(b.type, a.type);
}

std::vector<Formula> inequalities(const Action& action, const Domain& domain) {
  std::vector<Formula> result;
  if (!action.distinct) return result;
  const auto exempt = [&](const std::string& a, const std::string& b) {
    return std::any_of(action.may_equal.begin(), action.may_equal.end(), [&](const auto& pair) {
      return (pair.first == a && pair.second == b) || (pair.first == b && pair.second == a);
    });
  };
  for (std::size_t i = 0; i < action.parameters.size(); ++i) {
    for (std::size_t j = i + 1; j < action.parameters.size(); ++j) {
      const Parameter &a = action.parameters[i], &b = action.parameters[j];
      if (!could_be_equal(a, b, domain) || exempt(a.name, b.name)) continue;
      Formula equal;
      equal.kind = Formula::Kind::equal;
      equal.terms = {{true, a.name}, {true, b.name}};
      result.push_back(negation(std::move(equal)));
    }
  }
  return result;
}

}  // namespace stampede::symbolic
