#include "scripting/runtime/object_scene.h"

#include <lua.hpp>

#include "engine/model/masks.h"
#include "scripting/runtime/assets.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/scene_builder.h"
#include "scripting/runtime/script_state.h"
#include "scripting/runtime/task_reader.h"
#include "scripting/runtime/world_reader.h"

namespace stampede {

Scene object_scene(std::shared_ptr<const Library> library, const std::string& object, std::shared_ptr<Assets> assets) {
  assets = assets_of(*library, std::move(assets));
  const ScriptFile* file = library->file(DefinitionKind::object, object);
  if (file == nullptr) throw Error("object '" + object + "'", "there is no such object file");
  ScriptState scripts(library, "");
  const RandomKey key("portrait");
  Scene scene;
  scripts.protect([&](lua_State* state) {
    const Colours colours = read_colours(state, key);
    scripts.definitions().push(DefinitionKind::object, object);
    Value fields = read_value(state, -1, {key, 0, file->shown_path, {"place"}}, object);
    for (const char* reserved : {"kind", "name", "tag", "line"}) fields.fields.erase(reserved);
    SceneBuilder builder("portrait", colours);
    builder.add_fixture({object, object, std::move(fields), file->path.parent_path(), assets.get()});
    scene = builder.build();
  });
  number_masks(scene, key);
  return scene;
}

Scene world_scene(const std::shared_ptr<const Library>& library, const std::string& world,
                  std::shared_ptr<Assets> assets) {
  assets = assets_of(*library, std::move(assets));
  const ScriptFile* file = library->file(DefinitionKind::world, world);
  if (file == nullptr) throw Error("world '" + world + "'", "there is no such world file");
  ScriptState scripts(library, "");
  const RandomKey key("portrait");
  const std::map<std::string, std::string> axes;
  Scene scene;
  scripts.protect(
      [&](lua_State* state) { scene = TaskReader(scripts, *file, axes, key, *assets).read_world_alone(state); });
  return scene;
}

}  // namespace stampede
