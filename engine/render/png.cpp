#include "engine/render/png.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string_view>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr int kMostPixels = 4096;  // a side, of what is read

enum class Filter : std::uint8_t { none = 0, sub = 1, up = 2 };
enum class ColourType : std::uint8_t { grey = 0, rgb = 2 };

// How each kind is written: the smallest among the fast ways, of all five filters and levels 1 to 6 on drawn pictures.
struct Style {
  Filter filter;
  int level;  // of libdeflate
};
constexpr int kRgbLevel = 2;
constexpr Style kDepthStyle{Filter::up, 1};
constexpr Style kIdStyle{Filter::sub, 2};

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

// What a thread uses again for each picture: making a compressor costs more than compressing a small picture.
struct Encoder {
  std::array<std::unique_ptr<libdeflate_compressor, FreeCompressor>, 3> by_level;
  Bytes rows;                        // with filters applied, a filter's number ahead of each
  std::vector<std::uint16_t> above;  // the row before

  libdeflate_compressor* at(int level) {
    auto& compressor = by_level.at(static_cast<std::size_t>(level));
    if (!compressor) compressor.reset(libdeflate_alloc_compressor(level));
    if (!compressor) throw std::bad_alloc();
    return compressor.get();
  }
};

Encoder& encoder() {
  thread_local Encoder of_this_thread;
  return of_this_thread;
}

void put32(std::uint8_t* at, std::size_t value) {
  for (int i = 0; i < 4; ++i) at[i] = static_cast<std::uint8_t>(value >> (24 - 8 * i));
}

// Length, name, data, checksum; the data may be in place already.
void close_chunk(Bytes& png, std::size_t start) {
  const std::size_t length = png.size() - start - 8;
  put32(&png[start], length);
  png.resize(png.size() + 4);
  put32(&png[start + 8 + length], libdeflate_crc32(0, &png[start + 4], length + 4));
}

std::size_t open_chunk(Bytes& png, std::string_view name) {
  const std::size_t start = png.size();
  png.resize(start + 4);
  png.insert(png.end(), name.begin(), name.end());
  return start;
}

void put_header(Bytes& png, int width, int height, int bits, ColourType type) {
  png.assign(kSignature.begin(), kSignature.end());
  const std::size_t start = open_chunk(png, "IHDR");
  png.resize(png.size() + 13);
  put32(&png[start + 8], static_cast<std::size_t>(width));
  put32(&png[start + 12], static_cast<std::size_t>(height));
  png[start + 16] = static_cast<std::uint8_t>(bits);
  png[start + 17] = static_cast<std::uint8_t>(type);  // then deflate, adaptive filters, not interlaced: all 0
  close_chunk(png, start);
}

// `rows` are filtered and start with the filter's number each.
Bytes png_of_rows(int width, int height, int bits, ColourType type, const Bytes& rows, libdeflate_compressor* with) {
  Bytes png;
  put_header(png, width, height, bits, type);
  const std::size_t start = open_chunk(png, "IDAT"), data = png.size();
  png.resize(data + libdeflate_zlib_compress_bound(with, rows.size()));
  const std::size_t size = libdeflate_zlib_compress(with, rows.data(), rows.size(), &png[data], png.size() - data);
  png.resize(data + size);
  close_chunk(png, start);
  close_chunk(png, open_chunk(png, "IEND"));
  png.shrink_to_fit();
  return png;
}

// 16-bit values, most significant byte first, by `value_of(index)`; less what the filter predicts, byte by byte.
template <typename ValueOf>
Bytes grey_png(int width, int height, const Style& style, const ValueOf& value_of) {
  Encoder& with = encoder();
  const auto pixels = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  with.rows.resize((1 + 2 * pixels) * rows);
  with.above.assign(pixels, 0);
  std::uint8_t* at = with.rows.data();
  for (std::size_t row = 0, index = 0; row < rows; ++row) {
    *at++ = static_cast<std::uint8_t>(style.filter);
    std::uint16_t left = 0;
    for (std::uint16_t& above : with.above) {
      const std::uint16_t value = value_of(index++);
      const std::uint16_t predicted = style.filter == Filter::up ? above : style.filter == Filter::sub ? left : 0;
      *at++ = static_cast<std::uint8_t>((value >> 8) - (predicted >> 8));
      *at++ = static_cast<std::uint8_t>(value - predicted);
      above = left = value;
    }
  }
  return png_of_rows(width, height, 16, ColourType::grey, with.rows, with.at(style.level));
}

std::uint16_t depth_value(float depth) {
  const double units = static_cast<double>(depth) / kDepthUnit + 0.5;
  return units >= 1 && units < 65536 ? static_cast<std::uint16_t>(units) : std::uint16_t{0};  // not a number: 0
}

void require(bool condition, const char* what) {
  if (!condition) throw Error("picture", what, "ask the renderer for this kind");
}

[[noreturn]] void broken(const std::string& what) {
  throw Error("picture", "not a PNG file that can be read: " + what, "render it again");
}

std::uint32_t get32(const std::uint8_t* at) {
  return static_cast<std::uint32_t>(at[0]) << 24 | static_cast<std::uint32_t>(at[1]) << 16 |
         static_cast<std::uint32_t>(at[2]) << 8 | at[3];
}

// Only the chunks that make pixels: a gamma written by another program must not change depths and ids.
Bytes without_extras(std::span<const std::uint8_t> png) {
  if (png.size() < 33 || !std::equal(kSignature.begin(), kSignature.end(), png.begin())) broken("it has no header");
  Bytes bare(kSignature.begin(), kSignature.end());
  for (std::size_t at = kSignature.size(); at + 12 <= png.size();) {
    const std::size_t size = get32(&png[at]) + std::size_t{12};
    if (size > png.size() - at) break;
    const std::span<const std::uint8_t> chunk = png.subspan(at, size);
    const bool critical = (chunk[4] & 0x20) == 0;  // its name starts with a capital letter
    if (critical) bare.insert(bare.end(), chunk.begin(), chunk.end());
    if (std::equal(chunk.begin() + 4, chunk.begin() + 8, "IEND")) return bare;
    at += size;
  }
  broken("it ends too early");
}

struct OpenPng {
  png_image image{};
  Bytes bytes;
  explicit OpenPng(std::span<const std::uint8_t> png) : bytes(without_extras(png)) {
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) broken(image.message);
    if (image.width > kMostPixels || image.height > kMostPixels) {
      png_image_free(&image);
      throw Error("picture", "it has more than 4096 pixels a side", "use a smaller one");
    }
  }
  ~OpenPng() { png_image_free(&image); }
  OpenPng(const OpenPng&) = delete;
  OpenPng& operator=(const OpenPng&) = delete;
  // Anything that libpng warns of is damage here.
  void read(void* pixels) {
    if (png_image_finish_read(&image, nullptr, pixels, 0, nullptr) == 0 || image.warning_or_error != 0)
      broken(image.message);
  }
};

std::vector<std::uint16_t> read_grey(OpenPng& png) {
  constexpr std::size_t kBits = 24, kType = 25;  // of the header
  if (png.bytes[kBits] != 16 || png.bytes[kType] != 0)
    throw Error("picture", "depth and ids are PNG files of 16 bits and one channel; this is another",
                "render it again");
  png.image.format = PNG_FORMAT_LINEAR_Y;  // 16 bits as they are
  std::vector<std::uint16_t> values(std::size_t{png.image.width} * png.image.height);
  png.read(values.data());
  return values;
}

}  // namespace

Bytes png_of(int width, int height, std::span<const std::uint8_t> rgb) {
  require(width > 0 && height > 0, "a picture without pixels is no PNG file");
  const std::size_t row_size = 3 * static_cast<std::size_t>(width);
  require(rgb.size() == row_size * static_cast<std::size_t>(height), "its size does not agree with its colours");
  Encoder& with = encoder();
  with.rows.resize((row_size + 1) * static_cast<std::size_t>(height));
  std::uint8_t* at = with.rows.data();
  for (std::size_t from = 0; from < rgb.size(); from += row_size) {
    *at++ = static_cast<std::uint8_t>(Filter::none);  // flat areas: filters make more of them
    at = std::copy_n(&rgb[from], row_size, at);
  }
  return png_of_rows(width, height, 8, ColourType::rgb, with.rows, with.at(kRgbLevel));
}

Bytes to_png(const Picture& picture, PictureKind kind) {
  if (kind == PictureKind::rgb) {
    require(!picture.rgb.empty(), "it has no colours");
    return png_of(picture.width, picture.height, picture.rgb);
  }
  const std::size_t count = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  require(picture.width > 0 && picture.height > 0, "a picture without pixels is no PNG file");
  if (kind == PictureKind::depth) {
    require(picture.depth.size() == count, "it has no depth");
    return grey_png(picture.width, picture.height, kDepthStyle,
                    [&](std::size_t i) { return depth_value(picture.depth[i]); });
  }
  const std::vector<std::uint16_t>& ids = kind == PictureKind::instance ? picture.instance : picture.semantic;
  require(ids.size() == count, kind == PictureKind::instance ? "it has no instances" : "it has no classes");
  return grey_png(picture.width, picture.height, kIdStyle, [&](std::size_t i) { return ids[i]; });
}

void from_png(std::span<const std::uint8_t> png, PictureKind kind, Picture& picture) {
  OpenPng open(png);
  if (kind == PictureKind::rgb) {
    open.image.format = PNG_FORMAT_RGB;
    Bytes rgb(PNG_IMAGE_SIZE(open.image));
    open.read(rgb.data());
    picture.rgb = std::move(rgb);
  } else {
    std::vector<std::uint16_t> values = read_grey(open);
    if (kind == PictureKind::depth) {
      picture.depth.resize(values.size());
      for (std::size_t i = 0; i < values.size(); ++i) picture.depth[i] = static_cast<float>(values[i] * kDepthUnit);
    } else {
      (kind == PictureKind::instance ? picture.instance : picture.semantic) = std::move(values);
    }
  }
  picture.width = static_cast<int>(open.image.width);
  picture.height = static_cast<int>(open.image.height);
}

}  // namespace stampede
