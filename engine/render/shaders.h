// The shaders: one small program, in as many variants as there are things to leave out.
#pragma once

#include <map>

#include "engine/render/gl_functions.h"

namespace stampede {

struct ShaderVariant {
  bool colours = false, ids = false, textured = false, shadows = false;
  friend auto operator<=>(const ShaderVariant&, const ShaderVariant&) = default;
};

struct Program {
  GLuint name = 0;
  GLint clip_from_world = -1, eye = -1, towards_light = -1, light = -1, strengths = -1, shadow_from_world = -1,
        shadow_texel = -1, shadow_map = -1, picture = -1;
};

// Where the shaders expect a corner's values.
enum Attribute : GLuint { kPosition, kNormal, kColour, kIds, kCoordinate, kSide };
inline constexpr GLint kPictureUnit = 0, kShadowUnit = 1;

class Programs {
 public:
  explicit Programs(const GlFunctions& gl) : gl_(gl) {}
  const Program& get(const ShaderVariant& variant);

 private:
  const GlFunctions& gl_;
  std::map<ShaderVariant, Program> programs_;
};

}  // namespace stampede
