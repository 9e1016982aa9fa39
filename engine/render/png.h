// Pictures as PNG files (ISO/IEC 15948), small and fast to make. The same pixels give the same bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/drawn_mesh.h"
#include "engine/render/picture.h"

namespace stampede {

using Bytes = std::vector<std::uint8_t>;

inline constexpr double kDepthUnit = 1e-4;  // m: depth PNGs hold 0.1 mm; 0 nothing, at most 6.5535 m

// rgb: 8 bits, 3 channels. depth: 16 bits in kDepthUnit, rounded; beyond its range 0. ids: 16 bits.
// Throws Error when the picture does not have the kind.
Bytes to_png(const Picture& picture, PictureKind kind);
void from_png(std::span<const std::uint8_t> png, PictureKind kind, Picture& picture);  // fills size and that kind

// As it is stored: real cameras' colours may be JPEG (ISO/IEC 10918-1).
void from_file(std::span<const std::uint8_t> file, PictureKind kind, Picture& picture);

Bytes png_of(int width, int height, std::span<const std::uint8_t> rgb);
// With a text in it that says who drew it; the file's first 512 bytes hold picture_mark().
Bytes marked_png(int width, int height, std::span<const std::uint8_t> rgb);
std::string picture_mark();

}  // namespace stampede
