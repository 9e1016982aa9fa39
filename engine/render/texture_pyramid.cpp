#include "engine/render/texture_pyramid.h"

#include <algorithm>

namespace stampede {
namespace {

std::vector<std::uint32_t> words_of(const Image& image) {
  std::vector<std::uint32_t> words(image.rgba.size() / 4);
  for (std::size_t i = 0; i < words.size(); ++i)
    for (std::size_t k = 0; k < 4; ++k) words[i] |= static_cast<std::uint32_t>(image.rgba[4 * i + k]) << (8 * k);
  return words;
}

// The mean of what a smaller pixel covers: two a side, three of odd sizes, where neighbours share the middle one.
struct Covered {
  int begin, end;
  Covered(int i, int size, int smaller) : begin(i * size / smaller), end(((i + 1) * size + smaller - 1) / smaller) {}
};

std::vector<std::uint32_t> halved(const TextureLevel& from, const TextureLevel& to) {
  std::vector<std::uint32_t> words;
  for (int y = 0; y < to.height; ++y)
    for (int x = 0; x < to.width; ++x) {
      const Covered across(x, from.width, to.width), along(y, from.height, to.height);
      std::array<std::uint32_t, 4> sums{};
      for (int v = along.begin; v < along.end; ++v)
        for (int u = across.begin; u < across.end; ++u)
          for (std::size_t k = 0; k < 4; ++k) sums[k] += from.texels[v * from.width + u] >> (8 * k) & 255;
      const auto count = static_cast<std::uint32_t>((along.end - along.begin) * (across.end - across.begin));
      std::uint32_t word = 0;
      for (std::size_t k = 0; k < 4; ++k) word |= (sums[k] + count / 2) / count << (8 * k);
      words.push_back(word);
    }
  return words;
}

}  // namespace

TexturePyramid::TexturePyramid(const Image& image) {
  texels_.push_back(words_of(image));
  levels_.push_back({image.width, image.height, texels_.back().data()});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const TextureLevel from = levels_.back();
    TextureLevel to{std::max(1, from.width / 2), std::max(1, from.height / 2), nullptr};
    texels_.push_back(halved(from, to));
    to.texels = texels_.back().data();
    levels_.push_back(to);
  }
}

}  // namespace stampede
