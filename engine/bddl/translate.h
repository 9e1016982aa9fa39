// Goals and literals from their words into ours.
#pragma once

#include <functional>

#include "engine/bddl/import.h"
#include "engine/bddl/words.h"

namespace stampede::symbolic {

struct Refusal {  // thrown inside import and export only; becomes their `refusal`
  std::string why;
};

// Lifetime: refers to all it is made from. Adds to the task's notes, literals and used regions.
class BddlTranslator {
 public:
  BddlTranslator(const BddlProblem& problem, const BddlMapping& mapping, BddlTask& task);
  Formula literal(const Fact& atom, bool negated);  // throws Refusal
  Formula formula(const BddlFormula& formula, bool negated = false);

 private:
  Formula plain_literal(const Fact& atom, bool negated, const std::string& last);  // last: our last argument
  Formula with_choices(const std::string& theirs, const std::string& ours, std::vector<Term> terms, std::size_t from);
  bool on_at_start(const Fact& atom) const;
  const std::vector<std::string>* parts_of(const std::string& theirs) const;
  Formula atom_formula(const BddlFormula& formula, bool negated);
  Formula join(std::vector<Formula> parts, bool all) const;
  Formula each(const BddlFormula& formula, bool all, bool negated);
  Formula exactly(const BddlFormula& formula, bool negated);
  Formula pairs(const BddlFormula& formula, bool negated);
  Formula with_value(const BddlFormula& formula, std::size_t variable, const std::string& value, bool negated);
  std::vector<std::string> instances(const Parameter& variable) const;
  void limit(const BddlFormula& formula, double disjuncts) const;
  const BddlMadeRegion* made_region(const std::string& theirs) const;

  const BddlProblem& problem_;
  const BddlMapping& mapping_;
  BddlTask& task_;
  BddlScope scope_;
  Binding binding_;
  int atoms_ = 0;
};

}  // namespace stampede::symbolic
