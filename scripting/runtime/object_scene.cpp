#include "scripting/runtime/object_scene.h"

#include <lua.hpp>

#include "engine/model/masks.h"
#include "scripting/runtime/assets.h"
#include "scripting/runtime/evaluate.h"
#include "scripting/runtime/scene_builder.h"
#include "scripting/runtime/script_state.h"
#include "scripting/runtime/world_reader.h"

namespace stampede {

Scene object_scene(std::shared_ptr<const Library> library, const std::string& object) {
  const ScriptFile* file = library->file(DefinitionKind::object, object);
  if (file == nullptr) throw Error("object '" + object + "'", "there is no such object file");
  ScriptState scripts(library, "");
  Assets assets(FileScope(library->roots().folders));
  const RandomKey key("portrait");
  Scene scene;
  scripts.protect([&](lua_State* state) {
    const Colours colours = read_colours(state, key);
    scripts.definitions().push(DefinitionKind::object, object);
    Value fields = read_value(state, -1, {key, 0, file->shown_path, {}}, object);
    for (const char* reserved : {"kind", "name", "tag", "line"}) fields.fields.erase(reserved);
    SceneBuilder builder("portrait", colours);
    builder.add_fixture({object, object, std::move(fields), file->path.parent_path(), &assets});
    scene = builder.build();
  });
  number_masks(scene, key);
  return scene;
}

}  // namespace stampede
