// Nothing may be included behind the pragma: it would be compiled for this processor alone.
#include "engine/motion/nearest.h"

#if defined(__x86_64__)
#ifdef __clang__  // which does not know the others
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2")
#endif

namespace stampede {
namespace avx2_nearest {
#define STAMPEDE_NEAREST_AVX2  // __AVX2__ is not seen behind a pragma when the preprocessor runs on its own
#include "engine/motion/nearest.inl"
}  // namespace avx2_nearest

static std::size_t nearest_with_avx2(const EightFloats* blocks, std::size_t count, int joints, const float* wanted) {
  return avx2_nearest::nearest_of(blocks, count, joints, wanted);
}
}  // namespace stampede

#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace stampede {
Nearest nearest_avx2() { return __builtin_cpu_supports("avx2") ? nearest_with_avx2 : nullptr; }
}  // namespace stampede

#else

namespace stampede {
Nearest nearest_avx2() { return nullptr; }
}  // namespace stampede

#endif
