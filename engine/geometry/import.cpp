#include "engine/geometry/import.h"

#include <assimp/postprocess.h>

#include "engine/base/error.h"

namespace stampede {

const aiScene& import_scene(Assimp::Importer& importer, const std::filesystem::path& file, const Vector3& scale,
                            unsigned removed, unsigned steps) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw Error(file.string(), "there is no such mesh file",
                "check the name; it is looked for beside the file that uses it");
  if (!scale.allFinite() || (scale.array() == 0).any())
    throw Error(file.string(), "its scale must be three finite numbers other than 0", "write 0.001 for millimetres");
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(removed));
  const aiScene* const scene = importer.ReadFile(file.string(), aiProcess_RemoveComponent | steps);
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw Error(file.string(), std::string("not a readable mesh: ") + importer.GetErrorString(), kMeshCure);
  return *scene;
}

}  // namespace stampede
