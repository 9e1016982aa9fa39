// A picture that repeats, with all smaller ones that distance asks for.
#pragma once

#include <vector>

#include "engine/geometry/drawn_mesh.h"
#include "engine/render/pixel_kernels.h"

namespace stampede {

class TexturePyramid {
 public:
  explicit TexturePyramid(const Image& image);  // at least one pixel
  TextureLevels levels() const { return {levels_.data(), static_cast<int>(levels_.size())}; }

 private:
  std::vector<std::vector<std::uint32_t>> texels_;
  std::vector<TextureLevel> levels_;
};

}  // namespace stampede
