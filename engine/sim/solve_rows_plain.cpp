#include "engine/base/processor.h"
#include "engine/sim/solve_rows.h"

namespace stampede {
namespace plain_rows {
#include "engine/sim/solve_rows.inl"
}  // namespace plain_rows

double solve_rows_plain(const SolverIsland& island, bool forwards) { return plain_rows::solve_all(island, forwards); }

SolveRows fastest_solve_rows() {
  return may_use_avx2() && solve_rows_avx2() != nullptr ? solve_rows_avx2() : solve_rows_plain;
}

void over_response(Quad* numbers, SolverRow& row) {
  Quad* jacobian = numbers + row.numbers;
  for (const int quads : row.quads) {
    for (int k = 0; k < quads; ++k)
      for (double& number : jacobian[k].v) number *= row.response_inverse;
    jacobian += 2 * quads;
  }
  row.target *= row.response_inverse;
}

void push(const Quad* numbers, Quad* velocities, const SolverRow& row, double impulse) {
  plain_rows::push_by(numbers, velocities, row, impulse);
}

double speed(const Quad* numbers, const Quad* velocities, const SolverRow& row) {
  return plain_rows::speed_of(numbers, velocities, row);
}

}  // namespace stampede
