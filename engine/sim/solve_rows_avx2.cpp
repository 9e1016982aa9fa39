// Nothing may be included behind the pragma: it would be compiled for this processor alone.
#include "engine/sim/solve_rows.h"

#if defined(__x86_64__)
#ifdef __clang__  // which does not know the others
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

namespace stampede {
namespace avx2_rows {
#include "engine/sim/solve_rows.inl"
}  // namespace avx2_rows

static double solve_with_avx2(const SolverIsland& island, bool forwards) {
  return avx2_rows::solve_all(island, forwards);
}
}  // namespace stampede

#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace stampede {
SolveRows solve_rows_avx2() { return __builtin_cpu_supports("avx2") ? solve_with_avx2 : nullptr; }
}  // namespace stampede

#else

namespace stampede {
SolveRows solve_rows_avx2() { return nullptr; }
}  // namespace stampede

#endif
