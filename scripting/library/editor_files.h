// What an editor's Lua language server (LuaLS) needs in an author's own folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scripting/library/library.h"

namespace stampede {

struct TextFile {
  std::filesystem::path path;
  std::string text;
};

// .luarc.json, where the folder has none, and the annotations in .stampede/.
std::vector<TextFile> editor_files(const std::filesystem::path& folder, const Library& library);
void write_editor_files(const std::filesystem::path& folder, const Library& library);

}  // namespace stampede
