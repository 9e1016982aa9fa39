// Files beside the Lua files: meshes, pictures, URDFs. Each is read once.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/geometry/value.h"
#include "engine/model/urdf.h"

namespace stampede {

class Library;

// Lifetime: one thread. All throw Error that names the author's place, the file and the cure; for files outside of the
// scope too.
class Assets {
 public:
  explicit Assets(FileScope scope) : scope_(std::move(scope)) {}

  struct Drawn {
    std::vector<DrawnPiece> pieces;
    DrawnAssets assets;  // that the pieces name
  };
  using Hulls = std::vector<std::vector<Vector3>>;

  const Drawn& drawn(const std::filesystem::path& file, const Vector3& scale, const Value& where);
  const Hulls& hulls(const std::filesystem::path& file, const Vector3& scale, const Value& where);
  std::shared_ptr<const Image> image(const std::filesystem::path& file, const Value& where);
  const UrdfBody& urdf(const std::filesystem::path& file, bool free = false);  // its own errors name place enough

  // What is no mistake and worth knowing of what was read and built: each once, in the order in which it came up.
  void remark(const Error& remark);
  const std::vector<Error>& remarks() const { return remarks_; }

 private:
  FileScope scope_;
  std::map<std::string, Drawn> drawn_;  // by file and scale
  std::map<std::string, Hulls> hulls_;
  std::map<std::filesystem::path, std::shared_ptr<const Image>> images_;
  std::vector<Error> remarks_;
  std::map<std::pair<std::filesystem::path, bool>, UrdfBody> urdfs_;  // a robot's takes longer than all else in a draw
};

// Of the library's folders; `given` where they are there already.
std::shared_ptr<Assets> assets_of(const Library& library, std::shared_ptr<Assets> given = nullptr);

}  // namespace stampede
