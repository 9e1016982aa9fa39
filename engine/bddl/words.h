// What the words of a BDDL problem may be: shared by its reader, its checks and its writer.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/bddl/bddl.h"

namespace stampede::symbolic {

struct Complaint {
  std::string what, hint;
};

const std::map<std::string, int>& bddl_predicates(BddlDialect dialect);     // -> arity; -1: one or two
bool is_bddl_room(const std::string& word);                                 // of BEHAVIOR-1K's linter
bool is_wildcard(const std::string& name);                                  // ends in _*
bool is_instance_of(const std::string& name, const std::string& category);  // category_7 or category_*

// The names that atoms of one problem may use. Lifetime: refers to the problem.
class BddlScope {
 public:
  explicit BddlScope(const BddlProblem& problem);
  // Names declared twice, regions without target, ill-formed words.
  std::optional<Complaint> declarations() const;
  std::optional<Complaint> literal(const BddlLiteral& literal) const;
  // One node of a formula, its parts left out. `bound`: the variables around it.
  std::optional<Complaint> node(const BddlFormula& formula, const std::vector<Parameter>& bound) const;
  std::optional<Complaint> name(const std::string& name) const;  // resolves to an object, fixture or region
  const std::vector<std::string>* instances(const std::string& category) const;

 private:
  std::optional<Complaint> goal_atom(const BddlFormula& formula, const std::vector<Parameter>& bound) const;
  std::optional<Complaint> atom(const std::string& predicate, const std::vector<std::string>& arguments,
                                const std::vector<Parameter>& bound) const;
  std::optional<Complaint> quantifier(const BddlFormula& formula, const std::vector<Parameter>& bound) const;

  const BddlProblem& problem_;
  std::set<std::string> things_;   // objects and fixtures
  std::set<std::string> regions_;  // keys
};

}  // namespace stampede::symbolic
