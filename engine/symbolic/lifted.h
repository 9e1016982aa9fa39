// Formulas with numbers for names: what grounding joins over.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/symbolic/symbols.h"

namespace stampede::symbolic {

struct LiftedTerm {
  bool variable = false;
  int id = 0;  // variable or object
};

struct LiftedAtom {
  int predicate = 0;
  std::vector<LiftedTerm> terms;
};

struct Equality {
  LiftedTerm left, right;
  bool equal = true;
};

// A conjunction of literals over the variables of its schema.
struct Conjunct {
  std::vector<LiftedAtom> positive, negative;
  std::vector<Equality> equalities;
  std::vector<int> extra;  // existential variables beyond the parameters
};

struct LiftedEffect {
  LiftedAtom atom;
  bool negated = false;
  std::vector<int> forall;  // variables bound anew
  bool conditional = false;
  Conjunct when;
};

// One disjunct of an action's precondition, or one rule for a derived or auxiliary predicate.
struct Schema {
  int action = -1;  // -1: an axiom with `head`
  LiftedAtom head;
  int parameters = 0;                     // the first variables
  std::vector<std::vector<int>> domains;  // of each variable: the objects of its type and traits
  Conjunct body;
  std::vector<LiftedEffect> effects;
};

struct LiftedTask {
  const Domain* domain = nullptr;
  const Problem* problem = nullptr;
  std::vector<TypedObject> objects;
  std::vector<std::string> predicates;  // the domain's, traits, those only in init, then auxiliary ones
  std::vector<char> fluent;             // by predicate: changed by an action, derived or auxiliary
  std::vector<char> derived;            // by predicate: has axioms (or is defined by them)
  std::vector<Schema> schemas;
  std::vector<LiftedAtom> init;
  Conjunct goal;  // ground
};

// Quantifiers over too many objects to be written out: with the count, and a cure.
class TooManyGround : public Error {
 public:
  explicit TooManyGround(const std::string& what)
      : Error("the problem", what,
              "narrow the types of the variables, name the objects meant, or say it with fewer variables by a derived "
              "predicate") {}
};

// Throws Error for unknown predicates or objects, wrong arities and derived predicates in effects, TooManyGround.
LiftedTask lift(const Domain& domain, const Problem& problem);

}  // namespace stampede::symbolic
