#include <cmath>
#include <utility>

#include "engine/base/processor.h"
#include "engine/render/pixel_kernels.h"

namespace stampede {
namespace {

using Floats = float __attribute__((vector_size(32)));
using Ints = std::int32_t __attribute__((vector_size(32)));

Floats square_root(Floats of) {
  for (std::size_t lane = 0; lane < kLanes; ++lane) of[lane] = std::sqrt(of[lane]);
  return of;
}

#include "engine/render/pixel_kernels.inl"

}  // namespace

const PixelKernels& plain_pixel_kernels() { return kKernels; }

const PixelKernels& pixel_kernels() {
  return may_use_avx2() && avx2_pixel_kernels() != nullptr ? *avx2_pixel_kernels() : plain_pixel_kernels();
}

}  // namespace stampede
