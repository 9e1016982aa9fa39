#include "engine/base/text_file.h"

#include <fstream>

#include "engine/base/error.h"
#include "engine/base/output_file.h"
#include "engine/base/read_file.h"

namespace stampede {

std::string read_text_file(const std::filesystem::path& path) { return read_file(path); }

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
