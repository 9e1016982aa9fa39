// Nothing may be included behind the pragma: it would be compiled for this processor alone.
#include "engine/sim/screen.h"

#if defined(__x86_64__)
#ifdef __clang__  // which does not know the others
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#endif

namespace stampede {
namespace avx2_screen {
#define STAMPEDE_SCREEN_AVX2  // __AVX2__ is not seen behind a pragma when the preprocessor runs on its own
#include "engine/sim/screen.inl"
}  // namespace avx2_screen

static std::uint8_t screen_with_avx2(const ScreenTables& tables, ScreenBatch& batch, bool any) {
  return avx2_screen::Screening(tables, batch, any).touching();
}
}  // namespace stampede

#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif

namespace stampede {
Screen screen_avx2() {
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") ? screen_with_avx2 : nullptr;
}
}  // namespace stampede

#else

namespace stampede {
Screen screen_avx2() { return nullptr; }
}  // namespace stampede

#endif
