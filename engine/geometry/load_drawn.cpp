#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "engine/base/error.h"
#include "engine/geometry/bytes.h"
#include "engine/geometry/drawn_mesh.h"
#include "engine/geometry/image.h"
#include "engine/geometry/import.h"
#include "engine/geometry/mesh.h"
#include "engine/geometry/mesh_form.h"
#include "engine/geometry/smooth.h"

namespace stampede {
namespace {

using Matrix4 = Eigen::Matrix4d;
using Picture = std::shared_ptr<const Image>;

bool has_ending(const std::filesystem::path& file, std::initializer_list<std::string_view> endings) {
  return std::find(endings.begin(), endings.end(), ending_of(file)) != endings.end();
}

double srgb_from_linear(double x) {  // IEC 61966-2-1
  return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055;
}

Image raw_picture(const aiTexture& texture) {
  Image image{static_cast<int>(texture.mWidth), static_cast<int>(texture.mHeight), {}};
  for (std::size_t i = 0; i < std::size_t{texture.mWidth} * texture.mHeight; ++i) {
    const aiTexel& texel = texture.pcData[i];
    image.rgba.insert(image.rgba.end(), {texel.r, texel.g, texel.b, texel.a});
  }
  return image;
}

class Loader {
 public:
  Loader(const ImportContext& context, const Vector3& scale)
      : context_(context), file_(context.file), scale_(scale), is_gltf_(has_ending(file_, {".glb", ".gltf"})) {
    // An STL's normals are of its facets: they would make every curve an array of plates.
    const unsigned normals = has_ending(file_, {".stl"}) ? unsigned{aiComponent_NORMALS} : 0U;
    scene_ = &import_scene(importer_, context, scale,
                           normals | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                               aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS,
                           aiProcess_Triangulate | aiProcess_FlipUVs);
  }

  std::vector<DrawnMaterial> load() {
    walk(*scene_->mRootNode, aiMatrix4x4());
    if (drawn_.empty()) throw Error(file_.string(), "the mesh has no triangles", kMeshCure);
    return std::move(drawn_);
  }

 private:
  void walk(const aiNode& node, const aiMatrix4x4& root_from_parent) {
    const aiMatrix4x4 root_from_node = root_from_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) add(*scene_->mMeshes[node.mMeshes[i]], root_from_node, node);
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], root_from_node);
  }

  void add(const aiMesh& mesh, const aiMatrix4x4& root_from_node, const aiNode& node) {
    Matrix4 scaled;
    for (unsigned row = 0; row < 4; ++row)
      for (unsigned column = 0; column < 4; ++column)
        scaled(row, column) = (row < 3 ? scale_[row] : 1.0) * double{root_from_node[row][column]};
    Corners corners = corners_of(mesh, scaled, node);
    drop_flat(corners);
    if (corners.positions.empty()) return;
    const bool usable = std::all_of(corners.normals.begin(), corners.normals.end(), [](const auto& n) {
      return std::abs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-3F;
    });
    if (corners.normals.empty() || !usable) smooth_normals(corners);
    DrawnMaterial drawn;
    drawn.mesh = joined(corners);
    add_looks(*scene_->mMaterials[mesh.mMaterialIndex], drawn);
    drawn_.push_back(std::move(drawn));
  }

  Corners corners_of(const aiMesh& mesh, const Matrix4& root_from_mesh, const aiNode& node) const {
    const Matrix3 linear = root_from_mesh.topLeftCorner<3, 3>();
    const bool mirrored = linear.determinant() < 0;  // keep triangles facing outwards
    const Matrix3 turn = linear.inverse().transpose();
    Corners corners;
    for (unsigned i = 0; i < mesh.mNumFaces; ++i) {
      const aiFace& face = mesh.mFaces[i];
      if (face.mNumIndices != 3) continue;  // points and lines have no surface
      for (unsigned k = 0; k < 3; ++k) {
        const unsigned at = face.mIndices[mirrored ? 2 - k : k];
        const aiVector3D& v = mesh.mVertices[at];
        corners.positions.push_back(
            finite(linear * Vector3(v.x, v.y, v.z) + root_from_mesh.topRightCorner<3, 1>(), node));
        if (mesh.HasNormals()) {
          const aiVector3D& n = mesh.mNormals[at];
          const Vector3 normal = (turn * Vector3(n.x, n.y, n.z)).normalized();
          corners.normals.push_back(single(normal));
        }
        if (mesh.HasTextureCoords(0))
          corners.coordinates.push_back({mesh.mTextureCoords[0][at].x, mesh.mTextureCoords[0][at].y});
      }
    }
    return corners;
  }

  static std::array<float, 3> single(const Vector3& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
  }

  std::array<float, 3> finite(const Vector3& v, const aiNode& node) const {
    const std::array<float, 3> point = single(v);
    if (!std::isfinite(point[0]) || !std::isfinite(point[1]) || !std::isfinite(point[2]))
      throw Error(file_.string(),
                  std::string("node '") + node.mName.C_Str() + "' has a coordinate that is not a finite number",
                  kMeshCure);
    if (v.cwiseAbs().maxCoeff() > kFarthest)
      throw Error(file_.string(), std::string("node '") + node.mName.C_Str() + "' has a corner more than 1000 km away",
                  kMeshCure);
    return point;
  }

  void add_looks(const aiMaterial& material, DrawnMaterial& drawn) {
    if (material.GetName() == aiString(AI_DEFAULT_MATERIAL_NAME)) return;  // assimp's, where the file has none
    aiColor4D colour;
    if (material.Get(AI_MATKEY_BASE_COLOR, colour) == aiReturn_SUCCESS ||
        material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
      drawn.colour = colour_of(material, colour);
    if (!drawn.mesh.coordinates.empty()) drawn.image = picture_of(material);
    // Some programs write black beside a picture, though the picture is meant to be seen as it is.
    if (drawn.image && drawn.colour && colour.r == 0 && colour.g == 0 && colour.b == 0) drawn.colour.reset();
  }

  std::array<double, 4> colour_of(const aiMaterial& material, const aiColor4D& colour) const {
    std::array<double, 4> result{colour.r, colour.g, colour.b, colour.a};
    float opacity = 1;
    if (material.Get(AI_MATKEY_OPACITY, opacity) == aiReturn_SUCCESS) result[3] = std::min(result[3], double{opacity});
    aiString mode;
    if (material.Get(AI_MATKEY_GLTF_ALPHAMODE, mode) == aiReturn_SUCCESS && mode == aiString("OPAQUE")) result[3] = 1;
    for (std::size_t i = 0; i < 4; ++i) {
      if (is_gltf_ && i < 3) result[i] = srgb_from_linear(result[i]);
      result[i] = std::isfinite(result[i]) ? std::clamp(result[i], 0.0, 1.0) : 1.0;
    }
    return result;
  }

  Picture picture_of(const aiMaterial& material) {
    aiString name;
    if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != aiReturn_SUCCESS &&
        material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != aiReturn_SUCCESS)
      return nullptr;
    Picture& picture = pictures_[name.C_Str()];
    if (!picture) picture = std::make_shared<const Image>(read_picture(name.C_Str()));
    return picture;
  }

  Image read_picture(const std::string& name) const {
    if (const aiTexture* texture = scene_->GetEmbeddedTexture(name.c_str()); texture != nullptr) {
      if (texture->mHeight > 0) return raw_picture(*texture);
      return image_from_bytes({reinterpret_cast<const char*>(texture->pcData), texture->mWidth},
                              file_.string() + ", the picture '" + name + "' inside it");
    }
    std::string plain = name;
    std::replace(plain.begin(), plain.end(), '\\', '/');  // written on Windows
    const std::filesystem::path beside = file_.parent_path() / plain;
    std::error_code ignored;
    context_.scope.check(beside);
    if (!std::filesystem::is_regular_file(beside, ignored))
      throw Error(file_.string(), "its picture '" + name + "' is missing", "put it at " + beside.string());
    context_.companions.push_back(beside);
    return load_image(beside);
  }

  const ImportContext& context_;
  const std::filesystem::path& file_;
  const Vector3& scale_;
  bool is_gltf_;
  Assimp::Importer importer_;
  const aiScene* scene_ = nullptr;
  std::map<std::string, Picture> pictures_;
  std::vector<DrawnMaterial> drawn_;
};

// Pictures are written once, though many materials may share one.
std::string packed(const std::vector<DrawnMaterial>& drawn) {
  ByteWriter out;
  std::vector<const Image*> pictures;
  out.put(static_cast<std::uint64_t>(drawn.size()));
  for (const DrawnMaterial& material : drawn) {
    out.put(std::string_view(to_bytes(material.mesh)));
    out.put(material.colour.has_value());
    out.put(material.colour.value_or(std::array<double, 4>{}));
    out.put(material.image != nullptr);
    if (material.image == nullptr) continue;
    const auto known = std::find(pictures.begin(), pictures.end(), material.image.get());
    out.put(static_cast<std::uint64_t>(known - pictures.begin()));
    if (known != pictures.end()) continue;
    pictures.push_back(material.image.get());
    out.put(material.image->width);
    out.put(material.image->height);
    out.put_all(material.image->rgba);
  }
  return out.take();
}

std::vector<DrawnMaterial> unpacked(const std::string& bytes) {
  ByteReader in(bytes);
  std::vector<Picture> pictures;
  std::vector<DrawnMaterial> drawn(in.get<std::uint64_t>());
  for (DrawnMaterial& material : drawn) {
    material.mesh = mesh_from_bytes(in.text());
    const bool coloured = in.get<bool>();
    const auto colour = in.get<std::array<double, 4>>();
    if (coloured) material.colour = colour;
    if (!in.get<bool>()) continue;
    const auto number = static_cast<std::size_t>(in.get<std::uint64_t>());
    if (number == pictures.size()) {
      Image image{in.get<int>(), in.get<int>(), {}};
      image.rgba = in.all<std::uint8_t>();
      pictures.push_back(std::make_shared<const Image>(std::move(image)));
    }
    material.image = pictures.at(number);
  }
  return drawn;
}

}  // namespace

std::vector<DrawnMaterial> load_drawn(const std::filesystem::path& file, const Vector3& scale) {
  return load_drawn(file, scale, stampede::beside(file));
}

std::vector<DrawnMaterial> load_drawn(const std::filesystem::path& file, const Vector3& scale, const FileScope& scope) {
  return unpacked(*read_carefully(file, "drawn" + exact(scale), scope, [&](Companions& companions) {
    const ImportContext context{file, scope, companions};
    return packed(Loader(context, scale).load());
  }));
}

}  // namespace stampede
