#include "engine/render/sensor_noise.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace stampede {
namespace {

constexpr double kSteepest = 5.67;  // of a surface against the picture plane: tan 80 degrees

// Nearly normal, by arithmetic that every processor rounds alike, and 20 times faster than a logarithm: the sum of 64
// fair coins, with the gap between two sums filled evenly. Excess kurtosis -0.03. Two draws each.
double coin_normal(Random& random) {
  constexpr double kDeviation = 4.0104030;  // sqrt(64 / 4 + 1 / 12)
  const int coins = std::popcount(random.bits()) - 32;
  return (coins + random.uniform() - 0.5) / kDeviation;
}

void add_colour_noise(std::vector<std::uint8_t>& rgb, double deviation, Random random) {
  for (std::uint8_t& channel : rgb) {
    const double value = std::floor(channel + 255 * deviation * coin_normal(random) + 0.5);
    channel = static_cast<std::uint8_t>(std::clamp(value, 0.0, 255.0));
  }
}

// The depth changes so fast here that the sensor's pattern is torn (a silhouette) or smeared (a grazing angle).
std::vector<bool> unreadable(const Picture& picture, const Camera& camera) {
  std::vector<bool> lost(picture.depth.size());
  const auto compare = [&](std::size_t a, std::size_t b, double focal) {
    const double near = std::min(picture.depth[a], picture.depth[b]),
                 far = std::max(picture.depth[a], picture.depth[b]);
    const bool steep = near <= 0 ? far > 0 : (far - near) * focal > kSteepest * near;
    if (steep) lost[a] = lost[b] = true;
  };
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  for (std::size_t v = 0; v < height; ++v)
    for (std::size_t u = 0; u < width; ++u) {
      const std::size_t at = v * width + u;
      if (u + 1 < width) compare(at, at + 1, camera.focal_x);
      if (v + 1 < height) compare(at, at + width, camera.focal_y);
    }
  return lost;
}

// Such a sensor measures disparity, in proportion to 1 / z, in steps of twice its deviation (equations 14 and 16).
void add_depth_noise(Picture& picture, const Camera& camera, double deviation, Random random) {
  const std::vector<bool> lost = unreadable(picture, camera);
  const double step = 2 * deviation;
  for (std::size_t i = 0; i < picture.depth.size(); ++i) {
    const double noise = coin_normal(random);  // drawn for every pixel: none depends on the others
    float& depth = picture.depth[i];
    if (depth <= 0) continue;
    const double measured = std::floor((1 / double{depth} + deviation * noise) / step + 0.5) * step;
    depth = lost[i] || measured <= 0 ? 0.0F : static_cast<float>(1 / measured);
  }
}

}  // namespace

void add_noise(Picture& picture, const Camera& camera, const CameraNoise& noise, RandomKey key) {
  if (noise.rgb > 0) add_colour_noise(picture.rgb, noise.rgb, Random(key.with("rgb")));
  if (noise.depth > 0 && !picture.depth.empty())
    add_depth_noise(picture, camera, noise.depth, Random(key.with("depth")));
}

}  // namespace stampede
