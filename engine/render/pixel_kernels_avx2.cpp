#include <utility>

#include "engine/render/pixel_kernels.h"

#ifdef __x86_64__

#include <immintrin.h>

// After all headers: what they define must run on every processor.
#ifdef __clang__  // which does not know the other
#pragma clang attribute push(__attribute__((target("avx2"))), apply_to = function)
#else
#pragma GCC target("avx2")
#endif

namespace stampede {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));

Floats square_root(Floats of) { return _mm256_sqrt_ps(of); }

#include "engine/render/pixel_kernels.inl"

}  // namespace

const PixelKernels* avx2_pixel_kernels() { return __builtin_cpu_supports("avx2") ? &kKernels : nullptr; }

}  // namespace stampede

#ifdef __clang__
#pragma clang attribute pop
#endif

#else

namespace stampede {

const PixelKernels* avx2_pixel_kernels() { return nullptr; }

}  // namespace stampede

#endif
