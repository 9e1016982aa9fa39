// The nearest of many points: the inner loop of the trees. Room-internal.
#pragma once

#include <cstddef>
#include <vector>

namespace stampede {

constexpr int kNearestLanes = 8;

// Points in blocks of eight: for each joint eight floats.
struct alignas(32) EightFloats {
  float v[kNearestLanes];
};

// Where the point nearest to `wanted` is, of the first of equals. Among some thousands, looking at all is the fastest
// way. Sums in single precision, in one order: the same on every processor.
using Nearest = std::size_t (*)(const EightFloats* blocks, std::size_t count, int joints, const float* wanted);
std::size_t nearest_plain(const EightFloats* blocks, std::size_t count, int joints, const float* wanted);
Nearest nearest_avx2();     // null where the processor has none
Nearest fastest_nearest();  // that may be used, see may_use_avx2

}  // namespace stampede
