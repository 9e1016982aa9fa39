#include "engine/render/png.h"

#include <libdeflate.h>
#include <png.h>

#include <algorithm>
#include <memory>
#include <new>
#include <string_view>

#include "engine/base/error.h"
#include "engine/geometry/image.h"
#include "engine/render/picture_deflate.h"

namespace stampede {
namespace {

constexpr std::array<std::uint8_t, 8> kSignature{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
constexpr int kMostPixels = 4096;  // a side, of what is read

enum class Filter : std::uint8_t { none = 0, sub = 1, up = 2 };
enum class ColourType : std::uint8_t { grey = 0, rgb = 2 };

// Of all five filters, levels 1 to 6 and our own compression, on drawn pictures: those that are both fast and small.
// Colours change little from pixel to pixel, depth little from row to row, and ids repeat.
constexpr int kLevel = 1;  // of libdeflate

struct FreeCompressor {
  void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

// What a thread uses again for each picture: making a compressor costs more than compressing a small picture.
struct Encoder {
  std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor{libdeflate_alloc_compressor(kLevel)};
  PictureDeflate own;
  Bytes rows;                         // with filters applied, a filter's number ahead of each
  std::vector<std::uint16_t> values;  // of depth
  Bytes packed;                       // larger than most pictures come out

  Encoder() {
    if (!compressor) throw std::bad_alloc();
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

struct PngHeader {
  int width = 0, height = 0, bits = 8;
  ColourType type = ColourType::grey;
};

void put_header(Bytes& png, const PngHeader& header) {
  png.assign(kSignature.begin(), kSignature.end());
  const std::size_t start = open_chunk(png, "IHDR");
  png.resize(png.size() + 13);
  put32(&png[start + 8], static_cast<std::size_t>(header.width));
  put32(&png[start + 12], static_cast<std::size_t>(header.height));
  png[start + 16] = static_cast<std::uint8_t>(header.bits);
  png[start + 17] = static_cast<std::uint8_t>(header.type);  // then deflate, adaptive filters, not interlaced: all 0
  close_chunk(png, start);
}

// Puts the compressed rows of the encoder behind what it has packed.
using Compress = void (*)(const PngHeader& header, Encoder& with);

void compress_smooth(const PngHeader&, Encoder& with) {
  Bytes& png = with.packed;
  const std::size_t data = png.size();
  png.resize(data + libdeflate_zlib_compress_bound(with.compressor.get(), with.rows.size()));
  png.resize(data + libdeflate_zlib_compress(with.compressor.get(), with.rows.data(), with.rows.size(), &png[data],
                                             png.size() - data));
}

void compress_ids(const PngHeader& header, Encoder& with) {
  with.own.add_stream(with.rows, with.rows.size() / static_cast<std::size_t>(header.height), sizeof(std::uint16_t),
                      with.packed);
}

// The rows of the encoder, which are filtered and start with the filter's number each.
Bytes png_of_rows(const PngHeader& header, Encoder& with, Compress compress) {
  Bytes& png = with.packed;
  put_header(png, header);
  const std::size_t start = open_chunk(png, "IDAT");
  compress(header, with);
  close_chunk(png, start);
  close_chunk(png, open_chunk(png, "IEND"));
  return {png.begin(), png.end()};
}

// 16-bit values, most significant byte first; less those above, byte by byte, or as they are.
void put_values(std::span<const std::uint16_t> values, std::size_t width, Filter filter, Bytes& rows) {
  rows.resize(2 * values.size() + values.size() / width);
  std::uint8_t* at = rows.data();
  for (std::size_t row = 0; row < values.size(); row += width) {
    *at++ = static_cast<std::uint8_t>(filter);
    const std::uint16_t* value = &values[row];
    if (filter == Filter::up && row > 0) {
      const std::uint16_t* above = value - width;
      for (std::size_t i = 0; i < width; ++i) {
        at[2 * i] = static_cast<std::uint8_t>((value[i] >> 8) - (above[i] >> 8));
        at[2 * i + 1] = static_cast<std::uint8_t>(value[i] - above[i]);
      }
    } else {
      for (std::size_t i = 0; i < width; ++i) {
        at[2 * i] = static_cast<std::uint8_t>(value[i] >> 8);
        at[2 * i + 1] = static_cast<std::uint8_t>(value[i]);
      }
    }
    at += 2 * width;
  }
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
    *at++ = static_cast<std::uint8_t>(Filter::sub);
    const std::uint8_t* row = &rgb[from];
    std::copy_n(row, 3, at);
    for (std::size_t i = 3; i < row_size; ++i) at[i] = static_cast<std::uint8_t>(row[i] - row[i - 3]);
    at += row_size;
  }
  return png_of_rows({width, height, 8, ColourType::rgb}, with, compress_smooth);
}

std::string picture_mark() { return std::string("tEXtSoftware\0stampede", 21); }

Bytes marked_png(int width, int height, std::span<const std::uint8_t> rgb) {
  Bytes png = png_of(width, height, rgb), chunk;
  const std::size_t start = open_chunk(chunk, "");
  const std::string mark = picture_mark();
  chunk.insert(chunk.end(), mark.begin(), mark.end());
  close_chunk(chunk, start);
  constexpr std::ptrdiff_t kHeader = 8 + 12 + 13;  // the signature and IHDR
  png.insert(png.begin() + kHeader, chunk.begin(), chunk.end());
  return png;
}

Bytes to_png(const Picture& picture, PictureKind kind) {
  if (kind == PictureKind::rgb) {
    require(!picture.rgb.empty(), "it has no colours");
    return png_of(picture.width, picture.height, picture.rgb);
  }
  const auto width = static_cast<std::size_t>(picture.width);
  const std::size_t count = width * static_cast<std::size_t>(picture.height);
  require(picture.width > 0 && picture.height > 0, "a picture without pixels is no PNG file");
  const PngHeader grey{picture.width, picture.height, 16, ColourType::grey};
  Encoder& with = encoder();
  if (kind == PictureKind::depth) {
    require(picture.depth.size() == count, "it has no depth");
    with.values.resize(count);
    std::transform(picture.depth.begin(), picture.depth.end(), with.values.begin(), depth_value);
    put_values(with.values, width, Filter::up, with.rows);
    return png_of_rows(grey, with, compress_smooth);
  }
  const std::vector<std::uint16_t>& ids = kind == PictureKind::instance ? picture.instance : picture.semantic;
  require(ids.size() == count, kind == PictureKind::instance ? "it has no instances" : "it has no classes");
  put_values(ids, width, Filter::none, with.rows);
  return png_of_rows(grey, with, compress_ids);
}

void from_file(std::span<const std::uint8_t> file, PictureKind kind, Picture& picture) {
  if (kind != PictureKind::rgb || file.size() < 3 || file[0] != 0xff || file[1] != 0xd8)
    return from_png(file, kind, picture);
  const Image image = image_from_bytes({reinterpret_cast<const char*>(file.data()), file.size()}, "picture");
  picture.width = image.width, picture.height = image.height;
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  picture.rgb.resize(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) std::copy_n(&image.rgba[4 * i], 3, &picture.rgb[3 * i]);
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
