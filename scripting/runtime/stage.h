// What stands around whatever the task: where real recordings take place.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/geometry/value.h"
#include "scripting/library/library.h"

namespace stampede {

class Assets;

struct StageRequest {
  std::string world;           // whose fixtures stand around; empty: none
  std::string robot;           // a robot of the library, or the name of that of `urdf`
  std::filesystem::path urdf;  // empty: the library's robot
  Value robot_fields;          // of a robot of `urdf`: as a robot's Lua file has them
  Transform world_from_base = Transform::Identity();
  bool driven = false;  // will it be simulated? Recordings move hands that the engine cannot
  std::string where;    // starts complaints about these words
};

struct Stage {
  Scene scene;                           // with masks numbered
  std::vector<const ScriptFile*> files;  // that took part; the library's
};

// Repeatable: what a world draws is drawn from its name. URDFs lie in the library's roots or beside themselves.
// Throws Error.
// `assets`: as of EpisodeScripts, for a robot of the library.
Stage stage_of(const std::shared_ptr<const Library>& library, const StageRequest& request,
               std::shared_ptr<Assets> assets = nullptr);

}  // namespace stampede
