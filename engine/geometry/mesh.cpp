#include "engine/geometry/mesh.h"

#include <assimp/postprocess.h>

#include <fstream>

#include "engine/base/error.h"
#include "engine/geometry/bytes.h"
#include "engine/geometry/hull.h"
#include "engine/geometry/import.h"
#include "engine/geometry/mesh_form.h"

namespace stampede {
namespace {

void append(const aiMesh& source, const aiMatrix4x4& root_from_node, const Vector3& scale, Mesh& mesh) {
  const int first = static_cast<int>(mesh.vertices.size());
  for (unsigned i = 0; i < source.mNumVertices; ++i) {
    const aiVector3D v = root_from_node * source.mVertices[i];
    mesh.vertices.push_back(Vector3(v.x, v.y, v.z).cwiseProduct(scale));
  }
  const bool mirrored = scale.prod() * double{root_from_node.Determinant()} < 0;  // keep triangles facing outwards
  for (unsigned i = 0; i < source.mNumFaces; ++i) {
    const aiFace& face = source.mFaces[i];
    if (face.mNumIndices != 3) continue;  // points and lines have no place in a solid
    std::array<int, 3> corners{};
    for (unsigned k = 0; k < 3; ++k) corners[k] = first + static_cast<int>(face.mIndices[mirrored ? 2 - k : k]);
    mesh.triangles.push_back(corners);
  }
}

void walk(const aiScene& scene, const aiNode& node, const aiMatrix4x4& root_from_parent, const Vector3& scale,
          std::vector<Mesh>& meshes) {
  const aiMatrix4x4 root_from_node = root_from_parent * node.mTransformation;
  Mesh mesh;
  mesh.node = node.mName.C_Str();
  for (unsigned i = 0; i < node.mNumMeshes; ++i) append(*scene.mMeshes[node.mMeshes[i]], root_from_node, scale, mesh);
  if (!mesh.triangles.empty()) meshes.push_back(std::move(mesh));
  for (unsigned i = 0; i < node.mNumChildren; ++i) walk(scene, *node.mChildren[i], root_from_node, scale, meshes);
}

void check_finite(const std::filesystem::path& file, const Mesh& mesh) {
  for (const Vector3& vertex : mesh.vertices) {
    if (!vertex.allFinite())
      throw Error(file.string(), "node '" + mesh.node + "' has a coordinate that is not a finite number", kMeshCure);
    if (vertex.cwiseAbs().maxCoeff() > kFarthest)
      throw Error(file.string(), "node '" + mesh.node + "' has a corner more than 1000 km away", kMeshCure);
  }
}

std::vector<Mesh> read_meshes(const ImportContext& context, const Vector3& scale) {
  Assimp::Importer importer;
  // Normals and texture coordinates go first: they would keep equal corners apart.
  const aiScene& scene = import_scene(importer, context, scale,
                                      aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                          aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS,
                                      aiProcess_Triangulate | aiProcess_JoinIdenticalVertices);
  std::vector<Mesh> meshes;
  walk(scene, *scene.mRootNode, aiMatrix4x4(), scale, meshes);
  if (meshes.empty()) throw Error(context.file.string(), "the mesh has no triangles", kMeshCure);
  for (const Mesh& mesh : meshes) check_finite(context.file, mesh);
  return meshes;
}

using Hulls = std::vector<std::vector<Vector3>>;

Hulls read_hulls(const ImportContext& context, const Vector3& scale, int most_points) {
  Hulls hulls;
  for (const Mesh& mesh : read_meshes(context, scale)) {
    std::optional<Hull> hull = convex_hull(mesh.vertices, most_points);
    if (!hull)
      throw Error(context.file.string(), "node '" + mesh.node + "' is flat: it spans no volume",
                  "give the node thickness, or remove it");
    hulls.push_back(std::move(hull->points));
  }
  return hulls;
}

}  // namespace

std::string mesh_remark(const std::filesystem::path& file) {
  if (ending_of(file) != ".dae") return {};
  std::ifstream in(file, std::ios::binary);
  std::string text(std::size_t{64} << 10, '\0');  // it stands in the file's head
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  const std::size_t at = text.find("<up_axis>");
  if (at == std::string::npos || text.compare(at + 9, 4, "Z_UP") == 0) return {};
  const std::string axis = text.compare(at + 9, 1, "X") == 0 ? "x" : "y";
  return "it says that " + axis + " is up, which is ignored as by ROS: z of its numbers is up";
}

std::vector<Mesh> load_meshes(const std::filesystem::path& file, const Vector3& scale) {
  return load_meshes(file, scale, beside(file));
}

std::vector<Mesh> load_meshes(const std::filesystem::path& file, const Vector3& scale, const FileScope& scope) {
  const auto bytes = read_carefully(file, "meshes" + exact(scale), scope, [&](Companions& companions) {
    ByteWriter out;
    const std::vector<Mesh> meshes = read_meshes({file, scope, companions}, scale);
    out.put(static_cast<std::uint64_t>(meshes.size()));
    for (const Mesh& mesh : meshes) {
      out.put(std::string_view(mesh.node));
      out.put_all(mesh.vertices);
      out.put_all(mesh.triangles);
    }
    return out.take();
  });
  ByteReader in(*bytes);
  std::vector<Mesh> meshes(in.get<std::uint64_t>());
  for (Mesh& mesh : meshes) {
    mesh.node = in.text();
    mesh.vertices = in.all<Vector3>();
    mesh.triangles = in.all<std::array<int, 3>>();
  }
  return meshes;
}

Hulls load_hulls(const std::filesystem::path& file, const Vector3& scale, int most_points) {
  return load_hulls(file, scale, most_points, beside(file));
}

Hulls load_hulls(const std::filesystem::path& file, const Vector3& scale, int most_points, const FileScope& scope) {
  const std::string question = "hulls " + std::to_string(most_points) + exact(scale);
  const auto bytes = read_carefully(file, question, scope, [&](Companions& companions) {
    ByteWriter out;
    const Hulls hulls = read_hulls({file, scope, companions}, scale, most_points);
    out.put(static_cast<std::uint64_t>(hulls.size()));
    for (const auto& points : hulls) out.put_all(points);
    return out.take();
  });
  ByteReader in(*bytes);
  Hulls hulls(in.get<std::uint64_t>());
  for (auto& points : hulls) points = in.all<Vector3>();
  return hulls;
}

}  // namespace stampede
