// What a camera sees, as plain arrays.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/geometry/transform.h"
#include "engine/model/scene.h"

namespace stampede {

enum class PictureKind { rgb, depth, instance, semantic };
inline constexpr std::array kPictureKinds{PictureKind::rgb, PictureKind::depth, PictureKind::instance,
                                          PictureKind::semantic};
std::string_view to_string(PictureKind kind);
std::optional<PictureKind> picture_kind_from(std::string_view name);

struct PictureKinds {  // which of them are wanted
  bool rgb = true, depth = true, instance = true, semantic = true;
  static PictureKinds none() { return {false, false, false, false}; }
  bool has(PictureKind kind) const;
  void add(PictureKind kind);
};

// Shapes: height x width, rows from the top; kinds that were not asked for are empty.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;        // 3 a pixel
  std::vector<float> depth;             // m along z of the camera; 0: nothing between near and far
  std::vector<std::uint16_t> instance;  // MaskEntry::instance; 0: background
  std::vector<std::uint16_t> semantic;  // MaskEntry::semantic; 0: background
};

// How many pixels show each instance, by its number; those of the background are left out.
std::vector<std::pair<int, std::int64_t>> visible_pixels(const Picture& picture);

// A camera at one moment.
struct View {
  Camera camera;
  Transform world_from_camera = Transform::Identity();
};

}  // namespace stampede
