// Bonds: a free body on a joint of something else, which it leaves at a limit. Private to engine/sim.
#pragma once

#include <vector>

#include "engine/model/scene.h"
#include "engine/sim/solve_rows.h"

class btCollisionObject;

namespace stampede {

struct FreeBody;
class ConstraintRows;

struct Bond {
  const btCollisionObject* on = nullptr;
  FreeBody* body = nullptr;
  Transform on_from_joint = Transform::Identity(), body_from_joint = Transform::Identity();  // of the objects' frames
  JointKind kind = JointKind::hinge;
  Vector3 axis = Vector3::UnitZ();  // unit, in the joint's frame
  double lead = 0;                  // of a screw, m/rad
  double lower = 0, upper = 0;      // stops, where they differ
  double friction = 0;              // N or N m
  double lets_go = 0;
  bool upwards = true;  // it is passed from below
  // What tells one moment from another.
  bool holds = true;
  double position = 0;  // m or rad; stays when it has let go

  void place_body() const;  // where the joint at its position has it
  void follow_body();       // finds the position, and whether it still holds
  // Whether the one is its body, and the other belongs to what that is joined to.
  bool joins(const btCollisionObject& one, const btCollisionObject& other) const;
};

void add_bond_rows(const Bond& bond, ConstraintRows& rows, std::vector<SolverRow>& into);

}  // namespace stampede
