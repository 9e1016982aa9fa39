// Which file a URDF means.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/file_scope.h"

namespace stampede {

// `name` as a URDF has it: a path relative to the URDF; file://PATH; package://NAME/PATH or model://NAME/PATH, where
// NAME is a folder above the URDF, or beside one of these: of that name, or with a package.xml (model.config) that says
// it; or else any folder above it that has PATH. All inside of the scope. Backslashes are slashes where
// there is no such file as it is written; a '%' has been refused before (urdf.cpp).
// Throws Error, with where it was looked for; a file that is not there passes where the name is a path.
std::filesystem::path file_named(const std::string& name, const std::filesystem::path& urdf, const FileScope& scope);

}  // namespace stampede
