// BDDL, the problem language of LIBERO and BEHAVIOR: values, reading and writing.
#pragma once

#include <array>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/symbolic/symbols.h"

namespace stampede {

enum class BddlDialect { libero, behavior };
std::string_view to_string(BddlDialect dialect);

// All instances of one category: one line, since their parser keeps only the last line of a type.
struct BddlGroup {
  std::string category;
  std::vector<std::string> names;
  friend bool operator==(const BddlGroup&, const BddlGroup&) = default;
};

struct BddlRectangle {
  double x_min_m = 0, y_min_m = 0, x_max_m = 0, y_max_m = 0;  // in the frame of the region's target
  friend bool operator==(const BddlRectangle&, const BddlRectangle&) = default;
};

// LIBERO only. Without ranges: a site that the target's own model has (a drawer's inside).
struct BddlRegion {
  std::string name, target;
  std::vector<BddlRectangle> ranges;
  std::array<double, 2> yaw_rad = {0, 0};  // least, greatest
  std::array<double, 4> rgba = {0, 0, 1, 0};
  std::string key() const { return target + "_" + name; }  // what all other sections call it
  friend bool operator==(const BddlRegion&, const BddlRegion&) = default;
};

struct BddlLiteral {
  Fact atom;
  bool negated = false;
  friend bool operator==(const BddlLiteral&, const BddlLiteral&) = default;
};

struct BddlFormula {
  enum class Kind {
    atom,
    negation,
    conjunction,
    disjunction,
    implication,
    forall,
    exists,
    forn,       // exactly `count` values of the variable
    forpairs,   // see judge() in judge.h
    fornpairs,  // the same with `count` pairs
  };
  Kind kind = Kind::atom;
  std::string predicate;             // atom
  std::vector<Term> terms;           // atom; a variable's name is usually its category
  std::vector<BddlFormula> parts;    // negation and quantifiers: 1; implication: 2
  std::vector<Parameter> variables;  // quantifiers: name and category (as type); the pair forms have 2
  int count = 0;                     // forn, fornpairs
  friend bool operator==(const BddlFormula&, const BddlFormula&) = default;
};
std::string to_text(const BddlFormula& formula);

struct BddlProblem {
  BddlDialect dialect = BddlDialect::libero;
  std::string name;    // LIBERO: the Python class, in small letters; BEHAVIOR: activity-k
  std::string domain;  // robosuite; igibson, omnigibson, behavior-1k
  std::string language;
  std::vector<BddlRegion> regions;           // LIBERO
  std::vector<BddlGroup> fixtures, objects;  // BEHAVIOR has no fixtures
  std::vector<std::string> interest;         // LIBERO
  std::vector<BddlLiteral> init;             // LIBERO: none negated
  std::vector<BddlFormula> goal;             // all must hold; never empty. LIBERO: atoms
  friend bool operator==(const BddlProblem&, const BddlProblem&) = default;
};

struct BddlReading {
  BddlProblem problem;
  std::vector<std::string> warnings;  // with place: what their parser would have made of it where that differs
};

// Reads what their parsers read, sections in any order and more than once. Where theirs silently lose something (a
// second line of a type, a second :init) it is kept and a warning says so.
// Throws Error with file, line, column and cure, also where theirs crash or would run a task that nobody meant: an
// empty goal, undefined names, wrong arity, :scene_properties, logic that LIBERO parses but cannot evaluate.
BddlReading read_bddl(std::string_view text, const std::string& file);

// Throws Error when their parser would not read the text of this value back as this value, or an atom does not resolve.
void check_bddl(const BddlProblem& problem);

// Small letters, one line per type and per literal. Reading it gives an equal value.
// Throws Error as check_bddl does.
std::string to_bddl(const BddlProblem& problem);

}  // namespace stampede
