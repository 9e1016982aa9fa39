// A small root of Lua files, and a world made from one of its tasks.
#pragma once

#include <memory>
#include <string>

#include "engine/sim/world.h"
#include "engine/start/world_view.h"
#include "scripting/runtime/episode_scripts.h"

namespace stampede::test {

inline std::shared_ptr<const Library> small_library() {
  static const std::shared_ptr<const Library> library =
      Library::load({{STAMPEDE_SOURCE_DIR "/tests/scripting/data/runtime"}});
  return library;
}

// The task `steps`: a cube and a second one on the bench, a chest with a drawer.
struct SmallWorld {
  EpisodeScripts scripts{small_library(), "steps", "", 7};
  World world{std::make_shared<const Scene>(scripts.task()(0).scene)};
  WorldView view{world};
};

}  // namespace stampede::test
