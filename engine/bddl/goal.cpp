#include "engine/bddl/goal.h"

#include <algorithm>
#include <charconv>

#include "engine/symbolic/pddl_formula.h"

namespace stampede::symbolic {
namespace {

using Kind = BddlFormula::Kind;

std::string without_mark(const std::string& word) { return word.starts_with('?') ? word.substr(1) : word; }

int read_count(const Node& node) {
  int count = -1;
  if (node.is_list && node.items.size() == 1 && !node.items[0].is_list) {
    const std::string& digits = node.items[0].word;
    const auto end = digits.data() + digits.size();
    const auto [at, error] = std::from_chars(digits.data(), end, count);
    if (error != std::errc() || at != end) count = -1;
  }
  if (count < 0) fail(node, "expected a number in parentheses", "write (forn (2) (?cup.n.01 - cup.n.01) …)");
  return count;
}

Parameter read_variable(const Node& node) {
  const bool good = node.is_list && node.items.size() == 3 && !node.items[0].is_list && node.items[1].word == "-" &&
                    !node.items[2].is_list && node.items[0].word.starts_with('?');
  if (!good) fail(node, "expected one variable and its category", "write (?cup.n.01 - cup.n.01)");
  return {without_mark(node.items[0].word), node.items[2].word, {}};
}

struct Form {
  const char* word;
  Kind kind;
  bool counted;
  std::size_t variables, parts;  // parts 0: one or more
};
constexpr Form kForms[] = {
    {"not", Kind::negation, false, 0, 1},       {"and", Kind::conjunction, false, 0, 0},
    {"or", Kind::disjunction, false, 0, 0},     {"imply", Kind::implication, false, 0, 2},
    {"forall", Kind::forall, false, 1, 1},      {"exists", Kind::exists, false, 1, 1},
    {"forn", Kind::forn, true, 1, 1},           {"forpairs", Kind::forpairs, false, 2, 1},
    {"fornpairs", Kind::fornpairs, true, 2, 1},
};

class GoalReader {
 public:
  GoalReader(const BddlScope& scope, BddlDialect dialect) : scope_(scope), dialect_(dialect) {}

  BddlFormula read(const Node& node, const std::vector<Parameter>& bound) const {
    if (!node.is_list) fail(node, "expected a formula in parentheses, got `" + node.word + "`");
    if (node.items.empty()) fail(node, "`()` says nothing", "write an atom such as (on a b)");
    const auto form =
        std::find_if(std::begin(kForms), std::end(kForms), [&](const Form& one) { return node.head() == one.word; });
    BddlFormula formula = form == std::end(kForms) ? read_atom(node, bound) : read_form(node, *form, bound);
    if (const auto bad = scope_.node(formula, bound)) fail(node, bad->what, bad->hint);
    return formula;
  }

 private:
  static BddlFormula read_atom(const Node& node, const std::vector<Parameter>& bound) {
    const Fact fact = read_bddl_fact(node);
    BddlFormula formula;
    formula.predicate = fact.predicate;
    for (const std::string& name : fact.arguments) {
      const bool variable = std::any_of(bound.begin(), bound.end(), [&](const Parameter& v) { return v.name == name; });
      formula.terms.push_back({variable, name});
    }
    return formula;
  }

  BddlFormula read_form(const Node& node, const Form& form, const std::vector<Parameter>& bound) const {
    if (dialect_ == BddlDialect::libero) {
      fail(node, "LIBERO reads `" + node.head() + "` in a goal but cannot evaluate it",
           "its goals are one `and` of atoms");
    }
    const std::size_t first = 1 + (form.counted ? 1 : 0) + form.variables;
    const std::size_t parts = node.items.size() < first ? 0 : node.items.size() - first;
    if (form.parts == 0 ? parts == 0 : parts != form.parts) {
      fail(node,
           "`" + node.head() + "` needs " + (form.parts == 0 ? "at least 1" : std::to_string(form.parts)) +
               (form.parts == 2 ? " formulas" : " formula") + " here, got " + std::to_string(parts),
           parts == 0 ? "an empty one is decided before anything happens" : "join them by (and …)");
    }
    BddlFormula formula;
    formula.kind = form.kind;
    if (form.counted) formula.count = read_count(node.items[1]);
    std::vector<Parameter> inner = bound;
    for (std::size_t i = first - form.variables; i < first; ++i) {
      formula.variables.push_back(read_variable(node.items[i]));
      inner.push_back(formula.variables.back());
    }
    for (std::size_t i = first; i < node.items.size(); ++i) formula.parts.push_back(read(node.items[i], inner));
    return formula;
  }

  const BddlScope& scope_;
  BddlDialect dialect_;
};

}  // namespace

Fact read_bddl_fact(const Node& node) {
  if (!node.is_list || node.items.empty() || node.items[0].is_list) {
    fail(node, "expected an atom such as (on a b)", "a predicate and its objects, in parentheses");
  }
  Fact fact{node.items[0].word, {}};
  for (std::size_t i = 1; i < node.items.size(); ++i) {
    if (node.items[i].is_list) fail(node.items[i], "an argument of `" + fact.predicate + "` must be a name");
    fact.arguments.push_back(without_mark(node.items[i].word));
  }
  return fact;
}

std::vector<BddlFormula> read_bddl_goal(const Node& section, const BddlScope& scope, BddlDialect dialect) {
  const char* solved_at_once = "an empty goal is solved before anything happens: name what must become true";
  if (section.items.size() < 2) fail(section, "the goal is empty", solved_at_once);
  const Node& outer = section.items[1];
  if (section.items.size() > 2) {
    fail(section.items[2], "a second formula in :goal, which their parser drops", "join them by (and …)");
  }
  const GoalReader reader(scope, dialect);
  if (outer.head() != "and") return {reader.read(outer, {})};
  if (outer.items.size() == 1) fail(outer, "the goal is empty", solved_at_once);
  std::vector<BddlFormula> parts;
  for (std::size_t i = 1; i < outer.items.size(); ++i) parts.push_back(reader.read(outer.items[i], {}));
  return parts;
}

}  // namespace stampede::symbolic
