// Makes a Library: runs every file once, checks everything that can be checked without physics, collects complaints.
// Room-internal.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/library/library.h"

namespace stampede {

// Of which tasks many variations are tried, not a few.
enum class Thorough { none, named, all };

struct BuilderOptions {
  Thorough thorough = Thorough::none;
  std::vector<std::string> named = {};
  std::vector<std::string> read = {};     // tasks; none named: all
  std::vector<ScriptFile> left_out = {};  // files that are read as if they were not there

  bool is_thorough(const std::string& task) const;
};

std::shared_ptr<Library> build_library(const Roots& roots, std::vector<Error>& complaints,
                                       const BuilderOptions& options);

}  // namespace stampede
