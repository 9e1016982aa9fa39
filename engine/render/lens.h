// Pictures through a lens that distorts: a wider picture without distortion, taken apart and put together again.
#pragma once

#include <optional>
#include <vector>

#include "engine/render/picture.h"

namespace stampede {

bool distorts(const Camera& camera);

// Where each pixel of a distorted camera is found in a plain pinhole picture of the same place.
class Lens {
 public:
  explicit Lens(const Camera& camera);

  const Camera& wide() const { return wide_; }  // the pinhole camera to draw with
  bool fits(const Camera& camera) const;        // whether it is the lens of that camera

  // Colours between pixels are mixed; ids are the nearest pixel's; depth is the nearest pixel's, carried along its
  // surface to the place itself. Pixels that no direction reaches stay empty.
  void apply(const Picture& wide, Picture& picture) const;

 private:
  struct Source {
    float x, y;  // in the wide picture, pixels; x below 0: none
  };
  float depth_at(const Picture& wide, const Source& source) const;

  Camera camera_, wide_;
  std::vector<Source> sources_;
};

}  // namespace stampede
