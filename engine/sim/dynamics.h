// Makes bodies move: forces, joints and contacts, one step of semi-implicit Euler at a time. Bullet finds the contacts.
//
// Contacts and joints are rows of velocity constraints, solved by projected Gauss-Seidel as in Bullet's own solvers
// (Catto, Iterative Dynamics with Temporal Coherence, GDC 2005; Coumans, Bullet 3), with which its settings are shared.
// What differs, all for speed: every tree's mass matrix is inverted once a step and shared by its rows; a tree whose
// joints are all driven starts at the speeds that its motors ask for; contacts start with the impulses of the step
// before; and bodies that touch each other are iterated until nothing changes any more, each such island for itself.
#pragma once

#include <vector>

#include "engine/sim/contact_finder.h"
#include "engine/sim/encounters.h"
#include "engine/sim/island_solver.h"
#include "engine/sim/sleep.h"

namespace stampede {

class Dynamics {
 public:
  Dynamics(ContactFinder& finder, const Vector3& gravity, double dt);
  Dynamics(const Dynamics&) = delete;  // its parts know each other
  Dynamics& operator=(const Dynamics&) = delete;

  Movers& movers() { return movers_; }
  void step(int iterations);  // at most so many where a robot takes part

  // Whoever moves a body himself wakes it first, and all that lies together with it.
  void wake(const btCollisionObject& object) { sleep_.wake(object); }
  void let_sleep(bool sleep);  // false: all wake, and stay so
  // Where contacts are looked for anew: all wake; who slept may sleep again as soon as they are found.
  void forget_contacts();
  std::vector<Rest> rest() const;
  void set_rest(const std::vector<Rest>& rest);
  const std::vector<Torsion>& torsions() const { return solver_.torsions(); }

 private:
  void apply_forces();
  void move();

  ContactFinder& finder_;
  Vector3 gravity_;
  double dt_;
  Movers movers_;
  Speeds speeds_;
  bool may_sleep_ = true;
  Sleep sleep_;
  Encounters encounters_;
  Islands islands_;
  IslandSolver solver_;
};

}  // namespace stampede
