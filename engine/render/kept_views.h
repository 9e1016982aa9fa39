// What fixed cameras see of things that stand still, kept from frame to frame.
#pragma once

#include <cstdint>
#include <vector>

#include "engine/render/pixel_surface.h"

namespace stampede {

// An eye and what is drawn for it; equal ones see the same.
struct EyeKey {
  std::array<double, 12> camera_from_world{};
  std::array<double, 6> lens{};  // focal lengths, centre (pixels), near, far (m)
  int width = 0, height = 0;
  bool coloured = false;
  friend bool operator==(const EyeKey&, const EyeKey&) = default;
};

struct KeptView {
  EyeKey key;
  PixelSurface surface;                  // empty until the eye is met again
  std::vector<std::uint64_t> contained;  // a thing: the number of the pose that it is drawn in; 0: it is not
  std::uint64_t used = 0;
};

class KeptViews {
 public:
  void forget();
  // Null the first time an eye is met, and when there is no room: then draw it as a whole.
  KeptView* find(const EyeKey& key);

 private:
  std::vector<KeptView> views_;
  std::size_t pixels_ = 0;
  std::uint64_t clock_ = 0;
};

}  // namespace stampede
