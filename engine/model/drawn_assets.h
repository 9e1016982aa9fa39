// Meshes and textures on their way into a scene, where shapes name them by key.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/drawn_mesh.h"
#include "engine/model/scene.h"

namespace stampede {

// Keys follow content: equal things have equal keys, so joining never mixes two up.
struct DrawnAssets {
  std::map<std::string, std::shared_ptr<const DrawnMesh>> meshes;
  std::map<std::string, Texture> textures;

  std::string add(std::shared_ptr<const DrawnMesh> mesh);             // its key
  std::string add(const std::string& label, const Texture& texture);  // its key: `label` and a hash
  void join(const DrawnAssets& others);
};

// A piece of a mesh file, its looks as the file has them.
struct DrawnPiece {
  std::string mesh;              // keys of the assets
  std::optional<Colour> colour;  // nothing: the file says none
  std::string texture;           // empty: plain
};
std::vector<DrawnPiece> add_drawn(DrawnAssets& assets, const std::string& label,
                                  const std::vector<DrawnMaterial>& materials);

// Looks that go before those of a file.
struct Looks {
  Colour colour;
  std::string texture;  // a key; empty: plain
};

// Drawn shapes, one a piece, where `common` says: they collide with nothing.
std::vector<Shape> drawn_shapes(const std::vector<DrawnPiece>& pieces, const Shape& common,
                                const std::optional<Looks>& looks);

}  // namespace stampede
