// The numbers that things can have (w:number). Each is declared once, by those who read it: a trait, a predicate, a
// skill.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/value.h"
#include "scripting/library/fields.h"

namespace stampede {

struct NumberInfo {
  std::string description, unit;    // unit: m, rad, `m or rad` (the joint's), s, kg, N, N m, or none: a count
  std::optional<double> otherwise;  // of things without it
  bool optional = false;            // nil is read of things without it
  double least = -std::numeric_limits<double>::infinity(), most = std::numeric_limits<double>::infinity();
  std::string trait;  // of things with it; empty: of what some predicate or skill takes
  std::string place;  // the file and line that declare it

  bool needed() const { return !otherwise && !optional; }
};
using Numbers = std::map<std::string, NumberInfo, std::less<>>;

struct Definition;

// As a file says it: { "what it says", unit = "m", default = 0 }. Without any of these it refers to another file's.
// Lifetime: borrows the definition and its value.
struct NumberDeclaration {
  const Definition& definition;
  std::string path;  // of the field there
  std::string name;
  const Value& node;
  std::string trait;  // whose things have it; empty: of what some predicate or skill takes

  bool is_reference() const;
};

// Collects declarations, then judges things and scripts by them.
class NumberTable {
 public:
  const Numbers& all() const { return numbers_; }

  void declare(const NumberDeclaration& number);
  // Of a number that nobody declares, where some script reads what some object has: things must have it.
  void take_read(const std::string& name, const std::string& place);
  // After all declarations.
  void refer(const NumberDeclaration& number);

  // Numbers of a thing: declared ones, of sensible size.
  void check_values(const Value& numbers, const std::string& path, const Complain& complain) const;
  // What things with these traits must have. `has`: names of the numbers that they do have.
  void check_needed(const std::vector<std::string>& traits, const std::vector<std::string>& has,
                    const std::string& path, const Complain& complain) const;

 private:
  Numbers numbers_;
  std::map<std::string, std::vector<std::string>> needed_by_;  // trait -> its numbers without a default
};

// What is said of a number that nobody declares, and the cure.
Error unknown_number(const std::string& where, const std::string& name, const std::vector<std::string>& known);

}  // namespace stampede
