#include "engine/base/text_file.h"

#include <fstream>

#include "engine/base/error.h"
#include "engine/base/output_file.h"

namespace stampede {

std::string read_text_file(const std::filesystem::path& path, std::uintmax_t most_bytes) {
  constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
  std::string text = read_file(path, most_bytes);
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
  return text;
}

bool holds_text(const std::filesystem::path& path, const std::string& text) {
  std::error_code code;
  return std::filesystem::is_regular_file(path, code) && read_text_file(path) == text;
}

void write_text_file(const std::filesystem::path& path, const std::string& text) {
  std::error_code code;
  if (path.has_parent_path()) std::filesystem::create_directories(path.parent_path(), code);
  OutputFile file(path, {"a text", {}, false}, {});
  file.write(text);
  file.finish();
}

}  // namespace stampede
