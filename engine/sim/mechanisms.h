// Joints of furniture: friction, damping, return springs, detents, latches and couplings. Private to engine/sim.
#pragma once

#include <vector>

#include "engine/sim/bodies.h"

namespace stampede {

// A joint of furniture with what acts on it. All of it is a function of joint positions and `locked`.
struct Mechanism {
  PartRef part;
  Articulation* tree = nullptr;
  std::size_t dof = 0;
  double inertia = 1;            // that one joint feels at the start, kg or kg m^2
  JointMotor* brake = nullptr;   // friction, and the lock of a latch
  JointMotor* spring = nullptr;  // return spring or detent
  int key_dof = -1;              // of the latch; -1: none
  double key_initial = 0;
  double relock_below = 0;
  bool locked = false;
  double torque = 0;  // given in this step

  void turn_lock(const Joint& joint);
  void give_forces(const Joint& joint, double dt);
  double effort() const { return brake->force + (spring ? spring->force : 0.0) + torque; }
};

// Of all bodies, in their order.
std::vector<Mechanism> build_mechanisms(const Bodies& bodies, Movers& movers, double dt);

}  // namespace stampede
