// The inner loops of the software renderer: triangles into surfaces, surfaces into colours. Written once over eight
// lanes and compiled for each set of instructions; the same bytes on every processor.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "engine/render/scene_drawing.h"

namespace stampede {

inline constexpr std::int32_t kNoTriangle = 0x7fffffff;  // greater than any: a tie goes to the lesser number

// What an eye sees, before it has colours. Shapes: height x width, rows from the top, and kLanes more that are written
// with what they hold already.
struct SurfaceView {
  int width = 0, height = 0;
  float* nearness = nullptr;         // 1 / m along z of the camera; in a shadow map: 0 far … 1 at the lamp
  std::int32_t* triangle = nullptr;  // of the SceneDrawing; null: not wanted
  std::uint32_t* colours = nullptr;  // red in the lowest byte; null: none
};

// Room for what becomes of a thing's corners, each for all of them and padded to whole lanes.
struct CornersInEye {
  float *x = nullptr, *y = nullptr, *z = nullptr;  // in the eye's frame
  std::int32_t *column = nullptr, *row = nullptr;  // 1/256 pixels, from the middle of the first pixel
  std::int32_t* outside = nullptr;                 // not 0: cannot be projected as it is
};

inline constexpr int kShadowBorder = 6;  // pixels

// Row by row: m = [turn | shift].
using Rows = std::array<float, 12>;

struct ThingInEye {
  const TessellationCache::Entry* entry = nullptr;
  Rows eye_from_shape{};  // in a shadow map: pixels, pixels, nearness
  std::int32_t first_triangle = 0;
  bool two_sided = false;
};

struct PinholeOfEye {
  float focal_x = 0, focal_y = 0, centre_x = 0, centre_y = 0;  // pixels
  float near = 0;                                              // m
};

// A picture that repeats, each level half as large as the one before.
struct TextureLevel {
  int width = 0, height = 0;
  const std::uint32_t* texels = nullptr;  // red in the lowest byte
};
struct TextureLevels {
  const TextureLevel* levels = nullptr;
  int count = 0;
};

// A thing as its colours need it, all in the shape's own frame, so that corners and normals stay as they are.
struct ThingPaint {
  const TessellationCache::Entry* entry = nullptr;
  std::int32_t first_triangle = 0;
  std::array<double, 3> eye{};
  std::array<std::array<double, 3>, 3> ray{};  // of the first pixel's middle, and a step right, down; z of camera: 1
  std::array<float, 3> towards_light{}, around{};  // the latter: how much more comes from there
  std::array<float, 3> colour{};
  float alpha = 1;
  float texture_scale = 1;   // repeats per m, where the mesh has no coordinates of its own
  TextureLevels texture;     // count 0: plain
  Rows shadow_from_shape{};  // texels, texels, nearness
};

struct LampPaint {
  std::array<float, 3> colour{};
  float ambient = 0, diffuse = 0, specular = 0;
  const float* shadow_map = nullptr;  // null: no shadows; the outermost kShadowBorder pixels are 0: nothing in the way
  int shadow_side = 0;                // pixels, with the border
  float shadow_offset = 0;            // m along the normal
};

// How the normal of a triangle changes over the picture, up to a positive factor. A frame's scratch, one a triangle.
struct NormalPlane {
  std::array<float, 3> first{}, right{}, down{};
  std::uint32_t stamp = 0;  // of the picture that it was made for
};

// What tint paints.
struct TintJob {
  const ThingPaint& thing;
  const LampPaint& lamp;
};

// What shade paints: pixels whose triangle belongs to a thing with `wanted`.
struct PaintJob {
  const std::int32_t* thing_of_triangle = nullptr;
  const ThingPaint* things = nullptr;
  const std::uint8_t* wanted = nullptr;
  LampPaint lamp;
  NormalPlane* normals = nullptr;
  std::uint32_t stamp = 0;
};

struct PixelKernels {
  // Nearer ones win; of equally near ones the lesser number. So no order of drawing shows.
  void (*fill)(const SurfaceView&, const PinholeOfEye&, const ThingInEye&, const CornersInEye&);
  void (*fill_shadow)(const SurfaceView&, const ThingInEye&, const CornersInEye&);
  void (*shade)(const SurfaceView&, const PaintJob&);
  // Tints what lies behind, triangle by triangle, and leaves all but colours as it is.
  void (*tint)(const SurfaceView&, const PinholeOfEye&, const ThingInEye&, const CornersInEye&, const TintJob&);
  // What a picture holds, one value a pixel: three bytes; m, 0 where nothing is; and the low and high half of the ids
  // of triangles, 0 where nothing is (null: not wanted).
  void (*write_colours)(const SurfaceView&, std::uint8_t* rgb);
  void (*write_depth)(const SurfaceView&, float* depth);
  void (*write_ids)(const SurfaceView&, const std::uint32_t* ids, std::uint16_t* low, std::uint16_t* high);
};

const PixelKernels& plain_pixel_kernels();
const PixelKernels* avx2_pixel_kernels();  // null where the processor has none
const PixelKernels& pixel_kernels();       // the fastest that may be used, see may_use_avx2

}  // namespace stampede
