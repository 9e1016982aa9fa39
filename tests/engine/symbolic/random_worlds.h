// Small random domains with everything at once: quantifiers, conditional effects, derived predicates in three strata,
// one of them recursive.
#pragma once

#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/symbolic/task_planner.h"

namespace stampede::test {

class RandomWorld {
 public:
  explicit RandomWorld(Random& random) : random_(random) { make(); }
  Domain domain;
  Problem problem;

  // Over the variables given and what it quantifies itself; derived predicates of up to `levels` strata.
  Formula formula(const std::vector<std::string>& variables, int depth, int levels) {
    const std::int64_t kind = random_.below(depth > 0 ? 8 : 3);
    if (kind == 0) return equality(variables);
    if (kind <= 2) return literal(variables, levels);
    if (kind == 3) return negation(formula(variables, depth - 1, levels));
    if (kind <= 5) {
      std::vector<Formula> parts = {formula(variables, depth - 1, levels), formula(variables, depth - 1, levels)};
      return kind == 4 ? conjunction(parts) : disjunction(parts);
    }
    Formula quantified;
    quantified.kind = kind == 6 ? Formula::Kind::exists : Formula::Kind::forall;
    const std::string name = "v" + std::to_string(random_.below(3));  // sometimes hides one outside
    quantified.variables = {{name, random_.below(2) == 0 ? "block" : "", {}}};
    std::vector<std::string> inner = variables;
    inner.push_back(name);
    quantified.parts = {formula(inner, depth - 1, levels)};
    return quantified;
  }

 private:
  Term term(const std::vector<std::string>& variables) {
    if (variables.empty() || random_.below(5) == 0) return {false, "o" + std::to_string(random_.below(kObjects))};
    return {true, variables[static_cast<std::size_t>(random_.below(static_cast<std::int64_t>(variables.size())))]};
  }

  Formula equality(const std::vector<std::string>& variables) {
    Formula equal;
    equal.kind = Formula::Kind::equal;
    equal.terms = {term(variables), term(variables)};
    return random_.below(2) == 0 ? equal : negation(equal);
  }

  Formula literal(const std::vector<std::string>& variables, int levels) {
    static const char* const kNames[] = {"p", "q", "s", "reach", "first", "second"};
    const std::string name = kNames[random_.below(3 + levels)];
    std::vector<Term> terms = {term(variables)};
    if (name == "q" || name == "reach" || name == "s") terms.push_back(term(variables));
    Formula one = atom(name, std::move(terms));
    return random_.below(3) == 0 ? negation(one) : one;
  }

  void make() {
    domain.name = "random";
    domain.types = {{"block", "object"}};
    const Parameter x{"x", "", {}}, y{"y", "", {}};
    const Formula edge = atom("q", {{true, "x"}, {true, "y"}});
    Formula further;
    further.kind = Formula::Kind::exists;
    further.variables = {{"z", "", {}}};
    further.parts = {conjunction({atom("q", {{true, "x"}, {true, "z"}}), atom("reach", {{true, "z"}, {true, "y"}})})};
    domain.predicates = {{"first", {x}, PredicateKind::derived, formula({"x"}, 3, 1), ""},
                         {"p", {x}, PredicateKind::basic, {}, ""},
                         {"q", {x, y}, PredicateKind::basic, {}, ""},
                         {"reach", {x, y}, PredicateKind::derived, disjunction({edge, further}), ""},
                         {"s", {x, y}, PredicateKind::basic, {}, ""},  // no action changes it
                         {"second", {x}, PredicateKind::derived, formula({"x"}, 3, 2), ""}};
    for (const char* name : {"alter", "build", "carry"}) domain.actions.push_back(action(name));
    problem.name = "p";
    for (int i = 0; i < kObjects; ++i) problem.objects.push_back({"o" + std::to_string(i), i % 2 ? "block" : "object"});
    for (const TypedObject& a : problem.objects) {
      if (random_.below(2) == 0) problem.init.insert({"p", {a.name}});
      for (const TypedObject& b : problem.objects) {
        if (random_.below(4) == 0) problem.init.insert({"q", {a.name, b.name}});
        if (random_.below(3) == 0) problem.init.insert({"s", {a.name, b.name}});
      }
    }
    problem.goal = conjunction({formula({}, 3, 3), formula({}, 2, 3)});
  }

  Action action(const std::string& name) {
    Action one;
    one.name = name;
    one.parameters = {{"a", "", {}}, {"b", random_.below(2) == 0 ? "block" : "", {}}};
    one.distinct = random_.below(2) == 0;
    one.precondition = formula({"a", "b"}, 3, 3);
    one.effects = {
        {{}, {}, "q", {{true, "a"}, {true, "b"}}, random_.below(2) == 0},
        {{}, formula({"a", "b"}, 2, 3), "p", {{true, "a"}}, random_.below(2) == 0},
        {{{"z", "block", {}}}, formula({"a", "z"}, 2, 3), "q", {{true, "z"}, {true, "a"}}, random_.below(2) == 0}};
    return one;
  }

  static constexpr int kObjects = 4;
  Random& random_;
};

}  // namespace stampede::test
