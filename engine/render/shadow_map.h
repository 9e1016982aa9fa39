// Depth as the lamp sees it.
#pragma once

#include <vector>

#include "engine/render/gl_functions.h"
#include "engine/render/scene_drawing.h"

namespace stampede {

inline constexpr int kShadowSide = 768;  // pixels

// The lamp as an eye, fitted around everything that throws shadows: a function of the scene and its poses alone, so
// that shadows do not depend on who looks. It is fitted around things up to 2 m wide; of wider ones
// (floors, walls), unless there is nothing else, only what lies inside the fit throws any. `texel_m` is one pixel's
// width.
struct ShadowView {
  Eye eye;
  Eigen::Matrix4d shadow_from_world = Eigen::Matrix4d::Identity();  // x, y: 0 … 1 in the map; z: as in the map
  double texel_m = 0;
};
ShadowView shadow_view(const Light& light, const std::vector<SceneDrawing::Ball>& balls);

class ShadowMap {
 public:
  explicit ShadowMap(const GlFunctions& gl);
  void bind_target() const;  // to draw into, cleared
  GLuint texture() const { return texture_; }

 private:
  const GlFunctions& gl_;
  GLuint framebuffer_ = 0, texture_ = 0;
};

}  // namespace stampede
