#include "engine/render/picture.h"

#include <algorithm>

#include "engine/base/enum_names.h"

namespace stampede {

namespace {
constexpr std::array<std::string_view, 4> kPictureNames{"rgb", "depth", "instance", "semantic"};

bool PictureKinds::*member_of(PictureKind kind) {
  constexpr std::array kMembers{&PictureKinds::rgb, &PictureKinds::depth, &PictureKinds::instance,
                                &PictureKinds::semantic};
  return kMembers.at(static_cast<std::size_t>(kind));
}
}  // namespace

std::string_view to_string(PictureKind kind) { return enum_name(kPictureNames, kind); }
std::optional<PictureKind> picture_kind_from(std::string_view name) {
  return enum_from<PictureKind>(kPictureNames, name);
}

bool PictureKinds::has(PictureKind kind) const { return this->*member_of(kind); }
void PictureKinds::add(PictureKind kind) { this->*member_of(kind) = true; }

std::vector<std::pair<int, std::int64_t>> visible_pixels(const Picture& picture) {
  std::vector<std::pair<int, std::int64_t>> visible;
  const std::vector<std::uint16_t>& ids = picture.instance;
  for (std::size_t i = 0; i < ids.size();) {
    const std::size_t begin = i;
    while (i < ids.size() && ids[i] == ids[begin]) ++i;
    if (ids[begin] == 0) continue;
    auto found = std::find_if(visible.begin(), visible.end(), [&](const auto& one) { return one.first == ids[begin]; });
    if (found == visible.end()) found = visible.insert(visible.end(), {ids[begin], 0});
    found->second += static_cast<std::int64_t>(i - begin);
  }
  std::sort(visible.begin(), visible.end());
  return visible;
}

}  // namespace stampede
