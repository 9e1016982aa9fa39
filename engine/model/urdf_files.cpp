#include "engine/model/urdf_files.h"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <optional>
#include <vector>

#include "engine/base/error.h"

namespace stampede {
namespace fs = std::filesystem;
namespace {

constexpr const char* kNameCure =
    "name it by a path relative to the URDF, package://NAME/PATH or file://PATH, inside the roots";

std::string without_backslashes(std::string name) {  // written on Windows
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

// As written, where that is there; else as it was meant.
fs::path read_as(const fs::path& folder, const std::string& name) {
  const fs::path written = folder / name;
  return is_file(written) ? written : folder / without_backslashes(name);
}

// `<name>arm</name>` of a package's own description.
bool says_name(const fs::path& description, const std::string& name) {
  if (!is_file(description)) return false;
  std::ifstream in(description, std::ios::binary);
  std::string text(std::size_t{64} << 10, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(in.gcount()));
  const std::size_t start = text.find("<name>"), end = text.find("</name>", start);
  if (start == std::string::npos || end == std::string::npos) return false;
  std::string said = text.substr(start + 6, end - start - 6);
  std::erase_if(said, [](unsigned char c) { return std::isspace(c) != 0; });
  return said == name;
}

bool is_package(const fs::path& folder, const std::string& name) {
  return folder.filename() == name || says_name(folder / "package.xml", name) ||
         says_name(folder / "model.config", name);
}

// The URDF's folder and those above it, as far as the scope reaches.
std::vector<fs::path> folders_above(const fs::path& urdf, const FileScope& scope) {
  std::error_code ignored;
  std::vector<fs::path> folders;
  for (fs::path folder = fs::weakly_canonical(urdf, ignored).parent_path(); scope.contains(folder);
       folder = folder.parent_path()) {
    folders.push_back(folder);
    if (folder == folder.root_path()) break;
  }
  return folders;
}

fs::path in_package(const std::string& package, const std::string& path, const fs::path& urdf, const FileScope& scope) {
  const std::vector<fs::path> above = folders_above(urdf, scope);
  std::vector<fs::path> places;
  for (const fs::path& folder : above) {
    if (is_package(folder, package)) places.push_back(folder);
    if (folder != above.front()) places.push_back(folder / package);
  }
  places.insert(places.end(), above.begin(), above.end());
  std::error_code ignored;
  for (const fs::path& place : places)
    if (const fs::path file = read_as(place, path); is_file(file)) {
      scope.check(file);
      // As before where it lies beside the URDF: what a catalogue says of it does not depend on where the root is.
      return place == above.front() ? read_as(urdf.parent_path(), path) : file;
    }
  // Where it would lie, if it is one of a folder that there is: who reads it says that it is missing, or outside.
  const fs::path beside = urdf.parent_path() / without_backslashes(path);
  scope.check(beside);
  throw Error(beside.string(),
              "there is no such file, and none in a package '" + package + "': looked for '" + path + "' in " +
                  std::to_string(above.size()) + " folders from the URDF's up to " +
                  (above.empty() ? urdf.parent_path() : above.back()).string(),
              "put the folder of the package, with its meshes, above the URDF, inside the roots");
}

}  // namespace

fs::path file_named(const std::string& name, const fs::path& urdf, const FileScope& scope) {
  if (name.empty()) throw Error(urdf.string(), "the name of the file is empty", kNameCure);
  const std::size_t scheme = name.find("://");
  if (scheme == std::string::npos) return read_as(urdf.parent_path(), name);
  const std::string kind = name.substr(0, scheme);
  std::string rest = name.substr(scheme + 3);
  if (kind == "file") {
    if (rest.starts_with("localhost/")) rest.erase(0, 9);
    return read_as(urdf.parent_path(), rest);
  }
  if (kind != "package" && kind != "model") throw Error(name, "files of '" + kind + "://' are not fetched", kNameCure);
  const std::size_t slash = rest.find('/');
  if (slash == 0 || slash == std::string::npos || slash + 1 == rest.size())
    throw Error(name, "it names no file of a package", kNameCure);
  return in_package(rest.substr(0, slash), rest.substr(slash + 1), urdf, scope);
}

}  // namespace stampede
