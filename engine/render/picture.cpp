#include "engine/render/picture.h"

namespace stampede {

std::string_view to_string(PictureKind kind) {
  constexpr std::array<std::string_view, 4> kNames{"rgb", "depth", "instance", "semantic"};
  return kNames.at(static_cast<std::size_t>(kind));
}

std::optional<PictureKind> picture_kind_from(std::string_view name) {
  for (const PictureKind kind : kPictureKinds)
    if (to_string(kind) == name) return kind;
  return std::nullopt;
}

bool PictureKinds::has(PictureKind kind) const {
  switch (kind) {
    case PictureKind::rgb:
      return rgb;
    case PictureKind::depth:
      return depth;
    case PictureKind::instance:
      return instance;
    case PictureKind::semantic:
      return semantic;
  }
  return false;
}

}  // namespace stampede
