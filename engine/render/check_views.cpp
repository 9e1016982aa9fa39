#include "engine/render/check_views.h"

#include <string>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr int kLargestSide = 4096;  // pixels

}  // namespace

void check(const Camera& camera) {
  const std::string where = "camera " + camera.name;
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargestSide || camera.height > kLargestSide)
    throw Error(where,
                "a picture of " + std::to_string(camera.width) + " x " + std::to_string(camera.height) + " pixels",
                "ask for 1 to " + std::to_string(kLargestSide) + " a side");
  if (!(camera.focal_x > 0 && camera.focal_y > 0)) throw Error(where, "its focal lengths are not positive");
  if (!(camera.near_m > 0 && camera.far_m > camera.near_m))
    throw Error(where, "its near and far are not in order", "0 < near < far, in m");
}

void check(const DrawOptions& options) {
  if (options.samples < 1 || options.samples > 4)
    throw Error("renderer", "cannot draw " + std::to_string(options.samples) + " samples", "ask for 1 to 4 a side");
}

}  // namespace stampede
