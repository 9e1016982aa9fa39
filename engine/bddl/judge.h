// Judging a BDDL goal by the dialect's own rule, beside ours.
#pragma once

#include <set>

#include "engine/bddl/bddl.h"

namespace stampede {

// The dialect's own predicates in one state. Their names and their arguments.
class BddlValues {
 public:
  virtual ~BddlValues() = default;
  virtual bool value(const Fact& atom) const = 0;
};

// As their evaluators decide, measured on them:
// forn n: exactly n instances. forpairs A B: with L the smaller number of instances, at least L rows and at least L
// columns have a true entry, which is weaker than a matching: one A with all B and all A with that one B is enough.
// fornpairs n: the same test with n. LIBERO: all atoms of the list.
// Throws Error for wildcards that are not expanded.
bool judge(const BddlProblem& problem, const BddlValues& values);
bool judge(const BddlFormula& formula, const BddlProblem& problem, const BddlValues& values);

// One joint against the ranges of its fixture.
struct BddlJoint {
  bool open = false, closed = false, on = false, off = false;
};

struct BddlGeometry {
  std::array<double, 3> centre_m = {0, 0, 0};                          // of the body's frame, or of the region; world
  std::array<double, 3> half_size_m = {0, 0, 0};                       // of its box
  std::array<double, 9> world_from_box = {1, 0, 0, 0, 1, 0, 0, 0, 1};  // rotation, row by row; regions only
  bool region = false;
  std::string parent;              // of a region; empty: none in the scene
  std::set<std::string> touching;  // names of what it is in contact with, itself not a region
  std::vector<BddlJoint> joints;   // of a region: those that move it
};

// LIBERO's predicates by its own geometry:
// on a b: b's centre not above a's, contact, centres less than 3 cm apart horizontally. Of a region b: a's centre over
// the box, up to 10 cm above its top and 5 mm below, and contact with the region's parent if it has one.
// in a b: contact (a region: always) and a's centre in b's box, 1 cm deeper than it is.
// open, turnon: any joint; close, turnoff: all joints, so also one without joints. up: z at least 1 m.
class LiberoGeometry : public BddlValues {
 public:
  explicit LiberoGeometry(std::map<std::string, BddlGeometry> things) : things_(std::move(things)) {}
  bool value(const Fact& atom) const override;  // Throws Error for names and predicates it does not have

 private:
  const BddlGeometry& thing(const std::string& name) const;
  bool touch(const std::string& a, const std::string& b) const;
  bool on(const std::string& a, const std::string& b) const;
  bool in(const std::string& a, const std::string& b) const;
  std::map<std::string, BddlGeometry> things_;
};

// Values from a set of ground atoms in their words; what is not there is false.
class BddlFacts : public BddlValues {
 public:
  explicit BddlFacts(Facts facts) : facts_(std::move(facts)) {}
  bool value(const Fact& atom) const override { return facts_.count(atom) > 0; }

 private:
  Facts facts_;
};

}  // namespace stampede
