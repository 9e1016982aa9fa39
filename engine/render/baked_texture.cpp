#include "engine/render/baked_texture.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/random.h"

namespace stampede {
namespace {

constexpr int kRepeat = 128;           // pixels of one repeat
constexpr int kLargestTexture = 4096;  // pixels of a picture

// Value noise on a lattice that repeats: four octaves, each half as strong and twice as fine.
class Noise {
 public:
  explicit Noise(int seed) : key_(RandomKey("texture").with(static_cast<std::int64_t>(seed))) {
    for (int cells = kCoarsest; cells < kRepeat / 2; cells *= 2) {
      Random random(key_.with(static_cast<std::int64_t>(cells)));
      std::vector<double> lattice(static_cast<std::size_t>(cells * cells));
      for (double& value : lattice) value = random.uniform();
      octaves_.push_back({cells, std::move(lattice)});
    }
  }

  double at(int x, int y) const {
    double sum = 0, weight = 0.5;
    for (const Octave& octave : octaves_) {
      sum += weight * smooth(octave, (x + 0.5) * octave.cells / kRepeat, (y + 0.5) * octave.cells / kRepeat);
      weight /= 2;
    }
    return std::clamp((sum - 0.5) * 1.6 + 0.5, 0.0, 1.0);  // sums of octaves crowd in the middle
  }

 private:
  static constexpr int kCoarsest = 4;
  struct Octave {
    int cells;
    std::vector<double> lattice;
  };

  static double smooth(const Octave& octave, double x, double y) {
    const int left = static_cast<int>(x), top = static_cast<int>(y);
    const auto eased = [](double t) { return t * t * (3 - 2 * t); };
    const auto value = [&](int i, int j) {
      return octave.lattice[static_cast<std::size_t>(j % octave.cells * octave.cells + i % octave.cells)];
    };
    const double s = eased(x - left), t = eased(y - top);
    const double above = value(left, top) * (1 - s) + value(left + 1, top) * s;
    const double below = value(left, top + 1) * (1 - s) + value(left + 1, top + 1) * s;
    return above * (1 - t) + below * t;
  }

  RandomKey key_;
  std::vector<Octave> octaves_;
};

// `share` of the second colour at each pixel.
template <typename Share>
Image mixed(const Texture& texture, const Share& share) {
  Image image{kRepeat, kRepeat, {}};
  const auto byte = [](double a, double b, double t) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(a + (b - a) * t, 0.0, 1.0) * 255));
  };
  const Colour &a = texture.first, &b = texture.second;
  for (int y = 0; y < kRepeat; ++y)
    for (int x = 0; x < kRepeat; ++x) {
      const double t = share(x, y);
      image.rgba.insert(image.rgba.end(),
                        {byte(a.red, b.red, t), byte(a.green, b.green, t), byte(a.blue, b.blue, t), 255});
    }
  return image;
}

const Image& checked(const Texture& texture, const std::string& name) {
  const auto refuse = [&](const std::string& what, const std::string& hint) {
    throw Error("scene", "the picture of texture '" + name + "' " + what, hint);
  };
  if (texture.image == nullptr) refuse("is missing", "load it with load_image");
  const Image& image = *texture.image;
  if (image.width < 1 || image.height < 1) refuse("is empty", "load it with load_image");
  if (image.width > kLargestTexture || image.height > kLargestTexture)
    refuse("is over " + std::to_string(kLargestTexture) + " pixels a side", "make it smaller");
  if (image.rgba.size() != 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height))
    refuse("has another number of pixels than its size says", "load it with load_image");
  return image;
}

}  // namespace

Image baked(const Texture& texture, const std::string& name) {
  constexpr int kHalf = kRepeat / 2;
  switch (texture.kind) {
    case TextureKind::image:
      return checked(texture, name);
    case TextureKind::checker:
      return mixed(texture, [](int x, int y) { return (x < kHalf) == (y < kHalf) ? 0.0 : 1.0; });
    case TextureKind::stripes:
      return mixed(texture, [](int x, int) { return x < kHalf ? 0.0 : 1.0; });
    case TextureKind::noise: {
      const Noise noise(texture.seed);
      return mixed(texture, [&](int x, int y) { return noise.at(x, y); });
    }
  }
  throw Error("scene", "texture '" + name + "' is of no known kind");
}

}  // namespace stampede
