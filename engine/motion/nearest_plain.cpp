#include "engine/base/processor.h"
#include "engine/motion/nearest.h"

namespace stampede {
namespace plain_nearest {
#include "engine/motion/nearest.inl"
}  // namespace plain_nearest

std::size_t nearest_plain(const EightFloats* blocks, std::size_t count, int joints, const float* wanted) {
  return plain_nearest::nearest_of(blocks, count, joints, wanted);
}

Nearest fastest_nearest() { return may_use_avx2() && nearest_avx2() != nullptr ? nearest_avx2() : nearest_plain; }

}  // namespace stampede
