#include "scripting/runtime/stage.h"

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/model/masks.h"
#include "scripting/runtime/task_reader.h"

namespace stampede {
namespace {

const ScriptFile& file_of(const Library& library, DefinitionKind kind, const std::string& name,
                          const std::string& where) {
  if (const ScriptFile* file = library.file(kind, name)) return *file;
  throw Error(where, "there is no " + std::string(to_string(kind)) + " '" + name + "'",
              did_you_mean(name, names_of(library.files(kind))));
}

}  // namespace

Stage stage_of(const std::shared_ptr<const Library>& library, const StageRequest& request,
               std::shared_ptr<Assets> assets) {
  std::vector<std::filesystem::path> folders = library->roots().folders;
  if (!request.urdf.empty()) folders.push_back(request.urdf.parent_path());
  if (!assets) assets = std::make_shared<Assets>(FileScope(folders));
  ScriptFile own;  // what complaints about a robot that no file describes begin with
  own.shown_path = request.where;
  const ScriptFile* file = &own;
  if (request.urdf.empty()) file = &file_of(*library, DefinitionKind::robot, request.robot, request.where);
  if (!request.world.empty()) file = &file_of(*library, DefinitionKind::world, request.world, request.where);
  const RandomKey key = RandomKey("stage").with(request.world).with(request.robot);
  const std::map<std::string, std::string> axes;
  ScriptState scripts(library, "");
  Stage stage;
  scripts.protect(
      [&](lua_State* state) { stage = TaskReader(scripts, *file, axes, key, *assets).read_stage(state, request); });
  library->require_sound(stage.files);
  number_masks(stage.scene, key.with("masks"));
  return stage;
}

}  // namespace stampede
