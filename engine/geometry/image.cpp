#include "engine/geometry/image.h"

// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on
#include <png.h>

#include <csetjmp>
#include <fstream>
#include <iterator>

#include "engine/base/error.h"

namespace stampede {
namespace {

constexpr unsigned kMostPixels = 4096;  // a side

[[noreturn]] void broken(const std::string& where, const std::string& what) {
  throw Error(where, "not a picture that can be read: " + what, "write it again as PNG or JPEG");
}

void check_size(unsigned width, unsigned height, const std::string& where) {
  if (width == 0 || height == 0) broken(where, "it has no pixels");
  if (width > kMostPixels || height > kMostPixels)
    throw Error(where,
                "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels; at most 4096 a side are allowed",
                "scale it down");
}

// What libpng and libjpeg hold is given back on every way out.
struct PngReader {
  png_image image{};
  PngReader() { image.version = PNG_IMAGE_VERSION; }
  ~PngReader() { png_image_free(&image); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
};

Image png_picture(std::string_view bytes, const std::string& where) {
  PngReader reader;
  if (png_image_begin_read_from_memory(&reader.image, bytes.data(), bytes.size()) == 0)
    broken(where, reader.image.message);
  check_size(reader.image.width, reader.image.height, where);
  reader.image.format = PNG_FORMAT_RGBA;
  Image picture{static_cast<int>(reader.image.width), static_cast<int>(reader.image.height), {}};
  picture.rgba.resize(PNG_IMAGE_SIZE(reader.image));
  if (png_image_finish_read(&reader.image, nullptr, picture.rgba.data(), 0, nullptr) == 0)
    broken(where, reader.image.message);
  return picture;
}

// libjpeg reports errors by a call that must not return.
struct JpegReader {
  jpeg_decompress_struct info{};
  jpeg_error_mgr errors{};
  std::jmp_buf failed{};
  char message[JMSG_LENGTH_MAX] = "";

  JpegReader() {
    info.err = jpeg_std_error(&errors);
    info.client_data = this;
    errors.error_exit = [](j_common_ptr common) {
      auto* const self = static_cast<JpegReader*>(common->client_data);
      self->errors.format_message(common, self->message);
      std::longjmp(self->failed, 1);
    };
    errors.emit_message = [](j_common_ptr common, int level) {
      if (level < 0) common->err->error_exit(common);  // damage that libjpeg would paint over
    };
  }
  ~JpegReader() { jpeg_destroy_decompress(&info); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  // Nothing with a destructor lives in these two: a longjmp would leave it out.
  bool start(const unsigned char* bytes, unsigned long size) {
    if (setjmp(failed) != 0) return false;
    jpeg_create_decompress(&info);
    jpeg_mem_src(&info, bytes, size);
    jpeg_read_header(&info, TRUE);
    info.out_color_space = JCS_RGB;
    jpeg_calc_output_dimensions(&info);
    return true;
  }
  bool read(unsigned char* row, unsigned char* rgba) {
    if (setjmp(failed) != 0) return false;
    jpeg_start_decompress(&info);
    while (info.output_scanline < info.output_height) {
      unsigned char* at = rgba + std::size_t{4} * info.output_width * info.output_scanline;
      jpeg_read_scanlines(&info, &row, 1);
      for (unsigned u = 0; u < info.output_width; ++u, at += 4) {
        for (unsigned k = 0; k < 3; ++k) at[k] = row[3 * u + k];
        at[3] = 255;
      }
    }
    jpeg_finish_decompress(&info);
    return true;
  }
};

Image jpeg_picture(std::string_view bytes, const std::string& where) {
  JpegReader reader;
  if (!reader.start(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) broken(where, reader.message);
  const unsigned width = reader.info.output_width, height = reader.info.output_height;
  check_size(width, height, where);
  Image picture{static_cast<int>(width), static_cast<int>(height), {}};
  picture.rgba.resize(std::size_t{4} * width * height);
  std::vector<unsigned char> row(std::size_t{3} * width);
  if (!reader.read(row.data(), picture.rgba.data())) broken(where, reader.message);
  return picture;
}

}  // namespace

// By content: endings lie, and pictures inside of mesh files have none.
Image image_from_bytes(std::string_view bytes, const std::string& where) {
  if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return png_picture(bytes, where);
  if (bytes.starts_with("\xff\xd8\xff")) return jpeg_picture(bytes, where);
  broken(where, bytes.empty() ? "it is empty" : "it is neither PNG nor JPEG");
}

Image load_image(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(file.string(), "there is no such picture",
                "check the name; it is looked for beside the file that uses it");
  std::ifstream in(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (!in) throw Error(file.string(), "the picture cannot be read", "check its permissions");
  return image_from_bytes(bytes, file.string());
}

}  // namespace stampede
