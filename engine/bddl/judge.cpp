#include "engine/bddl/judge.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/bddl/words.h"

namespace stampede {
namespace {

using Kind = BddlFormula::Kind;

class Judge {
 public:
  Judge(const BddlProblem& problem, const BddlValues& values) : scope_(problem), values_(values) {}

  bool holds(const BddlFormula& formula) {
    const auto part_holds = [&](const BddlFormula& part) { return holds(part); };
    switch (formula.kind) {
      case Kind::atom:
        return atom_holds(formula);
      case Kind::negation:
        return !holds(formula.parts.at(0));
      case Kind::conjunction:
        return std::all_of(formula.parts.begin(), formula.parts.end(), part_holds);
      case Kind::disjunction:
        return std::any_of(formula.parts.begin(), formula.parts.end(), part_holds);
      case Kind::implication:
        return !holds(formula.parts.at(0)) || holds(formula.parts.at(1));
      case Kind::forall:
        return count_true(formula) == instances(formula.variables.at(0)).size();
      case Kind::exists:
        return count_true(formula) > 0;
      case Kind::forn:
        return count_true(formula) == static_cast<std::size_t>(formula.count);
      case Kind::forpairs:
      case Kind::fornpairs:
        return pairs_hold(formula);
    }
    return false;
  }

 private:
  bool atom_holds(const BddlFormula& formula) const {
    if (formula.predicate == "true" || formula.predicate == "printjointstate") return true;
    if (formula.predicate == "false") return false;
    Fact fact{formula.predicate, {}};
    for (const Term& term : formula.terms) {
      const auto bound = binding_.find(term.name);
      fact.arguments.push_back(bound == binding_.end() ? term.name : bound->second);
    }
    return values_.value(fact);
  }

  const std::vector<std::string>& instances(const Parameter& variable) const {
    const auto* names = scope_.instances(variable.type);
    if (names == nullptr) throw Error("goal", "no object is of the category `" + variable.type + "`");
    if (symbolic::is_wildcard(names->back())) {
      throw Error("goal", "`" + names->back() + "` is not expanded", "write the instances that are meant in its place");
    }
    return *names;
  }

  std::size_t count_true(const BddlFormula& formula) {
    const Parameter& variable = formula.variables.at(0);
    std::size_t count = 0;
    for (const std::string& value : instances(variable)) {
      binding_[variable.name] = value;
      count += holds(formula.parts.at(0)) ? 1 : 0;
    }
    binding_.erase(variable.name);
    return count;
  }

  bool pairs_hold(const BddlFormula& formula) {
    const Parameter &row = formula.variables.at(0), &column = formula.variables.at(1);
    const auto &rows = instances(row), &columns = instances(column);
    std::vector<char> column_true(columns.size(), 0);
    std::size_t true_rows = 0;
    for (const std::string& of_row : rows) {
      bool any = false;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        if (of_row == columns[k]) continue;  // nothing is paired with itself
        binding_[row.name] = of_row;
        binding_[column.name] = columns[k];
        if (!holds(formula.parts.at(0))) continue;
        any = true;
        column_true[k] = 1;
      }
      true_rows += any ? 1 : 0;
    }
    binding_.erase(row.name);
    binding_.erase(column.name);
    const std::size_t wanted = formula.kind == Kind::forpairs ? std::min(rows.size(), columns.size())
                                                              : static_cast<std::size_t>(formula.count);
    const auto true_columns = static_cast<std::size_t>(std::count(column_true.begin(), column_true.end(), 1));
    return true_rows >= wanted && true_columns >= wanted;
  }

  symbolic::BddlScope scope_;
  const BddlValues& values_;
  Binding binding_;
};

// Their box of a rotated region: the size is rotated as if it were a point.
std::array<double, 3> rotated(const std::array<double, 9>& m, const std::array<double, 3>& v) {
  std::array<double, 3> result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = m[3 * i] * v[0] + m[3 * i + 1] * v[1] + m[3 * i + 2] * v[2];
  return result;
}

constexpr double kNear = 0.03, kUp = 1.0;                           // m
constexpr double kDeeper = 0.01, kAbove = 0.10, kSinkInto = 0.005;  // m

}  // namespace

bool judge(const BddlFormula& formula, const BddlProblem& problem, const BddlValues& values) {
  return Judge(problem, values).holds(formula);
}

bool judge(const BddlProblem& problem, const BddlValues& values) {
  Judge judge_of_parts(problem, values);
  return std::all_of(problem.goal.begin(), problem.goal.end(),
                     [&](const BddlFormula& part) { return judge_of_parts.holds(part); });
}

const BddlGeometry& LiberoGeometry::thing(const std::string& name) const {
  const auto found = things_.find(name);
  if (found == things_.end()) throw Error(name, "has no geometry", "give one for every object, fixture and region");
  return found->second;
}

bool LiberoGeometry::touch(const std::string& a, const std::string& b) const {
  return thing(a).touching.count(b) > 0 || thing(b).touching.count(a) > 0;
}

bool LiberoGeometry::on(const std::string& a, const std::string& b) const {
  const BddlGeometry &above = thing(a), &below = thing(b);
  std::array<double, 3> offset{};
  for (std::size_t i = 0; i < 3; ++i) offset[i] = above.centre_m[i] - below.centre_m[i];
  if (!below.region) return offset[2] >= 0 && touch(a, b) && std::hypot(offset[0], offset[1]) < kNear;
  const std::array<double, 3> local = rotated(below.world_from_box, offset);  // sic: not the inverse
  const std::array<double, 3>& half = below.half_size_m;
  const bool over = std::abs(local[0]) < half[0] && std::abs(local[1]) < half[1];
  const bool height = local[2] > half[2] - kSinkInto && local[2] < half[2] + kAbove;
  const bool parent = !below.parent.empty() && things_.count(below.parent) > 0;
  return over && height && (!parent || touch(a, below.parent));
}

bool LiberoGeometry::in(const std::string& a, const std::string& b) const {
  const BddlGeometry &inner = thing(a), &outer = thing(b);
  if (!outer.region && !touch(a, b)) return false;
  const std::array<double, 3> half =
      outer.region ? rotated(outer.world_from_box, outer.half_size_m) : outer.half_size_m;
  for (std::size_t i = 0; i < 3; ++i) {
    const double low = outer.centre_m[i] - std::abs(half[i]) - (i == 2 ? kDeeper : 0);
    const double high = outer.centre_m[i] + std::abs(half[i]);
    if (!(inner.centre_m[i] > low && inner.centre_m[i] < high)) return false;
  }
  return true;
}

bool LiberoGeometry::value(const Fact& atom) const {
  const auto& names = atom.arguments;
  const auto any = [&](bool BddlJoint::*test) {
    const auto& joints = thing(names.at(0)).joints;
    return std::any_of(joints.begin(), joints.end(), [&](const BddlJoint& joint) { return joint.*test; });
  };
  const auto all = [&](bool BddlJoint::*test) {
    const auto& joints = thing(names.at(0)).joints;
    return std::all_of(joints.begin(), joints.end(), [&](const BddlJoint& joint) { return joint.*test; });
  };
  const auto arity = symbolic::bddl_predicates(BddlDialect::libero).find(atom.predicate);
  if (arity == symbolic::bddl_predicates(BddlDialect::libero).end() ||
      (arity->second > 0 && static_cast<int>(names.size()) != arity->second)) {
    throw Error(to_text(atom), "LIBERO has no such atom");
  }
  if (atom.predicate == "on") return on(names[0], names[1]);
  if (atom.predicate == "in") return in(names[0], names[1]);
  if (atom.predicate == "open") return any(&BddlJoint::open);
  if (atom.predicate == "close") return all(&BddlJoint::closed);
  if (atom.predicate == "turnon") return any(&BddlJoint::on);
  if (atom.predicate == "turnoff") return all(&BddlJoint::off);
  if (atom.predicate == "up") return thing(names[0]).centre_m[2] >= kUp;
  return atom.predicate != "false";
}

}  // namespace stampede
