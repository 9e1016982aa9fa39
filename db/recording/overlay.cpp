#include "db/recording/overlay.h"

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/base/text.h"
#include "engine/model/camera.h"
#include "engine/model/masks.h"
#include "engine/record/observation.h"
#include "engine/render/png.h"

namespace stampede {
namespace {

constexpr std::array<double, 3> kTint{255, 140, 0};
constexpr double kRanges = 32;  // of a picture's width, at least: in a small one other edges are nearer
constexpr std::array<std::uint8_t, 3> kOutline{0, 255, 120};
constexpr double kTintShare = 0.35;

class Overlayer {
 public:
  Overlayer(Renderer& renderer, const Catalogue& catalogue, const StoredEpisode& stored, const OverlayRequest& request)
      : renderer_(renderer), catalogue_(catalogue), stored_(stored), scene_(*stored.scene), request_(request) {
    renderer_.load(stored.scene);
    for (const MaskEntry& mask : mask_key(scene_))
      if (mask.name.starts_with(scene_.robot.name + ".")) robot_.push_back(mask.instance);
    for (const ImageTimeRecord& one : stored_.episode.image_times)
      if (one.kind == "rgb")
        taken_[{one.frame, stored_.episode.scene.cameras.at(static_cast<std::size_t>(one.camera)).name}] = one.time_s;
    for (const JointName& joint : stored_.episode.scene.joints) {
      const auto& arm = scene_.robot.arm;
      arm_.push_back(joint.part.body < 0 && std::find(arm.begin(), arm.end(), joint.part.part) != arm.end());
    }
  }

  Overlays run(const std::function<void(const OverlayPicture&)>& keep) {
    Overlays result;
    std::map<std::string, std::vector<OutlinePoint>> points;
    std::map<std::string, std::int64_t> pictures;
    const std::vector<std::string> unknown = uncalibrated();
    for (const ImageEntry& entry : catalogue_.images(stored_.id)) {
      if (entry.kind != "rgb" || !wanted(entry)) continue;
      if (std::find(unknown.begin(), unknown.end(), entry.camera) != unknown.end()) {
        if (std::find(result.left_out.begin(), result.left_out.end(), entry.camera) == result.left_out.end())
          result.left_out.push_back(entry.camera);
        continue;
      }
      const auto poses = poses_at(entry);
      if (!poses) continue;
      overlay(entry, *poses, points[entry.camera], keep);
      ++pictures[entry.camera];
    }
    for (const auto& [camera, list] : points) result.cameras.push_back({camera, pictures[camera], alignment_of(list)});
    return result;
  }

 private:
  std::vector<std::string> uncalibrated() const {
    const auto found = stored_.episode.made.options.find("uncalibrated");
    if (found == stored_.episode.made.options.end()) return {};
    std::vector<std::string> names = split(found->second, ',');
    // Whoever gives another calibration has measured it.
    std::erase_if(names, [&](const std::string& name) {
      const Camera& drawn = camera_named(name);
      return std::any_of(
          stored_.episode.scene.cameras.begin(), stored_.episode.scene.cameras.end(), [&](const Camera& own) {
            return own.name == name &&
                   (!own.mount_from_camera.isApprox(drawn.mount_from_camera) || own.focal_x != drawn.focal_x);
          });
    });
    return names;
  }
  const Camera& camera_named(const std::string& name) const {
    for (const Camera& camera : scene_.cameras)
      if (camera.name == name) return camera;
    throw Error("camera '" + name + "'", "the scene has no such camera", did_you_mean(name, names_of(scene_.cameras)));
  }
  bool wanted(const ImageEntry& entry) const {
    const auto& cameras = request_.cameras;
    if (!cameras.empty() && std::find(cameras.begin(), cameras.end(), entry.camera) == cameras.end()) return false;
    return std::binary_search(request_.frames.begin(), request_.frames.end(), entry.frame);
  }

  // Where all is when the picture was taken; nothing where the arm is not known then.
  std::optional<ScenePoses> poses_at(const ImageEntry& entry) const {
    const EpisodeRecord& episode = stored_.episode;
    const auto& frames = episode.frames;
    SceneState state = state_at(scene_, episode, entry.frame);
    const auto taken = taken_.find({entry.frame, entry.camera});
    const auto here = static_cast<std::size_t>(entry.frame);
    const double frame_s = static_cast<double>(frames[here].step) / episode.physics_hz;
    const double share = taken == taken_.end() ? 0 : (taken->second - frame_s) * episode.frame_hz;  // -0.5 … 0.5
    const std::size_t other = share < 0 && here > 0                   ? here - 1
                              : share > 0 && here + 1 < frames.size() ? here + 1
                                                                      : here;
    for (std::size_t i = 0; i < episode.scene.joints.size(); ++i) {
      const PartRef part = episode.scene.joints[i].part;
      if (part.body >= 0) continue;
      const double now = frames[here].joint_position[i], then = frames[other].joint_position[i];
      if (arm_[i] && (std::isnan(now) || std::isnan(then))) return std::nullopt;
      if (!std::isnan(now) && !std::isnan(then))
        state.robot_position[static_cast<std::size_t>(part.part)] = now + std::abs(share) * (then - now);
    }
    return scene_poses(scene_, state);
  }

  void overlay(const ImageEntry& entry, const ScenePoses& poses, std::vector<OutlinePoint>& points,
               const std::function<void(const OverlayPicture&)>& keep) {
    Picture real;
    from_file(catalogue_.read_image(stored_.id, entry.frame, entry.camera, "rgb"), PictureKind::rgb, real);
    const Camera& camera = camera_named(entry.camera);
    const View view{
        camera.width == real.width && camera.height == real.height ? camera : resized(camera, real.width, real.height),
        world_from_camera(scene_, poses, camera)};
    DrawOptions options;
    options.kinds = PictureKinds::none();
    options.kinds.add(PictureKind::instance);
    renderer_.draw(poses, {&view, 1}, options, drawn_);
    std::vector<std::uint8_t> mask(drawn_[0].instance.size());
    for (std::size_t i = 0; i < mask.size(); ++i)
      mask[i] = std::find(robot_.begin(), robot_.end(), drawn_[0].instance[i]) != robot_.end() ? 1 : 0;
    AlignmentOptions alignment = request_.alignment;
    alignment.range_px = std::min(alignment.range_px, real.width / kRanges);
    const std::vector<OutlinePoint> found = outline_offsets(mask, real.rgb, real.width, real.height, alignment);
    points.insert(points.end(), found.begin(), found.end());
    if (keep) keep(tinted(entry, real, mask));
  }

  static OverlayPicture tinted(const ImageEntry& entry, const Picture& real, const std::vector<std::uint8_t>& mask) {
    OverlayPicture picture{entry.frame, entry.camera, real.width, real.height, real.rgb};
    const auto width = static_cast<std::size_t>(real.width);
    for (std::size_t i = 0; i < mask.size(); ++i) {
      if (mask[i] == 0) continue;
      const std::size_t x = i % width;
      const bool edge = (x > 0 && mask[i - 1] == 0) || (x + 1 < width && mask[i + 1] == 0) ||
                        (i >= width && mask[i - width] == 0) || (i + width < mask.size() && mask[i + width] == 0);
      for (std::size_t c = 0; c < 3; ++c) {
        std::uint8_t& value = picture.rgb[3 * i + c];
        value = edge ? kOutline[c] : static_cast<std::uint8_t>((1 - kTintShare) * value + kTintShare * kTint[c]);
      }
    }
    return picture;
  }

  Renderer& renderer_;
  const Catalogue& catalogue_;
  const StoredEpisode& stored_;
  const Scene& scene_;
  const OverlayRequest& request_;
  std::vector<int> robot_;  // its instances
  std::map<std::pair<std::int64_t, std::string>, double> taken_;
  std::vector<bool> arm_;  // which of the episode's joints are the arm's
  std::vector<Picture> drawn_;
};

}  // namespace

Overlays overlays_of(Renderer& renderer, const Catalogue& catalogue, const StoredEpisode& stored,
                     const OverlayRequest& request, const std::function<void(const OverlayPicture&)>& keep) {
  return Overlayer(renderer, catalogue, stored, request).run(keep);
}

}  // namespace stampede
