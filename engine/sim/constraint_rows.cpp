#include "engine/sim/constraint_rows.h"

#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "engine/sim/bullet_convert.h"

namespace stampede {

double* ConstraintRows::add_side(SolverRow& row, const Mover& mover) {
  const int side = row.quads[0] == 0 ? 0 : 1;
  row.at[side] = mover.at;
  row.quads[side] = mover.quads;
  const std::size_t begin = numbers_.size();
  numbers_.resize(begin + 2 * static_cast<std::size_t>(mover.quads));
  return numbers_[begin].v;
}

// A new side, or where two links of one tree meet, that of the first: the second adds to it, and its response is made
// anew.
double* ConstraintRows::tree_side(SolverRow& row, const Mover& mover) {
  if (row.quads[0] == 0 || row.at[0] != mover.at) return add_side(row, mover);
  const auto side = numbers_.begin() + row.numbers;
  std::fill(side + mover.quads, side + 2 * static_cast<std::ptrdiff_t>(mover.quads), Quad{});
  return side->v;
}

void ConstraintRows::respond(const Articulation& tree, double* jacobian) {
  const int count = tree.width();
  double* response = jacobian + count;
  for (int i = 0; i < tree.dofs(); ++i) {
    const double share = jacobian[i];
    if (share == 0) continue;
    const double* column = tree.inverse_mass(i);
    for (int j = 0; j < count; ++j) response[j] += share * column[j];
  }
}

void ConstraintRows::add_free_side(SolverRow& row, const Mover& mover, const Vector3& linear, const Vector3& angular) {
  double* jacobian = add_side(row, mover);
  const double lightness = 1 / mover.free->mass;
  const Vector3 turned = mover.inverse_inertia * angular;
  for (int i = 0; i < 3; ++i) {
    jacobian[i] = linear[i];
    jacobian[3 + i] = angular[i];
    jacobian[8 + i] = lightness * linear[i];
    jacobian[11 + i] = turned[i];
  }
}

// What a dof adds, by what it does to the link at unit speed.
template <typename Share>
void ConstraintRows::add_tree_side(SolverRow& row, const Mover& mover, int link, const Vector3& point, Share share) {
  double* jacobian = tree_side(row, mover);
  mover.tree->jacobian(
      link, point, [&](int dof, const Vector3& speed, const Vector3& spin) { jacobian[dof] += share(speed, spin); });
  respond(*mover.tree, jacobian);
}

void ConstraintRows::add_point(SolverRow& row, const MoverLink& node, const Vector3& point, const Vector3& direction) {
  if (node.mover < 0) return;
  const Mover& mover = movers_[node.mover];
  if (mover.free) {
    const Vector3 arm = point - from_bullet(mover.free->object->getWorldTransform().getOrigin());
    add_free_side(row, mover, direction, arm.cross(direction));
    return;
  }
  add_tree_side(row, mover, node.link, point,
                [&](const Vector3& speed, const Vector3&) { return speed.dot(direction); });
}

void ConstraintRows::add_turn(SolverRow& row, const MoverLink& node, const Vector3& direction) {
  if (node.mover < 0) return;
  const Mover& mover = movers_[node.mover];
  if (mover.free) {
    add_free_side(row, mover, Vector3::Zero(), direction);
    return;
  }
  add_tree_side(row, mover, node.link, Vector3::Zero(),
                [&](const Vector3&, const Vector3& spin) { return spin.dot(direction); });
}

void ConstraintRows::add_screw(SolverRow& row, const MoverLink& node, const Vector3& point, const Vector3& linear,
                               const Vector3& angular) {
  if (node.mover < 0) return;
  const Mover& mover = movers_[node.mover];
  if (mover.free) {
    const Vector3 arm = point - from_bullet(mover.free->object->getWorldTransform().getOrigin());
    add_free_side(row, mover, linear, arm.cross(linear) + angular);
    return;
  }
  add_tree_side(row, mover, node.link, point,
                [&](const Vector3& speed, const Vector3& spin) { return speed.dot(linear) + spin.dot(angular); });
}

void ConstraintRows::end(SolverRow& row, double target) {
  const Quad* numbers = &numbers_[static_cast<std::size_t>(row.numbers)];
  row.response = 0;
  for (const int quads : row.quads) {
    for (int k = 0; k < quads; ++k)
      for (int i = 0; i < 4; ++i) row.response += numbers[k].v[i] * numbers[quads + k].v[i];
    numbers += 2 * quads;
  }
  row.response_inverse = row.response > 1e-15 ? 1 / row.response : 0;
  row.target = target;
}

void ConstraintRows::scale(std::vector<SolverRow>& rows) {
  for (SolverRow& row : rows) over_response(numbers_.data(), row);
}

}  // namespace stampede
