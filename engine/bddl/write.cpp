#include <algorithm>

#include "engine/base/error.h"
#include "engine/base/text.h"
#include "engine/bddl/words.h"

namespace stampede {
namespace {

using Kind = BddlFormula::Kind;

const char* word_of(Kind kind) {
  switch (kind) {
    case Kind::atom:
      return "";
    case Kind::negation:
      return "not";
    case Kind::conjunction:
      return "and";
    case Kind::disjunction:
      return "or";
    case Kind::implication:
      return "imply";
    case Kind::forall:
      return "forall";
    case Kind::exists:
      return "exists";
    case Kind::forn:
      return "forn";
    case Kind::forpairs:
      return "forpairs";
    case Kind::fornpairs:
      return "fornpairs";
  }
  return "";
}

std::string formula_text(const BddlFormula& formula, const char* mark) {
  std::string text = "(";
  if (formula.kind == Kind::atom) {
    text += formula.predicate;
    for (const Term& term : formula.terms) text += (" " + ((term.variable ? "?" : mark) + term.name));
    return text + ")";
  }
  text += word_of(formula.kind);
  if (formula.kind == Kind::forn || formula.kind == Kind::fornpairs) text += " (" + std::to_string(formula.count) + ")";
  for (const Parameter& variable : formula.variables) text += " (?" + variable.name + " - " + variable.type + ")";
  for (const BddlFormula& part : formula.parts) text += " " + formula_text(part, mark);
  return text + ")";
}

template <typename Numbers>
std::string list_text(const Numbers& numbers) {
  std::string text;
  for (const double number : numbers) text += (text.empty() ? "(" : " ") + number_text(number);
  return text + ")";
}

std::string region_text(const BddlRegion& region) {
  std::string text = "    (" + region.name + "\n      (:target " + region.target + ")\n";
  if (!region.ranges.empty()) {
    text += "      (:ranges (\n";
    for (const BddlRectangle& r : region.ranges) {
      text += "        " + list_text(std::array<double, 4>{r.x_min_m, r.y_min_m, r.x_max_m, r.y_max_m}) + "\n";
    }
    text += "      ))\n";
  }
  if (region.yaw_rad != BddlRegion{}.yaw_rad) text += "      (:yaw_rotation (" + list_text(region.yaw_rad) + "))\n";
  if (region.rgba != BddlRegion{}.rgba) text += "      (:rgba " + list_text(region.rgba) + ")\n";
  return text + "    )\n";
}

std::string groups_text(const char* head, const std::vector<BddlGroup>& groups) {
  std::string text = std::string("  (") + head + "\n";
  for (const BddlGroup& group : groups) {
    text += "   ";
    for (const std::string& name : group.names) text += " " + name;
    text += " - " + group.category + "\n";
  }
  return text + "  )\n";
}

// One literal a line: BEHAVIOR expands wildcards line by line.
std::string init_text(const BddlProblem& problem) {
  std::string text = "  (:init\n";
  for (const BddlLiteral& literal : problem.init) {
    const std::string atom = to_text(literal.atom);
    text += "    " + (literal.negated ? "(not " + atom + ")" : atom) + "\n";
  }
  return text + "  )\n";
}

std::string goal_text(const BddlProblem& problem) {
  const char* mark = problem.dialect == BddlDialect::behavior ? "?" : "";  // as in the files of each
  std::string text = "  (:goal\n    (and\n";
  for (const BddlFormula& part : problem.goal) text += "      " + formula_text(part, mark) + "\n";
  return text + "    )\n  )\n";
}

[[noreturn]] void refuse(const BddlProblem& problem, const symbolic::Complaint& bad) {
  throw Error("BDDL problem " + problem.name, bad.what, bad.hint);
}

void check_formula(const BddlProblem& problem, const symbolic::BddlScope& scope, const BddlFormula& formula,
                   std::vector<Parameter> bound) {
  if (const auto bad = scope.node(formula, bound)) refuse(problem, *bad);
  bound.insert(bound.end(), formula.variables.begin(), formula.variables.end());
  for (const BddlFormula& part : formula.parts) check_formula(problem, scope, part, bound);
}

// What ends a word of theirs, or would be read as another letter.
bool is_special(unsigned char c) { return c == '(' || c == ')' || c == ';' || (c >= 'A' && c <= 'Z'); }

void check_language(const BddlProblem& problem) {
  std::string plain;
  bool blank = true;
  for (const char c : problem.language) {
    if (blank && c == ' ') continue;
    plain += c;
    blank = c == ' ';
  }
  const bool words = std::none_of(plain.begin(), plain.end(), [](unsigned char c) { return c < ' ' || is_special(c); });
  if (!words || plain != problem.language || plain.ends_with(' ')) {
    refuse(problem, {"the language `" + problem.language + "` would not be read back",
                     "small letters, single blanks, no parentheses and no `;`"});
  }
}

void check_heading(const BddlProblem& problem) {
  const bool libero = problem.dialect == BddlDialect::libero;
  const auto is_word = [](const std::string& word) {
    return !word.empty() &&
           std::none_of(word.begin(), word.end(), [](unsigned char c) { return c <= ' ' || is_special(c); });
  };
  if (!is_word(problem.name)) refuse(problem, {"`" + problem.name + "` cannot be its name", "use one small word"});
  const bool known =
      libero ? problem.domain == "robosuite"
             : problem.domain == "igibson" || problem.domain == "omnigibson" || problem.domain == "behavior-1k";
  if (!known) refuse(problem, {"the domain `" + problem.domain + "` is not of this dialect", "robosuite for LIBERO"});
  if (!libero &&
      !(problem.language.empty() && problem.regions.empty() && problem.fixtures.empty() && problem.interest.empty())) {
    refuse(problem, {"BEHAVIOR has no language, regions, fixtures or objects of interest", "leave them empty"});
  }
  check_language(problem);
}

void check_wildcards(const BddlProblem& problem) {
  for (const BddlGroup& group : problem.objects) {
    const std::string& last = group.names.back();
    if (!symbolic::is_wildcard(last)) continue;
    const auto rooms = std::count_if(problem.init.begin(), problem.init.end(), [&](const BddlLiteral& literal) {
      return literal.atom.predicate == "inroom" && literal.atom.arguments.at(0) == last;
    });
    if (rooms != 1) {
      refuse(problem, {"the wildcard `" + last + "` stands in " + std::to_string(rooms) + " rooms",
                       "write exactly one (inroom " + last + " room) in :init"});
    }
  }
}

}  // namespace

std::string_view to_string(BddlDialect dialect) { return dialect == BddlDialect::libero ? "LIBERO" : "BEHAVIOR"; }

std::string to_text(const BddlFormula& formula) { return formula_text(formula, ""); }

void check_bddl(const BddlProblem& problem) {
  check_heading(problem);
  const symbolic::BddlScope scope(problem);
  if (const auto bad = scope.declarations()) refuse(problem, *bad);
  for (const std::string& name : problem.interest) {
    if (const auto bad = scope.name(name)) refuse(problem, *bad);
  }
  for (const BddlLiteral& literal : problem.init) {
    if (const auto bad = scope.literal(literal)) refuse(problem, *bad);
  }
  if (problem.goal.empty()) refuse(problem, {"the goal is empty", "an empty goal is solved before anything happens"});
  for (const BddlFormula& part : problem.goal) check_formula(problem, scope, part, {});
  check_wildcards(problem);
}

std::string to_bddl(const BddlProblem& problem) {
  check_bddl(problem);
  std::string text = "(define (problem " + problem.name + ")\n  (:domain " + problem.domain + ")\n";
  if (problem.dialect == BddlDialect::libero) {
    text += "  (:language" + (problem.language.empty() ? "" : " " + problem.language) + ")\n  (:regions\n";
    for (const BddlRegion& region : problem.regions) text += region_text(region);
    text += "  )\n" + groups_text(":fixtures", problem.fixtures);
  }
  text += groups_text(":objects", problem.objects);
  if (problem.dialect == BddlDialect::libero) {
    text += "  (:obj_of_interest\n";
    for (const std::string& name : problem.interest) text += "    " + name + "\n";
    text += "  )\n";
  }
  return text + init_text(problem) + goal_text(problem) + ")\n";
}

}  // namespace stampede
