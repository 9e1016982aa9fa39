#include "scripting/library/editor_files.h"

#include "engine/base/text_file.h"
#include "scripting/library/annotations.h"

namespace stampede {
namespace {

// Scripts run in a sandbox: what it lacks is not proposed.
constexpr const char* kSettings = R"({
  "runtime.version": "Lua 5.4",
  "runtime.builtin": {
    "coroutine": "disable", "debug": "disable", "ffi": "disable", "io": "disable", "jit": "disable", "os": "disable",
    "utf8": "disable"
  },
  "workspace.library": [".stampede"]
}
)";

}  // namespace

std::vector<TextFile> editor_files(const std::filesystem::path& folder, const Library& library) {
  std::vector<TextFile> files = {{folder / ".stampede/words.lua", word_annotations()},
                                 {folder / ".stampede/stampede.lua", field_annotations()},
                                 {folder / ".stampede/names.lua", name_annotations(library)}};
  const std::filesystem::path settings = folder / ".luarc.json";
  if (!std::filesystem::exists(settings)) files.push_back({settings, kSettings});
  return files;
}

void write_editor_files(const std::filesystem::path& folder, const Library& library) {
  for (const TextFile& file : editor_files(folder, library)) write_text_file(file.path, file.text);
}

}  // namespace stampede
