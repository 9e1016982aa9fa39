#include "engine/render/kept_views.h"

namespace stampede {
namespace {

constexpr std::size_t kMostViews = 128;
constexpr std::size_t kMostPixels = 4'000'000;  // 48 MB

}  // namespace

void KeptViews::forget() {
  views_.clear();
  pixels_ = 0;
}

KeptView* KeptViews::find(const EyeKey& key) {
  ++clock_;
  KeptView* oldest = nullptr;
  for (KeptView& view : views_) {
    if (view.key == key) {
      view.used = clock_;
      if (!view.surface.nearness.empty()) return &view;
      const std::size_t wanted = static_cast<std::size_t>(key.width) * static_cast<std::size_t>(key.height);
      if (pixels_ + wanted > kMostPixels) return nullptr;
      pixels_ += wanted;
      return &view;
    }
    if (oldest == nullptr || view.used < oldest->used) oldest = &view;
  }
  if (views_.size() < kMostViews) {
    oldest = &views_.emplace_back();
  } else {
    pixels_ -= oldest->surface.nearness.empty() ? 0 : oldest->surface.pixels();
    *oldest = {};
  }
  oldest->key = key;
  oldest->used = clock_;
  return nullptr;
}

}  // namespace stampede
