#include "scripting/session/text_file.h"

#include <fstream>
#include <iterator>

#include "engine/base/error.h"

namespace stampede {

std::string read_text_file(const std::filesystem::path& path) {
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw Error(path.string(), std::filesystem::exists(path, code) ? "it is no file" : "there is no such file");
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw Error(path.string(), "it cannot be read");
  return text;
}

bool holds_text(const std::filesystem::path& path, const std::string& text) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code) && read_text_file(path) == text;
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::error_code code;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), code);
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  if (!file) throw Error(path.string(), "it cannot be written");
}

}  // namespace stampede
