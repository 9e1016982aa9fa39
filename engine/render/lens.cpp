#include "engine/render/lens.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/model/camera.h"

namespace stampede {
namespace {

constexpr double kWidest = 6;          // tangent: 80 degrees off the axis
constexpr double kFiner = 3;           // pixels of the wide picture per pixel of the distorted one
constexpr int kLargestPicture = 4096;  // pixels

std::array<double, 9> intrinsics(const Camera& camera) {
  return {camera.focal_x,       camera.focal_y,       camera.centre_x,      camera.centre_y,     camera.distortion[0],
          camera.distortion[1], camera.distortion[2], camera.distortion[3], camera.distortion[4]};
}

struct Neighbours {  // of a place between pixels: indices of the four around it, and its shares of right and below
  std::size_t corner[4];
  float right, below;
  std::size_t nearest() const { return corner[(below >= 0.5F ? 2 : 0) + (right >= 0.5F ? 1 : 0)]; }
};

Neighbours around(const Camera& wide, float x, float y) {
  const float u = std::clamp(x - 0.5F, 0.0F, static_cast<float>(wide.width - 1));
  const float v = std::clamp(y - 0.5F, 0.0F, static_cast<float>(wide.height - 1));
  const int left = static_cast<int>(u), top = static_cast<int>(v);
  const int right = std::min(left + 1, wide.width - 1), bottom = std::min(top + 1, wide.height - 1);
  const auto index = [&](int i, int j) {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(wide.width) + static_cast<std::size_t>(i);
  };
  return {{index(left, top), index(right, top), index(left, bottom), index(right, bottom)},
          u - static_cast<float>(left),
          v - static_cast<float>(top)};
}

float between(float a, float b, float c, float d, const Neighbours& at) {
  return (a * (1 - at.right) + b * at.right) * (1 - at.below) + (c * (1 - at.right) + d * at.right) * at.below;
}

}  // namespace

bool distorts(const Camera& camera) {
  return std::any_of(camera.distortion.begin(), camera.distortion.end(), [](double k) { return k != 0; });
}

bool Lens::fits(const Camera& camera) const {
  return camera.width == camera_.width && camera.height == camera_.height && intrinsics(camera) == intrinsics(camera_);
}

Lens::Lens(const Camera& camera) : camera_(camera), wide_(camera) {
  const auto count = static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height);
  std::vector<std::optional<std::array<double, 2>>> directions(count);
  std::array<double, 2> low{0, 0}, high{0, 0};
  for (std::size_t i = 0; i < count; ++i) {
    const auto row = i / static_cast<std::size_t>(camera.width), column = i % static_cast<std::size_t>(camera.width);
    auto& direction = directions[i];
    direction = direction_of(camera, {static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5});
    if (direction && !(std::abs((*direction)[0]) < kWidest && std::abs((*direction)[1]) < kWidest)) direction.reset();
    if (!direction) continue;
    for (std::size_t k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], (*direction)[k]);
      high[k] = std::max(high[k], (*direction)[k]);
    }
  }
  const auto pixels = [](double focal, double extent) {
    return static_cast<int>(std::min<double>(std::ceil(focal * extent) + 4, kLargestPicture));
  };
  const auto focal = [](double wanted, double extent) {
    return extent > 0 ? std::min(wanted, (kLargestPicture - 4) / extent) : wanted;
  };
  wide_.distortion = {};
  wide_.focal_x = focal(kFiner * camera.focal_x, high[0] - low[0]);
  wide_.focal_y = focal(kFiner * camera.focal_y, high[1] - low[1]);
  wide_.width = pixels(wide_.focal_x, high[0] - low[0]);
  wide_.height = pixels(wide_.focal_y, high[1] - low[1]);
  wide_.centre_x = 2 - wide_.focal_x * low[0];  // two pixels of margin on each side
  wide_.centre_y = 2 - wide_.focal_y * low[1];
  sources_.reserve(count);
  for (const auto& direction : directions) {
    if (!direction) {
      sources_.push_back({-1, -1});
      continue;
    }
    sources_.push_back({static_cast<float>(wide_.focal_x * (*direction)[0] + wide_.centre_x),
                        static_cast<float>(wide_.focal_y * (*direction)[1] + wide_.centre_y)});
  }
}

// The inverse of depth is linear in a picture of a plane: from the nearest pixel it is followed to the place itself.
// Of the slopes to either side the gentler is that of the surface; the other may lead over its edge.
float Lens::depth_at(const Picture& wide, const Source& source) const {
  const int i = std::clamp(static_cast<int>(source.x), 0, wide_.width - 1);
  const int j = std::clamp(static_cast<int>(source.y), 0, wide_.height - 1);
  const auto depth = [&](int x, int y) {
    return wide
        .depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(wide_.width) + static_cast<std::size_t>(x)];
  };
  const float here = depth(i, j);
  if (here <= 0) return 0;
  const auto slope = [&](int x, int y) {  // in the direction (x, y)
    float gentlest = std::numeric_limits<float>::infinity();
    for (const int side : {-1, 1}) {
      const int u = i + side * x, v = j + side * y;
      if (u < 0 || v < 0 || u >= wide_.width || v >= wide_.height || depth(u, v) <= 0) continue;
      const float change = static_cast<float>(side) * (1 / depth(u, v) - 1 / here);
      if (std::abs(change) < std::abs(gentlest)) gentlest = change;
    }
    return std::isfinite(gentlest) ? gentlest : 0.0F;
  };
  const float right = source.x - 0.5F - static_cast<float>(i), down = source.y - 0.5F - static_cast<float>(j);
  const float inverse = 1 / here + right * slope(1, 0) + down * slope(0, 1);
  return inverse > 0 ? 1 / inverse : here;
}

void Lens::apply(const Picture& wide, Picture& picture) const {
  const std::size_t count = sources_.size();
  picture.width = camera_.width;
  picture.height = camera_.height;
  picture.rgb.assign(wide.rgb.empty() ? 0 : 3 * count, 0);
  picture.depth.assign(wide.depth.empty() ? 0 : count, 0);
  picture.instance.assign(wide.instance.empty() ? 0 : count, 0);
  picture.semantic.assign(wide.semantic.empty() ? 0 : count, 0);
  for (std::size_t i = 0; i < count; ++i) {
    const Source& source = sources_[i];
    if (source.x < 0) continue;
    const Neighbours at = around(wide_, source.x, source.y);
    if (!wide.instance.empty()) picture.instance[i] = wide.instance[at.nearest()];
    if (!wide.semantic.empty()) picture.semantic[i] = wide.semantic[at.nearest()];
    if (!wide.depth.empty()) picture.depth[i] = depth_at(wide, source);
    if (wide.rgb.empty()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto channel = [&](std::size_t corner) { return static_cast<float>(wide.rgb[3 * at.corner[corner] + k]); };
      picture.rgb[3 * i + k] =
          static_cast<std::uint8_t>(between(channel(0), channel(1), channel(2), channel(3), at) + 0.5F);
    }
  }
}

}  // namespace stampede
