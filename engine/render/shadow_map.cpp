#include "engine/render/shadow_map.h"

#include <algorithm>
#include <array>

#include "engine/model/camera.h"

namespace stampede {
namespace {

constexpr double kLargeThing = 1.0;  // m: radius above which a thing only receives shadows
constexpr double kBias = 0.0015;     // m along the light

}  // namespace

ShadowView shadow_view(const Light& light, const std::vector<SceneDrawing::Ball>& balls) {
  const bool small_ones =
      std::any_of(balls.begin(), balls.end(), [](const auto& b) { return b.radius <= kLargeThing; });
  const Transform light_from_world = looking_at(Vector3::Zero(), light.direction).inverse();
  Vector3 low(-0.01, -0.01, -0.01), high = -low;
  bool first = true;
  for (const SceneDrawing::Ball& ball : balls) {
    if (small_ones && ball.radius > kLargeThing) continue;
    const Vector3 centre = light_from_world * ball.centre, reach = Vector3::Constant(ball.radius + 0.01);
    low = first ? Vector3(centre - reach) : Vector3(low.cwiseMin(centre - reach));
    high = first ? Vector3(centre + reach) : Vector3(high.cwiseMax(centre + reach));
    first = false;
  }
  const Vector3 size = high - low;
  ShadowView view;
  view.texel_m = std::max(size.x(), size.y()) / kShadowSide;
  view.eye.width = view.eye.height = kShadowSide;
  Eigen::Matrix4d clip = Eigen::Matrix4d::Identity(), map = Eigen::Matrix4d::Identity();
  for (int i = 0; i < 2; ++i) {
    clip(i, i) = 2 / size[i];
    clip(i, 3) = -(high[i] + low[i]) / size[i];
    map(i, i) = map(i, 3) = 0.5;
  }
  clip(2, 2) = -1 / size.z();  // nearer to the lamp is greater
  clip(2, 3) = high.z() / size.z();
  map(2, 3) = kBias / size.z();
  view.eye.clip_from_world = clip * light_from_world.matrix();
  view.shadow_from_world = map * view.eye.clip_from_world;
  return view;
}

ShadowMap::ShadowMap(const GlFunctions& gl) : gl_(gl) {
  gl_.GenTextures(1, &texture_);
  gl_.BindTexture(GL_TEXTURE_2D, texture_);
  gl_.TexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, kShadowSide, kShadowSide, 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                 nullptr);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const std::array<GLfloat, 4> furthest{};  // outside the map nothing is in the way
  gl_.TexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, furthest.data());
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  gl_.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_GEQUAL);
  gl_.GenFramebuffers(1, &framebuffer_);
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.FramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, texture_, 0);
  const GLenum none = GL_NONE;
  gl_.DrawBuffers(1, &none);
}

void ShadowMap::bind_target() const {
  gl_.BindFramebuffer(GL_FRAMEBUFFER, framebuffer_);
  gl_.Viewport(0, 0, kShadowSide, kShadowSide);
  const GLfloat furthest = 0;
  gl_.ClearBufferfv(GL_DEPTH, 0, &furthest);
}

}  // namespace stampede
