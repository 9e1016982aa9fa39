#include "scripting/session/studio.h"

#include <optional>

#include "db/stored_episode.h"
#include "engine/record/observation.h"
#include "engine/render/point_cloud.h"
#include "engine/start/abstract_state.h"
#include "scripting/session/render_thread.h"

namespace stampede {
namespace {

Observation observation_for(const PictureRequest& request) {
  Observation observation;
  observation.cameras = {request.camera};
  observation.width = request.width;
  observation.height = request.height;
  observation.kinds = {request.rgb, request.depth, request.instance, request.semantic};
  observation.shadows = request.shadows;
  return observation;
}

}  // namespace

struct Studio::Impl {
  RenderThread thread;
  std::shared_ptr<const EpisodeRecord> episode;  // of the last request
  std::optional<StoredEpisode> stored;           // the same with its scene
  std::vector<Picture> pictures;                 // of the last request: one

  // The view of the picture that is then the first in `pictures`.
  View draw(const std::shared_ptr<const EpisodeRecord>& wanted, std::int64_t frame, const PictureRequest& request);
};

View Studio::Impl::draw(const std::shared_ptr<const EpisodeRecord>& wanted, std::int64_t frame,
                        const PictureRequest& request) {
  if (episode != wanted) {
    stored = stored_of(*wanted);
    episode = wanted;
  }
  const std::string where = "episode of " + episode->task;
  if (!stored->scene) throw Error(where, "it cannot be drawn: " + stored->why_not);
  const auto frames = static_cast<std::int64_t>(stored->episode.frames.size());
  if (frame < 0 || frame >= frames)
    throw Error(where, "it has no frame " + std::to_string(frame),
                "frames count from 0 to " + std::to_string(frames - 1));
  const std::shared_ptr<const Scene> scene = with_cameras(*stored, {}, {request.camera});
  const Observation observation = observation_for(request);
  check_observation(*scene, observation);
  View view;
  thread.run([&](Renderer& renderer) {
    EpisodePainter painter(renderer, stored->episode, scene, observation);
    painter.paint(frame, pictures);
    view = painter.views(frame).front();
  });
  return view;
}

Studio::Studio() : impl_(std::make_unique<Impl>()) {}
Studio::~Studio() = default;
Studio::Studio(Studio&&) noexcept = default;
Studio& Studio::operator=(Studio&&) noexcept = default;

CameraPicture Studio::picture(const std::shared_ptr<const EpisodeRecord>& episode, std::int64_t frame,
                              const PictureRequest& request) {
  const View view = impl_->draw(episode, frame, request);
  Picture& drawn = impl_->pictures.front();
  CameraPicture result;
  result.width = drawn.width;
  result.height = drawn.height;
  result.rgb = std::move(drawn.rgb);
  result.depth = std::move(drawn.depth);
  result.instance = std::move(drawn.instance);
  result.semantic = std::move(drawn.semantic);
  result.focal_x = view.camera.focal_x;
  result.focal_y = view.camera.focal_y;
  result.centre_x = view.camera.centre_x;
  result.centre_y = view.camera.centre_y;
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column)
      result.world_from_camera[static_cast<std::size_t>(4 * row + column)] =
          view.world_from_camera.matrix()(row, column);
  return result;
}

CameraPoints Studio::points(const std::shared_ptr<const EpisodeRecord>& episode, std::int64_t frame,
                            const PictureRequest& request) {
  PictureRequest with_depth = request;
  with_depth.depth = true;
  const View view = impl_->draw(episode, frame, with_depth);
  PointCloud cloud = point_cloud(impl_->pictures.front(), view);
  return {std::move(cloud.positions), std::move(cloud.colours), std::move(cloud.instance), std::move(cloud.semantic)};
}

WorldState world_state(const EpisodeRecord& episode, std::int64_t frame) {
  const AbstractState state = abstract_state(episode, frame);
  WorldState result;
  result.frame = state.frame;
  result.time_s = static_cast<double>(state.frame) / episode.frame_hz;
  Facts all = state.facts;
  all.insert(state.observed.begin(), state.observed.end());
  for (const Fact& fact : all)
    result.facts.push_back({fact.predicate, fact.arguments, state.facts.contains(fact), state.observed.contains(fact)});
  for (const auto& [name, position] : state.joints) {
    const auto fraction = state.joint_fractions.find(name);
    result.joints.push_back({name, position, fraction == state.joint_fractions.end() ? 0 : fraction->second});
  }
  for (const auto& [name, pose] : state.poses) result.objects.push_back({name, pose.position, pose.quaternion});
  for (const auto& [name, opening] : state.openings) result.hands.push_back({name, opening});
  return result;
}

}  // namespace stampede
