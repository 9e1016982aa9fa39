#include "engine/model/drawn_assets.h"

#include "engine/base/hash.h"

namespace stampede {
namespace {

constexpr std::size_t kHashLetters = 12;  // 48 bits tell the textures of one scene apart

void add_colour(Hasher& hasher, const Colour& colour) {
  hasher.number(colour.red).number(colour.green).number(colour.blue).number(colour.alpha);
}

std::string digest_of(const Texture& texture) {
  Hasher hasher;
  hasher.number(static_cast<int>(texture.kind)).number(texture.size_m).number(texture.seed);
  add_colour(hasher, texture.first);
  add_colour(hasher, texture.second);
  if (texture.image) {
    hasher.number(texture.image->width).number(texture.image->height);
    hasher.bytes(texture.image->rgba.data(), texture.image->rgba.size());
  }
  return hasher.digest();
}

}  // namespace

std::string DrawnAssets::add(std::shared_ptr<const DrawnMesh> mesh) {
  std::string key = content_hash(to_bytes(*mesh));
  meshes.emplace(key, std::move(mesh));
  return key;
}

std::string DrawnAssets::add(const std::string& label, const Texture& texture) {
  std::string key = label + " " + digest_of(texture).substr(0, kHashLetters);
  textures.emplace(key, texture);
  return key;
}

void DrawnAssets::join(const DrawnAssets& others) {
  meshes.insert(others.meshes.begin(), others.meshes.end());
  textures.insert(others.textures.begin(), others.textures.end());
}

std::vector<DrawnPiece> add_drawn(DrawnAssets& assets, const std::string& label,
                                  const std::vector<DrawnMaterial>& materials) {
  std::vector<DrawnPiece> pieces;
  for (const DrawnMaterial& material : materials) {
    DrawnPiece piece;
    piece.mesh = assets.add(std::make_shared<const DrawnMesh>(material.mesh));
    if (material.colour) {
      const auto& [red, green, blue, alpha] = *material.colour;
      piece.colour = Colour{red, green, blue, alpha};
    }
    if (material.image) {
      Texture texture;
      texture.image = material.image;
      piece.texture = assets.add(label, texture);
      if (!piece.colour) piece.colour = Colour{1, 1, 1, 1};
    }
    pieces.push_back(std::move(piece));
  }
  return pieces;
}

std::vector<Shape> drawn_shapes(const std::vector<DrawnPiece>& pieces, const Shape& common,
                                const std::optional<Looks>& looks) {
  std::vector<Shape> shapes;
  for (const DrawnPiece& piece : pieces) {
    Shape shape = common;
    shape.kind = ShapeKind::mesh;
    shape.points.clear();
    shape.mesh = piece.mesh;
    shape.collides = false;
    shape.visible = true;
    if (looks) {
      shape.colour = looks->colour;
      shape.texture = looks->texture;
    } else {
      shape.colour = piece.colour.value_or(Colour{});
      shape.texture = piece.texture;
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

}  // namespace stampede
