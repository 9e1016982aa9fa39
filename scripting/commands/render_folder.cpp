// Pictures as files.
#include <fmt/format.h>

#include <fstream>

#include "engine/model/masks.h"
#include "scripting/commands/render_output.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// Whole or not at all.
void write_file(const fs::path& path, const char* bytes, std::size_t size) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes, static_cast<std::streamsize>(size));
  file.close();
  if (file) return;
  std::error_code ignored;
  fs::remove(path, ignored);
  throw Error(path.string(), "it could not be written", "is the disk full, or the folder not yours?");
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw Error(path.string(), "the folder cannot be made: " + error.message());
}

std::string masks_csv(const Scene& scene) {
  std::string text = "instance,name,object,class,semantic\n";
  for (const MaskEntry& mask : mask_key(scene))
    text += fmt::format("{},{},{},{},{}\n", mask.instance, mask.name, mask.object, mask.class_name, mask.semantic);
  return text;
}

std::string cameras_csv(const Drawn& drawn) {
  std::string text =
      "frame,time_s,camera,width,height,focal_x,focal_y,centre_x,centre_y,k1,k2,p1,p2,k3,near_m,far_m,x,y,z,qx,qy,qz,"
      "qw\n";
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

void write_folder(const fs::path& folder, Drawn& drawn) {
  const fs::path own = folder / fmt::format("episode_{:06}", drawn.stored.id);
  make_folder(own);
  const std::string masks = masks_csv(*drawn.stored.scene), cameras = cameras_csv(drawn);
  write_file(own / "masks.csv", masks.data(), masks.size());
  write_file(own / "cameras.csv", cameras.data(), cameras.size());
  const ImageStore& images = *drawn.rendered.images;
  for (std::size_t i = 0; i < images.count(); ++i) {
    const ImageRecord& image = images.record(i);
    const std::string& camera = drawn.rendered.cameras[static_cast<std::size_t>(image.camera)].camera.name;
    const fs::path place = own / camera / image.kind;
    if (!fs::exists(place)) make_folder(place);
    const std::vector<std::uint8_t> bytes = images.read(i);
    const char* ending = image.kind == "points" ? "ply" : "png";
    write_file(place / fmt::format("{:06}.{}", image.frame, ending), reinterpret_cast<const char*>(bytes.data()),
               bytes.size());
  }
}

}  // namespace stampede::program
