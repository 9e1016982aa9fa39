// clang-format off
#include <cstdio>  // jpeglib.h needs it first
#include <jpeglib.h>
// clang-format on

#include "tests/engine/geometry/mesh_files.h"

using namespace stampede;
using Catch::Contains;

namespace {

std::string jpeg_bytes(unsigned width, unsigned height, std::array<unsigned char, 3> colour) {
  jpeg_compress_struct info{};
  jpeg_error_mgr errors{};
  info.err = jpeg_std_error(&errors);
  jpeg_create_compress(&info);
  unsigned char* memory = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&info, &memory, &size);
  info.image_width = width;
  info.image_height = height;
  info.input_components = 3;
  info.in_color_space = JCS_RGB;
  jpeg_set_defaults(&info);
  jpeg_set_quality(&info, 95, TRUE);
  jpeg_start_compress(&info, TRUE);
  std::vector<unsigned char> row;
  for (unsigned u = 0; u < width; ++u) row.insert(row.end(), colour.begin(), colour.end());
  for (unsigned char* at = row.data(); info.next_scanline < height;) jpeg_write_scanlines(&info, &at, 1);
  jpeg_finish_compress(&info);
  std::string bytes(reinterpret_cast<char*>(memory), size);
  jpeg_destroy_compress(&info);
  free(memory);
  return bytes;
}

std::string decoding_complaint(const TemporaryFolder& folder, const std::string& name, const std::string& bytes) {
  const auto file = folder.put(name, bytes);
  return complaint(file.string(), [&] { (void)load_image(file); });
}

}  // namespace

TEST_CASE("a PNG picture has the pixels that were written, from the top row on") {
  const TemporaryFolder folder;
  const Image image = load_image(folder.put("four.png", png_bytes(2, 2, kFourColours)));
  CHECK(image == Image{2, 2, kFourColours});
}

TEST_CASE("a picture is known by its content, not by its ending") {
  const TemporaryFolder folder;
  CHECK(load_image(folder.put("four.jpg", png_bytes(2, 2, kFourColours))).width == 2);
  CHECK(load_image(folder.put("flat", jpeg_bytes(9, 5, {10, 20, 30}))).width == 9);
}

TEST_CASE("a JPEG picture of one colour has this colour, opaque") {
  const TemporaryFolder folder;
  const Image image = load_image(folder.put("flat.jpg", jpeg_bytes(20, 11, {200, 100, 50})));
  CHECK(image.width == 20);
  CHECK(image.height == 11);
  REQUIRE(image.rgba.size() == 20 * 11 * 4);
  const std::array<int, 4> expected{200, 100, 50, 255};
  for (std::size_t i = 0; i < image.rgba.size(); ++i) {
    const int difference = std::abs(image.rgba[i] - expected.at(i % 4));
    if (difference > (i % 4 == 3 ? 0 : 3)) FAIL("pixel " << i / 4 << " is off by " << difference);
  }
}

TEST_CASE("missing, broken and huge pictures are errors with the file and a cure") {
  const TemporaryFolder folder;
  CHECK_THAT(complaint("none.png", [&] { (void)load_image(folder / "none.png"); }), Contains("no such picture"));
  CHECK_THAT(decoding_complaint(folder, "a.png", ""), Contains("empty"));
  CHECK_THAT(decoding_complaint(folder, "b.png", "GIF89a"), Contains("neither PNG nor JPEG"));
  const std::string png = png_bytes(2, 2, kFourColours), jpeg = jpeg_bytes(64, 64, {1, 2, 3});
  CHECK_THAT(decoding_complaint(folder, "c.png", png.substr(0, png.size() / 2)), Contains("not a picture"));
  CHECK_THAT(decoding_complaint(folder, "d.jpg", jpeg.substr(0, jpeg.size() / 2)), Contains("not a picture"));
  CHECK_THAT(decoding_complaint(folder, "e.jpg", jpeg.substr(0, 4)), Contains("not a picture"));
  std::string damaged = png;
  damaged[png.size() / 2] ^= 0x55;
  CHECK_THAT(decoding_complaint(folder, "f.png", damaged), Contains("not a picture"));
  CHECK_THAT(decoding_complaint(folder, "g.jpg", jpeg_bytes(4097, 1, {1, 2, 3})), Contains("4097 x 1"));
  CHECK_THAT(decoding_complaint(folder, "h.png", png_bytes(1, 5000, std::vector<std::uint8_t>(20000))),
             Contains("1 x 5000"));
}
