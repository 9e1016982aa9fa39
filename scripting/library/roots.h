// Where the scripts are.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scripting/library/library.h"

namespace stampede {

// The folder that holds tasks/, skills/ and worlds/ when nobody says otherwise: share/stampede beside the file
// (program or shared library) that this code is in, if that is installed; else the source tree it was built from.
std::filesystem::path default_root();

// `root` (empty: the default), then `paths`; later ones win. Throws Error for a folder that does not exist.
Roots make_roots(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths);

}  // namespace stampede
