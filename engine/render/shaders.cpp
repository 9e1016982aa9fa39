#include "engine/render/shaders.h"

#include <string>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr const char* kVertexShader = R"(
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colour;
layout(location = 3) in uint ids;
layout(location = 4) in vec3 coordinate;
layout(location = 5) in vec4 side;
uniform mat4 clip_from_world;
#ifdef IDS
flat out uint f_ids;
#endif
#ifdef COLOURS
out vec3 f_position;
out vec3 f_normal;
flat out vec4 f_colour;
#endif
#ifdef TEXTURED
out vec3 f_coordinate;
out vec4 f_side;
#endif
#ifdef SHADOWS
uniform mat4 shadow_from_world;
uniform float shadow_texel;
out vec3 f_shadow;
#endif
void main() {
  gl_Position = clip_from_world * vec4(position, 1.0);
#ifdef IDS
  f_ids = ids;
#endif
#ifdef COLOURS
  f_position = position;
  f_normal = normal;
  f_colour = colour;
#endif
#ifdef TEXTURED
  f_coordinate = coordinate;
  f_side = side;
#endif
#ifdef SHADOWS
  // A step along the normal keeps a surface out of its own shadow, whose map knows it by steps of a texel only.
  f_shadow = (shadow_from_world * vec4(position + 1.5 * shadow_texel * normal, 1.0)).xyz;
#endif
}
)";

constexpr const char* kFragmentShader = R"(
#ifdef IDS
flat in uint f_ids;
layout(location = 1) out uint o_ids;
#endif
#ifdef COLOURS
in vec3 f_position;
in vec3 f_normal;
flat in vec4 f_colour;
layout(location = 0) out vec4 o_colour;
uniform vec3 eye;
uniform vec3 towards_light;
uniform vec3 light;      // its colour
uniform vec3 strengths;  // ambient, diffuse, specular
#endif
#ifdef TEXTURED
in vec3 f_coordinate;
in vec4 f_side;
uniform sampler2D picture;
vec3 paint() {
  vec3 a = abs(f_side.xyz);
  // The axis that the surface faces most is left out. Slopes are taken before the choice: it jumps between pixels.
  vec3 dx = dFdx(f_coordinate), dy = dFdy(f_coordinate);
  vec2 at = f_coordinate.xy, atx = dx.xy, aty = dy.xy;
  if (f_side.w < 0.5 && a.z < max(a.x, a.y)) {
    bool along_x = a.x >= a.y;
    at = along_x ? f_coordinate.yz : f_coordinate.xz;
    atx = along_x ? dx.yz : dx.xz;
    aty = along_x ? dy.yz : dy.xz;
  }
  return textureGrad(picture, at, atx, aty).rgb;
}
#endif
#ifdef SHADOWS
in vec3 f_shadow;
uniform sampler2DShadow shadow_map;
float lit() {
  vec2 step = 0.75 / vec2(textureSize(shadow_map, 0));
  vec3 at = vec3(f_shadow.xy, max(f_shadow.z, 0.0));  // behind all that the map holds: shadowed where it holds anything
  return 0.25 * (texture(shadow_map, at + vec3(-step.x, -step.y, 0.0)) +
                 texture(shadow_map, at + vec3(step.x, -step.y, 0.0)) +
                 texture(shadow_map, at + vec3(-step.x, step.y, 0.0)) +
                 texture(shadow_map, at + vec3(step.x, step.y, 0.0)));
}
#endif
void main() {
#ifdef IDS
  o_ids = f_ids;
#endif
#ifdef COLOURS
  vec3 n = normalize(gl_FrontFacing ? f_normal : -f_normal);
  float lambert = max(dot(n, towards_light), 0.0);
  // From everywhere, but more from above; a little askew, so that the sides of a box differ.
  float around = 0.82 + dot(n, vec3(0.06, -0.09, 0.18));
  vec3 halfway = normalize(normalize(eye - f_position) + towards_light);
  float shine = max(dot(n, halfway), 0.0);
  shine *= shine; shine *= shine; shine *= shine; shine *= shine; shine *= shine;
  float diffuse = strengths.y * lambert, specular = lambert > 0.0 ? strengths.z * shine : 0.0;
#ifdef SHADOWS
  float share = lit();
  diffuse *= share;
  specular *= share;
#endif
  vec3 base = f_colour.rgb;
#ifdef TEXTURED
  base *= paint();
#endif
  o_colour = vec4(light * (base * (strengths.x * around + diffuse) + specular), f_colour.a);
#endif
}
)";

GLuint compile(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint good = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (good == 0) {
    std::string log(2000, '\0');
    gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
    throw Error("renderer", "a shader does not compile: " + std::string(log.c_str()));
  }
  return shader;
}

std::string header_of(const ShaderVariant& variant) {
  std::string header = "#version 330 core\n";
  if (variant.colours) header += "#define COLOURS\n";
  if (variant.ids) header += "#define IDS\n";
  if (variant.textured) header += "#define TEXTURED\n";
  if (variant.shadows) header += "#define SHADOWS\n";
  return header;
}

}  // namespace

const Program& Programs::get(const ShaderVariant& variant) {
  const auto found = programs_.find(variant);
  if (found != programs_.end()) return found->second;
  const std::string header = header_of(variant);
  const GLuint vertex = compile(gl_, GL_VERTEX_SHADER, header + kVertexShader);
  const GLuint fragment = compile(gl_, GL_FRAGMENT_SHADER, header + kFragmentShader);
  Program program;
  program.name = gl_.CreateProgram();
  gl_.AttachShader(program.name, vertex);
  gl_.AttachShader(program.name, fragment);
  gl_.LinkProgram(program.name);
  gl_.DeleteShader(vertex);
  gl_.DeleteShader(fragment);
  GLint good = 0;
  gl_.GetProgramiv(program.name, GL_LINK_STATUS, &good);
  if (good == 0) throw Error("renderer", "the shaders do not link");
  const auto place = [&](const char* name) { return gl_.GetUniformLocation(program.name, name); };
  program.clip_from_world = place("clip_from_world");
  program.eye = place("eye");
  program.towards_light = place("towards_light");
  program.light = place("light");
  program.strengths = place("strengths");
  program.shadow_from_world = place("shadow_from_world");
  program.shadow_texel = place("shadow_texel");
  program.shadow_map = place("shadow_map");
  program.picture = place("picture");
  return programs_.emplace(variant, program).first->second;
}

}  // namespace stampede
