// The nearest of many points: right, the first of equals, and the same with AVX2 and without.
#include "engine/motion/nearest.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <vector>

#include "engine/base/random.h"

using namespace stampede;

TEST_CASE("the nearest of many points, with AVX2 and without") {
  Random random(RandomKey("nearest"));
  for (int round = 0; round < 200; ++round) {
    const int joints = 1 + static_cast<int>(random.below(16));
    const std::size_t count = 1 + static_cast<std::size_t>(random.below(90));
    std::vector<EightFloats> blocks((count + kNearestLanes - 1) / kNearestLanes * static_cast<std::size_t>(joints));
    for (EightFloats& block : blocks) std::fill_n(block.v, kNearestLanes, 1e9F);
    const auto value = [&](std::size_t point, int joint) -> float& {
      return blocks[point / kNearestLanes * static_cast<std::size_t>(joints) + static_cast<std::size_t>(joint)]
          .v[point % kNearestLanes];
    };
    for (std::size_t point = 0; point < count; ++point)
      for (int j = 0; j < joints; ++j)  // on a grid: many are equally far
        value(point, j) = static_cast<float>(random.below(3));
    std::vector<float> wanted;
    for (int j = 0; j < joints; ++j) wanted.push_back(static_cast<float>(random.below(5)) / 2);
    std::size_t best = 0;
    float least = 1e30F;
    for (std::size_t point = 0; point < count; ++point) {
      float sum = 0;
      for (int j = 0; j < joints; ++j) {
        const float gap = value(point, j) - wanted[static_cast<std::size_t>(j)];
        sum += gap * gap;
      }
      if (sum >= least) continue;
      least = sum;
      best = point;
    }
    const std::size_t blocks_of_eight = blocks.size() / static_cast<std::size_t>(joints);
    CHECK(nearest_plain(blocks.data(), blocks_of_eight, joints, wanted.data()) == best);
    if (nearest_avx2() != nullptr) CHECK(nearest_avx2()(blocks.data(), blocks_of_eight, joints, wanted.data()) == best);
  }
}
