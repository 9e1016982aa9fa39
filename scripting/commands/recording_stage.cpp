#include "scripting/commands/recording_stage.h"

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "scripting/runtime/stage.h"

namespace stampede::program {

RecordingStager stager_of(std::shared_ptr<const Library> library) {
  return [library = std::move(library)](const RecordingFile& recording) {
    if (recording.urdf.empty() && library->file(DefinitionKind::robot, recording.robot) == nullptr)
      throw Error(recording.shown, "there is no robot '" + recording.robot + "'",
                  did_you_mean(recording.robot, names_of(library->files(DefinitionKind::robot))) +
                      "; of a robot that is none of ours, give `robot.urdf`");
    StageRequest request;
    request.world = recording.world;
    request.robot = recording.robot;
    request.robot_fields = recording.robot_fields;
    request.world_from_base = recording.world_from_base;
    request.where = recording.shown;
    if (!recording.urdf.empty()) request.urdf = recording.path_of(recording.urdf, recording.shown);
    Stage stage = stage_of(library, request);
    RecordingStage result{std::move(stage.scene), {}};
    for (const ScriptFile* file : stage.files)
      result.definitions.push_back(
          {std::string(to_string(file->kind)), file->name, file->shown_path, file->source, file->hash});
    return result;
  };
}

}  // namespace stampede::program
