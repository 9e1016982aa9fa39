#include "db/stored_episode.h"

#include <algorithm>

#include "engine/model/camera.h"
#include "engine/record/observation.h"
#include "engine/render/renderer.h"

namespace stampede {
namespace {

// Cameras are stored beside the scene too: what each is mounted on is there.
void check_mounts(const EpisodeRecord& episode, const Scene& scene, std::int64_t id) {
  for (const Camera& camera : episode.scene.cameras) {
    if (camera.mount_body.empty()) continue;
    const bool on_robot = camera.mount_body == scene.robot.name;
    const int body = scene.body_index(camera.mount_body);
    const auto parts = on_robot || body >= 0 ? scene.body_at(body).parts.size() : 0;
    if (camera.mount_part < 0 || static_cast<std::size_t>(camera.mount_part) >= parts)
      throw CatalogueError(
          "episode " + std::to_string(id),
          "a camera is mounted on part " + std::to_string(camera.mount_part) + " of a body, which is not in its scene",
          "the file was damaged or changed by hand: take a copy of it, or generate it again");
  }
}

}  // namespace

StoredEpisode stored_of(EpisodeRecord episode, std::int64_t id) {
  StoredEpisode stored{id, std::move(episode), nullptr, {}};
  if (stored.episode.scene.document.empty()) {
    stored.why_not = "it has no scene: no start was found";
  } else if (stored.episode.frames.empty()) {
    stored.why_not = "it has no frames: no start was found";
  } else {
    stored.scene = std::make_shared<const Scene>(scene_from_document(stored.episode.scene.document));
    check_mounts(stored.episode, *stored.scene, id);
  }
  return stored;
}

StoredEpisode read_stored(const Catalogue& catalogue, std::int64_t id) {
  return stored_of(catalogue.read_episode(id), id);
}

std::shared_ptr<const Scene> with_cameras(const StoredEpisode& stored, const std::vector<Camera>& further,
                                          const std::vector<std::string>& named) {
  Scene scene = *stored.scene;
  std::vector<Camera> cameras;
  for (const Camera& camera : stored.episode.scene.cameras) {
    const bool wanted = std::find(named.begin(), named.end(), camera.name) != named.end();
    const bool known = std::any_of(scene.cameras.begin(), scene.cameras.end(),
                                   [&](const Camera& other) { return other.name == camera.name; });
    if (wanted && !known) cameras.push_back(camera);
  }
  cameras.insert(cameras.end(), further.begin(), further.end());
  if (cameras.empty()) return stored.scene;
  put_cameras(scene, cameras);
  return std::make_shared<const Scene>(std::move(scene));
}

RenderedEpisode render_stored(Renderer& renderer, const StoredEpisode& stored, const Observation& observation,
                              const std::vector<std::int64_t>& frames, const std::atomic<bool>* stop) {
  EpisodePainter painter(renderer, stored.episode, stored.scene, observation);
  RenderedEpisode rendered{std::make_shared<ImageStore>(), {}, {}};
  for (const std::int64_t frame : frames) {
    if (stop && stop->load()) return {};
    paint_frames(painter, observation, {frame}, *rendered.images);
    rendered.frames.push_back(frame);
  }
  for (const Camera& camera : stored.scene->cameras) rendered.cameras.push_back({camera, {}});
  for (std::size_t frame = 0; frame < stored.episode.frames.size(); ++frame) {
    const std::vector<View> views = painter.views(static_cast<std::int64_t>(frame));
    for (std::size_t i = 0; i < views.size(); ++i) {
      CameraTrack& track = rendered.cameras[static_cast<std::size_t>(painter.cameras()[i])];
      track.camera = views[i].camera;
      track.world_from_camera.push_back(to_pose(views[i].world_from_camera));
    }
  }
  return rendered;
}

}  // namespace stampede
