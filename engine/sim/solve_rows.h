// The inner loop of the solver: once over all rows of an island. Written once, compiled for processors with AVX2 and
// for all others; sums are of four numbers at a time in one order, so both give the same bits.
#pragma once

#include <cstddef>

namespace stampede {

struct alignas(32) Quad {
  double v[4] = {0, 0, 0, 0};
};

// A constraint on the speeds of one or two movers: J v = target, by an impulse within bounds. When the loop begins, J
// and target are over the response: then their difference is the impulse that is missing.
struct SolverRow {
  int numbers = 0;                            // where its numbers begin: of each mover J, then M^-1 J^T
  int at[2] = {0, 0}, quads[2] = {0, 0};      // of the movers, in the velocities
  double response = 0, response_inverse = 0;  // J M^-1 J^T
  double target = 0;                          // m/s or rad/s; in the loop N s or N m s
  double impulse = 0, lower = 0, upper = 0;
};

struct SolverContact {
  int normal = 0;                                  // its row; two rows of friction follow it
  int spin = -1, roll = -1;                        // rows, the latter of two; -1: none
  double friction = 0, spinning = 0, rolling = 0;  // greatest impulses across, over that of the normal
};

struct SolverIsland {
  const Quad* numbers = nullptr;
  Quad* velocities = nullptr;
  SolverRow *rows = nullptr, *joints = nullptr;
  const SolverContact* contacts = nullptr;
  std::size_t link_contacts = 0, contact_count = 0;  // those from link_contacts on are on links
  std::size_t joint_count = 0, bond_count = 0;       // rows of bonds follow those of joints
};

// What is held meets other things first and the fingers last, so that it stays in the hand; joints in between,
// alternately from both ends; what is joined to something last of all, or a strong hand would tear it off. The greatest
// change of a row's speed, m/s or rad/s.
using SolveRows = double (*)(const SolverIsland& island, bool forwards);
double solve_rows_plain(const SolverIsland& island, bool forwards);
SolveRows solve_rows_avx2();     // null where the processor has none
SolveRows fastest_solve_rows();  // that may be used, see may_use_avx2

void over_response(Quad* numbers, SolverRow& row);  // makes a row that is complete ready for the loop
// What an impulse does to the velocities.
void push(const Quad* numbers, Quad* velocities, const SolverRow& row, double impulse);
double speed(const Quad* numbers, const Quad* velocities, const SolverRow& row);

}  // namespace stampede
