// Object files as bodies, regions and names.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/scene.h"
#include "scripting/runtime/value.h"

namespace stampede {

using Colours = std::map<std::string, Colour, std::less<>>;  // of worlds/colours.lua

// One object of the episode. README.md says what its fields may be. All functions throw Error.
struct ObjectSource {
  std::string name;              // `block1`
  std::string class_name;        // the object file
  Value fields;                  // of the file, with those of the task's or world's entry on top
  std::filesystem::path folder;  // where its meshes and URDF are
};

struct BuiltObject {
  std::optional<Body> body;  // nothing: the whole object is a region
  std::vector<Region> regions;
  std::vector<Object> objects;  // itself, its named parts and regions
  bool placed = false;          // `at` fixes its pose
  bool stands_still = false;    // a fixed body: nothing but `at` can place it
};

BuiltObject build_object(const ObjectSource& source, const Colours& colours);

Colour colour_from(const Value& value, const Colours& colours);
std::vector<Shape> shapes_from(const Value& fields, const Colours& colours, const Colour& own,
                               const std::filesystem::path& folder);
Surface surface_from(const Value& fields, const Surface& otherwise);

}  // namespace stampede
