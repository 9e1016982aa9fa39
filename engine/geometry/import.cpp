#include "engine/geometry/import.h"

#include <assimp/BaseImporter.h>
#include <assimp/DefaultIOSystem.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <set>

#include "engine/base/error.h"
#include "engine/geometry/mesh_form.h"

namespace stampede {
namespace {

// Opens files inside the scope only, and keeps account of them.
class ScopedFiles : public Assimp::DefaultIOSystem {
 public:
  explicit ScopedFiles(const ImportContext& context) : context_(context) {}

  bool Exists(const char* file) const override {
    return context_.scope.contains(file) && DefaultIOSystem::Exists(file);
  }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    if (!context_.scope.contains(file)) {
      if (refused_.empty()) refused_ = file;
      return nullptr;
    }
    Assimp::IOStream* const stream = DefaultIOSystem::Open(file, mode);
    if (stream != nullptr && std::filesystem::path(file) != context_.file) context_.companions.emplace_back(file);
    return stream;
  }
  void check() const {
    if (!refused_.empty()) context_.scope.check(refused_);
  }

 private:
  const ImportContext& context_;
  std::string refused_;
};

// assimp reads some fifty formats, and goes by what a file begins with: here an `.obj` is read as one, or not at all.
void keep_loaders_of(Assimp::Importer& importer, const std::string& ending) {
  for (std::size_t i = importer.GetImporterCount(); i-- > 0;) {
    std::set<std::string> endings;
    importer.GetImporter(i)->GetExtensionList(endings);
    if (!endings.contains(ending.substr(1))) importer.UnregisterLoader(importer.GetImporter(i));
  }
}

[[noreturn]] void unsound(const ImportContext& context, const std::string& what) {
  throw Error(context.file.string(), "not a sound mesh: " + what, kMeshCure);
}

// assimp's own checks leave some of this to who reads.
void check_meshes(const ImportContext& context, const aiScene& scene) {
  for (unsigned i = 0; i < scene.mNumMeshes; ++i) {
    const aiMesh& mesh = *scene.mMeshes[i];
    if (mesh.mMaterialIndex >= scene.mNumMaterials) unsound(context, "it uses a material that is not there");
    for (unsigned f = 0; f < mesh.mNumFaces; ++f)
      for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
        if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices)
          unsound(context, "face " + std::to_string(f) + " names corner " + std::to_string(mesh.mFaces[f].mIndices[k]) +
                               " of " + std::to_string(mesh.mNumVertices));
  }
}

void count_triangles(const ImportContext& context, const aiScene& scene, const aiNode& node, int depth,
                     std::size_t& count) {
  if (depth > kDeepestNode) unsound(context, "its nodes are nested deeper than " + std::to_string(kDeepestNode));
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    if (node.mMeshes[i] >= scene.mNumMeshes) unsound(context, "a node names a mesh that is not there");
    count += scene.mMeshes[node.mMeshes[i]]->mNumFaces;
    if (count > kMostTriangles) unsound(context, "it has more than " + std::to_string(kMostTriangles) + " triangles");
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i)
    count_triangles(context, scene, *node.mChildren[i], depth + 1, count);
}

std::string said_by(const Assimp::Importer& importer) {
  const std::string text = importer.GetErrorString();
  if (text.find("bad_alloc") == std::string::npos) return text;
  throw std::bad_alloc();  // told with the limit by who set it
}

}  // namespace

const aiScene& import_scene(Assimp::Importer& importer, const ImportContext& context, const Vector3& scale,
                            unsigned removed, unsigned steps) {
  const std::string where = context.file.string();
  if (!scale.allFinite() || (scale.array() == 0).any())
    throw Error(where, "its scale must be three finite numbers other than 0", "write 0.001 for millimetres");
  check_form(context.file);
  keep_loaders_of(importer, ending_of(context.file));
  auto* const files = new ScopedFiles(context);  // the importer's from here on
  importer.SetIOHandler(files);
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, static_cast<int>(removed));
  const aiScene* scene = importer.ReadFile(where, 0);
  files->check();
  if (scene != nullptr && scene->mRootNode != nullptr) {
    check_meshes(context, *scene);  // before the steps, which trust what they are given
    scene = importer.ApplyPostProcessing(aiProcess_RemoveComponent | steps);
  }
  if (scene == nullptr || scene->mRootNode == nullptr)
    throw Error(where, "not a readable mesh: " + said_by(importer), kMeshCure);
  check_meshes(context, *scene);
  std::size_t count = 0;
  count_triangles(context, *scene, *scene->mRootNode, 0, count);
  return *scene;
}

}  // namespace stampede
