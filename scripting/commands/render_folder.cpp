// Pictures as files.
#include <fmt/format.h>

#include "engine/base/file_name.h"
#include "engine/base/output_file.h"
#include "engine/model/masks.h"
#include "engine/record/observation.h"
#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* kCameraColumns =
    "frame,time_s,camera,width,height,focal_x,focal_y,centre_x,centre_y,k1,k2,p1,p2,k3,near_m,far_m,x,y,z,qx,qy,qz,qw";

std::string masks_csv(const Scene& scene) {
  std::string text = "instance,name,object,class,semantic\n";
  for (const MaskEntry& mask : mask_key(scene))
    text += fmt::format("{},{},{},{},{}\n", mask.instance, mask.name, mask.object, mask.class_name, mask.semantic);
  return text;
}

std::string cameras_csv(const Drawn& drawn) {
  std::string text = std::string(kCameraColumns) + "\n";
  const EpisodeRecord& episode = drawn.stored.episode;
  for (const std::int64_t frame : drawn.rendered.frames) {
    const auto at = static_cast<std::size_t>(frame);
    const double time = static_cast<double>(episode.frames[at].step) / episode.physics_hz;
    for (const CameraTrack& track : drawn.rendered.cameras) {
      if (track.world_from_camera.empty()) continue;
      const Camera& c = track.camera;
      text += fmt::format("{},{},{},{},{},{},{},{},{}", frame, time, c.name, c.width, c.height, c.focal_x, c.focal_y,
                          c.centre_x, c.centre_y);
      for (const double k : c.distortion) text += fmt::format(",{}", k);
      const Pose& pose = track.world_from_camera[at];
      text += fmt::format(",{},{}", c.near_m, c.far_m);
      for (const double value : pose.position) text += fmt::format(",{}", value);
      for (const double value : pose.quaternion) text += fmt::format(",{}", value);
      text += "\n";
    }
  }
  return text;
}

}  // namespace

void write_folder(const fs::path& folder, Drawn& drawn, const OutputRules& rules) {
  const OutputFolder own(folder, "cameras.csv",
                         marked_kind("rendered pictures", "frame,time_s,camera,", kCameraColumns), rules,
                         fmt::format("episode_{:06}", drawn.stored.id));
  FileNames names({"cameras.csv", "masks.csv"});
  std::vector<std::string> folders;
  for (const CameraTrack& track : drawn.rendered.cameras) folders.push_back(names.take(track.camera.name));
  const ImageStore& images = *drawn.rendered.images;
  std::vector<fs::path> files;
  for (std::size_t i = 0; i < images.count(); ++i) {
    const ImageRecord& image = images.record(i);
    const char* ending = image.kind == "points" ? "ply" : "png";
    files.push_back(fs::path(folders[static_cast<std::size_t>(image.camera)]) / file_name(image.kind) /
                    fmt::format("{:06}.{}", image.frame, ending));
  }
  own.check(files);
  own.check({"cameras.csv", "masks.csv"});
  own.write("cameras.csv", cameras_csv(drawn));  // first: by it the folder is known
  own.write("masks.csv", masks_csv(*drawn.stored.scene));
  for (std::size_t i = 0; i < images.count(); ++i) {
    const std::vector<std::uint8_t> bytes = images.read(i);
    own.write(files[i], {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  }
}

}  // namespace stampede::program
