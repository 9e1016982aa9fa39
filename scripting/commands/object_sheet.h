// A page of pictures of objects.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/output_file.h"
#include "scripting/library/library.h"

namespace stampede::program {

// Each object file by itself, as large as fits, with its name, size and mass. Throws Error for bad scripts and where
// the file cannot be written.
void draw_objects(std::shared_ptr<const Library> library, const std::vector<std::string>& names,
                  const std::filesystem::path& file, const OutputRules& rules);

}  // namespace stampede::program
