// What can be seen of a mesh file without believing it: its counts against its bytes. Inside this folder.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace stampede {

// The endings that are read, `.obj` to `.glb`, and of a file its own: small letters.
const std::vector<std::string>& mesh_endings();
std::string ending_of(const std::filesystem::path& file);

// Throws Error for an ending that is not read; for a PLY with lines, counts, numbers or corners that cannot be; for an
// STL or GLB that claims more than it holds; for a DAE that is nested deeper than kDeepestElement or declares entities.
void check_form(const std::filesystem::path& file);

inline constexpr int kDeepestElement = 256;

}  // namespace stampede
