// Builds rows of constraints on the speeds of movers, one side after the other. Private to engine/sim.
#pragma once

#include <vector>

#include "engine/sim/movers.h"
#include "engine/sim/solve_rows.h"

namespace stampede {

// Of all movers, in their order: now; and by forces alone, before any contact.
struct Speeds {
  std::vector<Quad> now, untouched;
  double* of(const Mover& mover) { return now[static_cast<std::size_t>(mover.at)].v; }
  const double* of(const Mover& mover) const { return now[static_cast<std::size_t>(mover.at)].v; }
};

// A row is begun, gets what acts on its one or two movers, is ended, and may be started with an impulse.
class ConstraintRows {
 public:
  static constexpr double kErp = 0.2;  // share of an error in position that a step takes away: contacts, stops, bonds

  ConstraintRows(const Movers& movers, Speeds& speeds, double dt) : movers_(movers), speeds_(speeds), dt_(dt) {}
  void clear() { numbers_.clear(); }
  double dt() const { return dt_; }
  const Quad* numbers() const { return numbers_.data(); }

  SolverRow& begin(std::vector<SolverRow>& rows) {
    SolverRow& row = rows.emplace_back();
    row.numbers = static_cast<int>(numbers_.size());
    return row;
  }
  // Jacobians of links, bodies and joints: the speed of a point along a direction; the spin about one; both.
  void add_point(SolverRow& row, const MoverLink& node, const Vector3& point, const Vector3& direction);
  void add_turn(SolverRow& row, const MoverLink& node, const Vector3& direction);
  void add_screw(SolverRow& row, const MoverLink& node, const Vector3& point, const Vector3& linear,
                 const Vector3& angular);
  double* add_side(SolverRow& row, const Mover& mover);  // all 0; whoever fills it lets its tree respond
  static void respond(const Articulation& tree, double* jacobian);
  void end(SolverRow& row, double target);   // it is complete but for its bounds
  void scale(std::vector<SolverRow>& rows);  // for the loop, which divides no more: the last that happens to them
  void start(SolverRow& row, double impulse) {
    row.impulse = impulse;
    if (impulse != 0) push(numbers_.data(), speeds_.now.data(), row, impulse);
  }
  double speed_of(const SolverRow& row) const { return speed(numbers_.data(), speeds_.now.data(), row); }

 private:
  double* tree_side(SolverRow& row, const Mover& mover);
  template <typename Share>
  void add_tree_side(SolverRow& row, const Mover& mover, int link, const Vector3& point, Share share);
  void add_free_side(SolverRow& row, const Mover& mover, const Vector3& linear, const Vector3& angular);

  const Movers& movers_;
  Speeds& speeds_;
  double dt_;
  std::vector<Quad> numbers_;
};

}  // namespace stampede
