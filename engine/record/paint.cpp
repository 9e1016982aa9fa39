// Pictures of recorded frames.
#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"
#include "engine/model/camera.h"
#include "engine/record/encode_queue.h"
#include "engine/record/observation.h"

namespace stampede {
namespace {

constexpr int kMostPixels = 4096;

int camera_index(const Scene& scene, const std::string& name) {
  for (std::size_t i = 0; i < scene.cameras.size(); ++i)
    if (scene.cameras[i].name == name) return static_cast<int>(i);
  throw Error("camera '" + name + "'", "the scene has no such camera", did_you_mean(name, names_of(scene.cameras)));
}

}  // namespace

void check_observation(const Scene& scene, const Observation& observation) {
  for (const std::string& name : observation.cameras) camera_index(scene, name);
  const std::vector<std::string> sensors = channel_names(scene);
  for (const std::string& name : observation.channels)
    if (name != "*" && std::find(sensors.begin(), sensors.end(), name) == sensors.end())
      throw Error("channel '" + name + "'", "the world has no such sensor", did_you_mean(name, sensors));
  if (!observation.torque_model.empty()) of_arm(observation.torque_model, arm_joints(scene.robot));
  const bool own = observation.width == 0 && observation.height == 0;
  for (const int pixels : {observation.width, observation.height})
    if (!own && (pixels < 1 || pixels > kMostPixels))
      throw Error("images", "a picture of " + std::to_string(pixels) + " pixels a side cannot be made",
                  "choose 1 to " + std::to_string(kMostPixels));
}

// Of a real episode, where a joint is not known at a frame, its last known position; nothing before the first.
std::optional<double> last_known(const EpisodeRecord& episode, std::int64_t frame, std::size_t joint) {
  for (; frame >= 0; --frame) {
    const double position = episode.frames[static_cast<std::size_t>(frame)].joint_position.at(joint);
    if (!std::isnan(position)) return position;
  }
  return std::nullopt;
}

SceneState state_at(const Scene& scene, const EpisodeRecord& episode, std::int64_t frame) {
  const FrameRecord& recorded = episode.frames.at(static_cast<std::size_t>(frame));
  SceneState state = initial_state(scene);
  for (std::size_t i = 0; i < episode.scene.joints.size(); ++i) {
    const PartRef ref = episode.scene.joints[i].part;
    if (ref.part == 0) continue;  // a body of its own, which has a pose
    auto& positions = ref.body < 0 ? state.robot_position : state.joint_position.at(static_cast<std::size_t>(ref.body));
    if (const auto position = last_known(episode, frame, i))
      positions.at(static_cast<std::size_t>(ref.part)) = *position;
  }
  for (std::size_t i = 0; i < episode.scene.posed.size(); ++i) {
    const Object* object = scene.object(episode.scene.posed[i]);
    if (object == nullptr) continue;
    if (object->kind == ObjectKind::body) {
      const int body = scene.body_index(object->body);
      if (body >= 0 && scene.bodies[static_cast<std::size_t>(body)].free)
        state.world_from_body[static_cast<std::size_t>(body)] = to_transform(recorded.object_pose.at(i));
    } else if (object->kind == ObjectKind::region) {
      const int region = scene.region_index(object->name);
      if (region >= 0)
        state.world_from_region[static_cast<std::size_t>(region)] = to_transform(recorded.object_pose.at(i));
    }
  }
  for (const std::vector<std::string>& words : facts_that_show(scene)) {
    const Fact fact{words[0], {words.begin() + 1, words.end()}};
    for (const FactRecord& known : episode.labels.facts)
      if (known.fact == fact && known.first_frame <= frame && (frame < known.end_frame || known.open_end))
        state.facts.insert(words);
  }
  return state;
}

struct EpisodePainter::Impl {
  Renderer& renderer;
  const EpisodeRecord& episode;
  std::shared_ptr<const Scene> scene;
  Observation observation;
  DrawOptions options;
  std::vector<int> cameras;

  std::vector<View> views_of(const ScenePoses& poses) const {
    std::vector<View> views;
    for (const int index : cameras) {
      const Camera& camera = scene->cameras[static_cast<std::size_t>(index)];
      View& view = views.emplace_back();
      view.camera = observation.width > 0 ? resized(camera, observation.width, observation.height) : camera;
      view.world_from_camera = world_from_camera(*scene, poses, camera);
    }
    return views;
  }
};

EpisodePainter::EpisodePainter(Renderer& renderer, const EpisodeRecord& episode, std::shared_ptr<const Scene> scene,
                               const Observation& observation)
    : impl_(new Impl{renderer, episode, std::move(scene), observation, {}, {}}) {
  impl_->options.kinds = observation.kinds;
  if (observation.points) impl_->options.kinds.depth = true;
  impl_->options.shadows = observation.shadows;
  impl_->options.by = observation.renderer;
  if (observation.cameras.empty())
    for (std::size_t i = 0; i < impl_->scene->cameras.size(); ++i) impl_->cameras.push_back(static_cast<int>(i));
  std::set<int> named;
  for (const std::string& name : observation.cameras) named.insert(camera_index(*impl_->scene, name));
  impl_->cameras.insert(impl_->cameras.end(), named.begin(), named.end());
  renderer.load(impl_->scene);
}

EpisodePainter::~EpisodePainter() = default;

const std::vector<int>& EpisodePainter::cameras() const { return impl_->cameras; }

std::vector<View> EpisodePainter::views(std::int64_t frame) const {
  return impl_->views_of(scene_poses(*impl_->scene, state_at(*impl_->scene, impl_->episode, frame)));
}

void EpisodePainter::paint(std::int64_t frame, std::vector<Picture>& pictures) {
  const Impl& own = *impl_;
  const ScenePoses poses = scene_poses(*own.scene, state_at(*own.scene, own.episode, frame));
  const std::vector<View> views = own.views_of(poses);
  own.renderer.draw(poses, views, own.options, pictures);
  if (!own.observation.noise.any()) return;
  const RandomKey key =
      RandomKey("camera noise").with(own.episode.task).with(own.episode.variation).with(own.episode.seed);
  for (std::size_t i = 0; i < views.size(); ++i)
    add_noise(pictures[i], views[i].camera, own.observation.noise, key.with(views[i].camera.name).with(frame));
}

std::vector<std::int64_t> wanted_frames(const EpisodeRecord& episode, WhichFrames which) {
  const auto count = static_cast<std::int64_t>(episode.frames.size());
  std::set<std::int64_t> frames;
  if (which == WhichFrames::all)
    for (std::int64_t frame = 0; frame < count; ++frame) frames.insert(frames.end(), frame);
  if (which == WhichFrames::keyframes && count > 0) {
    frames = {0, count - 1};
    for (const auto& [method, list] : episode.labels.keyframes) frames.insert(list.begin(), list.end());
    for (const SegmentRecord& segment : episode.labels.segments)
      if (segment.kind == SegmentKind::skill && segment.span.first_frame < count)
        frames.insert(segment.span.first_frame);
  }
  return {frames.begin(), frames.end()};
}

void paint_frames(EpisodePainter& painter, const Observation& observation, const std::vector<std::int64_t>& frames,
                  ImageStore& images, int encoders) {
  EncodeQueue queue(observation, painter.cameras(), images, frames.size() > 1 ? encoders : 0);
  std::vector<Picture> pictures;
  for (const std::int64_t frame : frames) {
    heed_stop();
    painter.paint(frame, pictures);
    queue.add(frame, pictures, observation.points ? painter.views(frame) : std::vector<View>{});
  }
  queue.finish();
}

void paint_episode(Renderer& renderer, EpisodeRecord& episode, int encoders) {
  const Observation observation = chosen(observation_of(episode));
  if (observation.images == WhichFrames::none || episode.frames.empty()) return;
  EpisodePainter painter(renderer, episode, std::make_shared<const Scene>(scene_from_document(episode.scene.document)),
                         observation);
  const auto images = std::make_shared<ImageStore>();
  paint_frames(painter, observation, wanted_frames(episode, observation.images), *images, encoders);
  episode.images = images;
}

}  // namespace stampede
