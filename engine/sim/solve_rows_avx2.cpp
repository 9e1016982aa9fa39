// Nothing may be included behind the pragma: it would be compiled for this processor alone.
#include "engine/sim/solve_rows.h"

#if defined(__x86_64__)
#pragma GCC push_options
#pragma GCC target("avx2")

namespace stampede {
namespace avx2_rows {
#include "engine/sim/solve_rows.inl"
}  // namespace avx2_rows

static double solve_with_avx2(const SolverIsland& island, bool forwards) {
  return avx2_rows::solve_all(island, forwards);
}
}  // namespace stampede

#pragma GCC pop_options

namespace stampede {
SolveRows solve_rows_avx2() { return __builtin_cpu_supports("avx2") ? solve_with_avx2 : nullptr; }
}  // namespace stampede

#else

namespace stampede {
SolveRows solve_rows_avx2() { return nullptr; }
}  // namespace stampede

#endif
