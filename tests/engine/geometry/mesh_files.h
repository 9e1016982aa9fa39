// Small files in a folder of their own.
#pragma once

#include <png.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/drawn_mesh.h"

namespace stampede {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "stampede_drawn_XXXXXX").string();
    REQUIRE(mkdtemp(name.data()) != nullptr);
    path_ = name;
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::filesystem::path put(const std::string& name, const std::string& bytes) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << bytes;
    return path_ / name;
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// By the divergence theorem: positive when closed and seen counter-clockwise from outside.
inline double volume(const DrawnMesh& mesh) {
  const auto corner = [&](std::uint32_t i) {
    return Vector3(mesh.positions[i][0], mesh.positions[i][1], mesh.positions[i][2]);
  };
  double sum = 0;
  for (const auto& [a, b, c] : mesh.triangles) sum += corner(a).dot(corner(b).cross(corner(c)));
  return sum / 6;
}

// Four bytes a pixel.
inline std::string png_bytes(int width, int height, const std::vector<std::uint8_t>& rgba) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGBA;
  std::string bytes(PNG_IMAGE_PNG_SIZE_MAX(image), '\0');
  png_alloc_size_t size = bytes.size();
  REQUIRE(png_image_write_to_memory(&image, bytes.data(), &size, 0, rgba.data(), 0, nullptr) != 0);
  bytes.resize(size);
  return bytes;
}

// Two by two: red, green; blue, half transparent white.
inline const std::vector<std::uint8_t> kFourColours{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 255, 255, 255, 128};

// What `action` complains of; errors must name `where` and offer a cure.
inline std::string complaint(const std::string& where, const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    CHECK_THAT(error.where(), Catch::Contains(where));
    CHECK_FALSE(error.hint().empty());
    return error.message();
  }
  return "accepted";
}

}  // namespace stampede
