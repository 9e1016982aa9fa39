// Files that objects name, and how much of them there is: without reading what is in them.
#include "engine/base/file_scope.h"
#include "scripting/library/checks.h"
#include "scripting/library/rates.h"

namespace stampede {
namespace {

// The text after `mesh {` or `texture {`.
const Value& file_of(const Value& written) {
  if (written.is_text()) return written;
  return !written.items.empty() && written.items[0].is_text() ? written.items[0] : written["file"];
}

struct Found {
  std::vector<std::pair<std::string, std::string>> files;  // what it is, its name
  int shapes = 0;
  std::size_t rings = 0;
};

void look_through(const Value& node, Found& found) {
  if (!node.is_table()) return;
  const std::string& shape = node["shape"].text;
  if (node.tag() == "shape") ++found.shapes;
  if (node.tag() == "shape" && shape == "mesh") found.files.emplace_back("mesh", file_of(node).text);
  if (node["mesh"].present()) found.files.emplace_back("mesh", file_of(node["mesh"]).text);
  if (node.tag() == "texture" && node["texture"].text == "image")
    found.files.emplace_back("picture", file_of(node).text);
  for (const Value* lathe : {&node, &node["lathe"]}) {
    if (lathe == &node && shape != "lathe") continue;
    const Value& profile = (*lathe)["profile"];
    found.rings = std::max(found.rings, (profile.present() ? profile : *lathe).items.size());
  }
  for (const Value& item : node.items) look_through(item, found);
  for (const auto& [name, field] : node.fields) look_through(field, found);
}

}  // namespace

void check_assets(const Definition& definition, const Roots& roots) {
  const FileScope scope(roots.folders);
  const std::filesystem::path folder = definition.file->path.parent_path();
  const auto check_file = [&](const std::string& path, const std::string& what, const std::string& name) {
    if (name.empty()) return;
    const std::filesystem::path file = folder / name;
    std::error_code ignored;
    try {
      scope.check(file);
    } catch (const Error& error) {
      return definition.complain(path, what + " " + error.where() + ": " + error.message(), error.hint());
    }
    if (!std::filesystem::is_regular_file(file, ignored))
      definition.complain(path, "there is no " + what + " '" + name + "'", "it is looked for beside this file");
  };
  int shapes = 0;
  for (const auto& [name, field] : definition.node.fields) {
    Found found;
    look_through(field, found);
    shapes += found.shapes;
    for (const auto& [what, file] : found.files) check_file(name, what, file);
    if (found.rings > kMostRings)
      definition.complain(
          name,
          "a lathe of " + std::to_string(found.rings) + " rings; at most " + std::to_string(kMostRings) + " are turned",
          "leave out points that lie on a line");
  }
  if (definition.node["urdf"].is_text()) check_file("urdf", "URDF file", definition.node["urdf"].text);
  if (shapes > kMostShapes)
    definition.complain({}, std::to_string(shapes) + " shapes; an object has at most " + std::to_string(kMostShapes),
                        "join them: a mesh file may have many triangles in one hull");
}

}  // namespace stampede
