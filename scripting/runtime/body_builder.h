// Object files as bodies, regions and names.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/geometry/value.h"
#include "engine/model/scene.h"
#include "scripting/runtime/assets.h"

namespace stampede {

using Colours = std::map<std::string, Colour, std::less<>>;  // of worlds/colours.lua

// One object of the episode. README.md says what its fields may be. All functions throw Error.
struct ObjectSource {
  std::string name;              // `block1`
  std::string class_name;        // the object file
  Value fields;                  // of the file, with those of the task's or world's entry on top
  std::filesystem::path folder;  // where its meshes, textures and URDF are
  Assets* assets = nullptr;      // files already read, if there are any
};

struct BuiltObject {
  std::optional<Body> body;  // nothing: the whole object is a region
  std::vector<Body> loose;   // its parts whose joints let go of them: bodies that are joined to it
  std::vector<Region> regions;
  std::vector<Object> objects;  // itself, its named parts and regions
  DrawnAssets drawn;            // meshes and textures that its shapes name
  bool placed = false;          // `at` fixes its pose
  bool stands_still = false;    // a fixed body: nothing but `at` can place it
};

BuiltObject build_object(const ObjectSource& source, const Colours& colours);

Colour colour_from(const Value& value, const Colours& colours);

// What reading shapes and looks needs, and where meshes and textures go.
struct ShapeContext {
  const Colours& colours;
  std::filesystem::path folder;  // of their files
  Assets& assets;
  DrawnAssets& drawn;
  std::string owner;  // name of the thing that they belong to: `self` in `shows`
};
// A texture's key among context.drawn.
std::string texture_from(const Value& value, const ShapeContext& context);
// Colour and texture where `fields` has either, else `outer`.
std::optional<Looks> looks_from(const Value& fields, const std::optional<Looks>& outer, const ShapeContext& context);
// `shape` and `shapes`, which collide and, unless there is a `visual`, are drawn. `own`: looks of those that have none.
std::vector<Shape> shapes_from(const Value& fields, const std::optional<Looks>& own, const ShapeContext& context);
Surface surface_from(const Value& fields, const Surface& otherwise);

}  // namespace stampede
