#include "db/recording/recording_scene.h"

#include <algorithm>
#include <numbers>

#include "db/recording/picture_stream.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/text_file.h"
#include "engine/model/camera.h"

namespace stampede {
namespace {

constexpr double kStandInView = std::numbers::pi / 4;  // vertical, rad

void add_stand_ins(const RecordingFile& recording, RecordingScene& scene) {
  std::vector<Camera>& cameras = scene.stage.scene.cameras;
  for (const RecordedStream& stream : recording.streams) {
    if (!stream.pictures()) continue;
    const auto named = [&](const Camera& camera) { return camera.name == stream.name; };
    if (std::any_of(cameras.begin(), cameras.end(), named)) continue;
    if (!recording.cameras.empty())
      throw Error(stream.place, "the camera file has no camera '" + stream.name + "'",
                  did_you_mean(stream.name, names_of(cameras)));
    const std::array<int, 2> size = first_size(recording, stream);
    Camera camera;
    camera.name = stream.name;
    set_field_of_view(camera, kStandInView, size[0], size[1]);
    cameras.push_back(camera);
    scene.uncalibrated.insert(stream.name);
  }
  std::sort(cameras.begin(), cameras.end(), [](const Camera& a, const Camera& b) { return a.name < b.name; });
}

}  // namespace

RecordingScene scene_of(const RecordingFile& recording, const RecordingStager& stager, Hasher& hasher) {
  if (!recording.urdf.empty()) hasher.text(read_text_file(recording.path_of(recording.urdf, recording.shown)));
  RecordingScene scene{stager(recording), {}};
  for (const DefinitionRecord& definition : scene.stage.definitions) hasher.text(definition.hash);
  Scene& around = scene.stage.scene;
  around.cameras.clear();
  around.sensors.clear();
  around.frame_hz = recording.frame_hz;
  if (!recording.cameras.empty()) {
    const std::filesystem::path file = recording.path_of(recording.cameras, recording.shown);
    hasher.text(read_text_file(file));
    put_cameras(around, load_calibration(file, around));
  }
  add_stand_ins(recording, scene);
  return scene;
}

}  // namespace stampede
