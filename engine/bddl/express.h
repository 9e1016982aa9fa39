// Names, literals and goals of ours in the words of a dialect.
#pragma once

#include "engine/bddl/export.h"
#include "engine/bddl/translate.h"
#include "engine/symbolic/evaluation.h"

namespace stampede::symbolic {

// Gives each thing its name there, as an object, fixture, region or not at all.
// Fills `objects`, `fixtures`, `names` and remarks; Lifetime: refers to all it is made from.
class BddlNaming {
 public:
  BddlNaming(const BddlScene& scene, const BddlMapping& mapping, BddlExport& result);
  void name_all();
  const BddlThing* thing(const std::string& name) const;
  const std::string& theirs(const std::string& ours) const;  // throws Refusal; a region is declared when it is used
  std::string surface(const BddlThing& fixture);             // LIBERO: the region of a fixture's area
  bool is_surface(const std::string& theirs) const;          // a fixture, or the region of its area
  std::string spot(const BddlPlacement& placement);          // LIBERO: the region where an object starts
  void declare(const std::string& ours);                     // LIBERO: the region of a part or region
  void remark(const std::string& text);                      // once
  std::string add_instance(const std::string& category);     // BEHAVIOR

 private:
  void name_libero(const BddlThing& thing);
  void name_behavior(const BddlThing& thing);
  void add(std::vector<BddlGroup>& groups, const std::string& category, const std::string& name);
  std::string unique(const std::string& name);
  void add_region(const BddlRegion& region);

  const BddlScene& scene_;
  const BddlMapping& mapping_;
  BddlExport& result_;
  std::set<std::string> taken_, surfaces_;
  std::map<std::string, BddlRegion> sites_;  // our part or region -> theirs
};

// Formulas with all that is decided now left out: `and` and `or` without parts are true and false.
class BddlExpression {
 public:
  BddlExpression(const BddlScene& scene, const BddlMapping& mapping, const Domain& domain, BddlNaming& naming,
                 BddlExport& result);
  BddlFormula formula(const Formula& formula, bool negated = false);  // throws Refusal
  // One literal by the mapping. `names`: ours; a leading `?` marks one of their variables.
  BddlFormula literal(const std::string& predicate, const std::vector<std::string>& names, bool negated);

 private:
  bool within_flat(const std::string& predicate, const BddlThing* last) const;
  BddlFormula atom_by(const BddlPredicateRule& rule, const std::vector<std::string>& names);
  void put_on_fixture(const std::string& ours, const BddlThing& fixture, BddlFormula& atom);
  BddlNote note_of(const BddlPredicateRule& rule, const std::string& predicate, const BddlThing* last,
                   bool negated) const;
  BddlFormula join(std::vector<BddlFormula> parts, bool all) const;
  BddlFormula atom_formula(const Formula& formula, bool negated);
  BddlFormula quantified(const Formula& formula, bool negated);
  bool keep(const Formula& formula, std::string& category) const;
  bool plain(const Formula& formula) const;
  bool fixed(const std::string& predicate) const;

  const BddlScene& scene_;
  const BddlMapping& mapping_;
  const Domain& domain_;
  BddlNaming& naming_;
  BddlExport& result_;
  std::vector<TypedObject> objects_;
  Binding binding_;  // to our objects, or to `?category`
  int atoms_ = 0, depth_ = 0;
};

}  // namespace stampede::symbolic
