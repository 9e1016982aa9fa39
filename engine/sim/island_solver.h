// Finds the impulses of contacts, joints and bonds within one island at a time. Private to engine/sim.
#pragma once

#include <utility>
#include <vector>

#include "engine/sim/constraint_rows.h"
#include "engine/sim/islands.h"

class btManifoldPoint;

namespace stampede {

// What rolling and spinning friction did in the last step: contact points leave that out.
struct Torsion {
  const btCollisionObject *on, *other;
  Vector3 impulse;  // angular, world, on `on`; the other got the opposite
};

class IslandSolver {
 public:
  IslandSolver(const Movers& movers, Speeds& speeds, const Vector3& gravity, double dt)
      : movers_(movers), speeds_(speeds), gravity_(gravity), dt_(dt), rows_(movers, speeds, dt) {}

  void solve(const Island& island, int iterations);  // changes speeds now; at most so many where a robot takes part
  const std::vector<Torsion>& torsions() const { return torsions_; }
  void forget_torsions() { torsions_.clear(); }

 private:
  struct Members {  // of an island
    bool robot = false, mechanism = false;
    bool settling = true;                                // slow, and without a robot
    bool alone() const { return !robot && !mechanism; }  // free bodies
  };
  struct Touched {
    btManifoldPoint* point = nullptr;
    const btCollisionObject *first = nullptr, *second = nullptr;
  };
  struct Bounds {                           // of contacts
    double impulse = 1e10, parting = 1e30;  // N s; m/s, of what lies in each other
  };
  struct Motion {                     // of free bodies
    double energy = 0, momentum = 0;  // J; N s, with what a step presses into them
    double mass = 0;                  // kg
  };

  struct Watched {
    std::size_t quad = 0;
    Quad speeds;
  };

  void clear();
  Members members_of(const Island& island) const;
  Motion free_motion(const Island& island) const;
  Bounds bounds_of(const Members& members, const Motion& motion) const;
  std::size_t add_all_contacts(const Island& island, const Members& members, const Bounds& bounds);
  void add_contacts(const Touching& touching, double kept, const Bounds& bounds);
  void add_joints(const Mover& mover);
  void start_motors(const Mover& mover, std::size_t first);
  bool any_deep() const;
  void watch(const Island& island);
  bool changed();  // the speeds that are watched, since they were last looked at
  void slow_down(const Island& island, double share);
  void take_no_energy(const Island& island, const Motion& before);
  void keep_results();

  const Movers& movers_;
  Speeds& speeds_;
  Vector3 gravity_;
  double dt_;
  std::vector<Torsion> torsions_;
  // Of the island that is being solved.
  ConstraintRows rows_;
  std::vector<SolverRow> joints_, contact_rows_;
  std::vector<std::pair<int, JointMotor*>> motor_rows_;
  std::vector<SolverContact> contacts_;
  double parting_ = 0;            // m/s, the most that a contact asks of what lies in each other
  std::vector<Touched> touched_;  // of the contacts
  std::vector<Watched> watched_;
  std::vector<double> scratch_;
  SolveRows solve_rows_ = fastest_solve_rows();
};

}  // namespace stampede
