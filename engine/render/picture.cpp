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

namespace {
bool PictureKinds::*member_of(PictureKind kind) {
  constexpr std::array kMembers{&PictureKinds::rgb, &PictureKinds::depth, &PictureKinds::instance,
                                &PictureKinds::semantic};
  return kMembers.at(static_cast<std::size_t>(kind));
}
}  // namespace

bool PictureKinds::has(PictureKind kind) const { return this->*member_of(kind); }
void PictureKinds::add(PictureKind kind) { this->*member_of(kind) = true; }

}  // namespace stampede
