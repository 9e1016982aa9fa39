#include "engine/rollout/picture_channels.h"

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/model/camera.h"
#include "engine/record/observation.h"
#include "engine/render/point_cloud.h"

namespace stampede {
namespace {

const Camera& named_camera(const std::vector<Camera>& cameras, const std::string& name) {
  const auto camera = std::find_if(cameras.begin(), cameras.end(), [&](const Camera& one) { return one.name == name; });
  if (camera != cameras.end()) return *camera;
  throw Error("camera '" + name + "'", "there is no such camera", did_you_mean(name, names_of(cameras)));
}

// A row a pixel, in the world; NaN where nothing was seen.
std::vector<float> points_of(const Picture& picture, const View& view) {
  std::vector<float> points(picture.depth.size() * 3, std::numeric_limits<float>::quiet_NaN());
  const PointCloud cloud = point_cloud(picture, view);
  std::size_t next = 0;
  for (std::size_t i = 0; i < picture.depth.size() && next < cloud.positions.size(); ++i)
    if (picture.depth[i] > 0)
      std::copy_n(cloud.positions[next++].begin(), 3, points.begin() + static_cast<std::ptrdiff_t>(3 * i));
  return points;
}

}  // namespace

// What a camera's channels are called, what is drawn for them, and how that becomes a value of height x width.
struct PictureChannelKind {
  const char* suffix;
  PictureKind drawn;
  void (*fill)(const Picture& picture, const View& view, ChannelValue& value);
};
static constexpr std::array<PictureChannelKind, 5> kPictureChannels{{
    {"_rgb", PictureKind::rgb,
     [](const Picture& picture, const View&, ChannelValue& value) {
       value.shape.push_back(3);
       value.data = picture.rgb;
     }},
    {"_depth", PictureKind::depth,
     [](const Picture& picture, const View&, ChannelValue& value) {
       value.unit = "m";
       value.data = picture.depth;
     }},
    {"_mask", PictureKind::instance,
     [](const Picture& picture, const View&, ChannelValue& value) { value.data = picture.instance; }},
    {"_semantic_mask", PictureKind::semantic,
     [](const Picture& picture, const View&, ChannelValue& value) { value.data = picture.semantic; }},
    {"_point_cloud", PictureKind::depth,
     [](const Picture& picture, const View& view, ChannelValue& value) {
       value.unit = "m";
       value.frame = "world";
       value.shape.push_back(3);
       value.data = points_of(picture, view);
     }},
}};

std::vector<Camera> sized_cameras(std::vector<Camera> cameras, const EnvironmentSettings& settings) {
  for (const auto& [name, size] : settings.picture_sizes) named_camera(cameras, name);
  for (Camera& camera : cameras) {
    const auto own = settings.picture_sizes.find(camera.name);
    const PictureSize size =
        own == settings.picture_sizes.end() ? PictureSize{settings.width, settings.height} : own->second;
    if (size.width > 0 && size.height > 0) camera = resized(camera, size.width, size.height);
  }
  return cameras;
}

PictureChannels::PictureChannels(const Rollout& rollout, const EnvironmentSettings& settings, const EpisodeRecord& now,
                                 std::unique_ptr<Renderer>& renderer)
    : rollout_(rollout),
      settings_(settings),
      now_(now),
      facts_that_show_(facts_that_show(*rollout.scene())),
      renderer_(renderer) {}

std::vector<PictureChannels::Channel> PictureChannels::all() const {
  std::vector<Channel> channels;
  for (const Camera& camera : now_.scene.cameras)
    for (const PictureChannelKind& kind : kPictureChannels)
      channels.push_back({camera.name + kind.suffix, camera.name, &kind});
  return channels;
}

void PictureChannels::choose(std::vector<Channel> channels) {
  chosen_ = std::move(channels);
  kinds_.clear();
  for (const Channel& one : chosen_)
    kinds_.try_emplace(one.camera, PictureKinds::none()).first->second.add(one.kind->drawn);
  drawn_.clear();
}

View PictureChannels::view_from(const std::string& camera, const ScenePoses& poses) const {
  return {named_camera(now_.scene.cameras, camera),
          world_from_camera(*rollout_.scene(), poses, named_camera(rollout_.scene()->cameras, camera))};
}

std::vector<Picture> PictureChannels::draw(const std::vector<View>& views, const ScenePoses& poses,
                                           const PictureKinds& kinds) {
  if (!renderer_) renderer_ = make_renderer();
  if (!loaded_) renderer_->load(rollout_.scene());
  loaded_ = true;
  DrawOptions options;
  options.kinds = kinds;
  options.shadows = settings_.shadows;
  options.by = settings_.renderer;
  std::vector<Picture> pictures;
  renderer_->draw(poses, views, options, pictures);
  return pictures;
}

SceneState PictureChannels::state() const {
  SceneState state = state_at(*rollout_.scene(), now_, 0);
  for (const std::vector<std::string>& words : facts_that_show_)
    if (rollout_.facts().facts().contains({words[0], {words.begin() + 1, words.end()}})) state.facts.insert(words);
  return state;
}

ChannelValue PictureChannels::picture(const std::string& camera, PictureSize size) {
  const ScenePoses poses = scene_poses(*rollout_.scene(), state());
  View view = view_from(camera, poses);
  if (size.width > 0 && size.height > 0) view.camera = resized(view.camera, size.width, size.height);
  PictureKinds colours = PictureKinds::none();
  colours.rgb = true;
  Picture picture = std::move(draw({view}, poses, colours).front());
  ChannelValue value;
  value.name = camera + "_rgb";
  value.frame = camera;
  value.shape = {picture.height, picture.width, 3};
  value.data = std::move(picture.rgb);
  return value;
}

void PictureChannels::look(const std::vector<std::string>& cameras) {
  const ScenePoses poses = scene_poses(*rollout_.scene(), state());
  std::vector<View> views;
  PictureKinds kinds = PictureKinds::none();
  for (const std::string& name : cameras) {
    views.push_back(view_from(name, poses));
    for (const PictureKind kind : kPictureKinds)
      if (kinds_.at(name).has(kind)) kinds.add(kind);
  }
  std::vector<Picture> pictures = draw(views, poses, kinds);
  const std::int64_t frame = rollout_.step() / rollout_.steps_per_frame();
  const CameraNoise noise{settings_.rgb_noise, settings_.depth_noise};
  const RandomKey key = RandomKey("camera noise").with(now_.task).with(now_.variation).with(now_.seed);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (noise.any()) add_noise(pictures[i], views[i].camera, noise, key.with(views[i].camera.name).with(frame));
    drawn_[cameras[i]] = {frame, std::move(pictures[i]), views[i]};
  }
}

void PictureChannels::add_to(EnvironmentObservation& observation) {
  std::vector<std::string> due;
  for (const auto& [camera, kinds] : kinds_) {
    const auto rate = settings_.picture_hz.find(camera);
    const auto last = drawn_.find(camera);
    const double period = rate == settings_.picture_hz.end() || !(rate->second > 0) ? 0 : now_.frame_hz / rate->second;
    const bool fresh =
        last != drawn_.end() && (last->second.frame == observation.frame ||
                                 static_cast<double>(observation.frame - last->second.frame) < period - 1e-9);
    if (!fresh) due.push_back(camera);
  }
  if (!due.empty()) look(due);
  for (const Channel& one : chosen_) {
    const Drawn& drawn = drawn_.at(one.camera);
    ChannelValue& value = observation.channels.emplace_back();
    value.name = one.name;
    value.frame = one.camera;
    value.shape = {drawn.picture.height, drawn.picture.width};
    one.kind->fill(drawn.picture, drawn.view, value);
  }
}

}  // namespace stampede
