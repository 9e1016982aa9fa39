#include "db/image_writer.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "db/catalogue_impl.h"
#include "db/count_visible.h"
#include "db/insert.h"
#include "engine/model/camera.h"
#include "engine/record/observation.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 5> kImageKinds{"rgb", "depth", "instance", "semantic", "points"};

std::string_view as_text(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

bool near(double a, double b) { return std::abs(a - b) <= 1e-9 * std::max(1.0, std::abs(a)); }

// Which of two readings of the same camera differ beyond rounding; empty: none. Sizes may.
std::string difference(const Camera& known, const Camera& camera) {
  const Camera same = resized(known, camera.width, camera.height);
  if (same.mount_body != camera.mount_body || same.mount_part != camera.mount_part) return "its mount";
  if (!same.mount_from_camera.isApprox(camera.mount_from_camera, 1e-9)) return "where it is mounted";
  if (!near(same.focal_x, camera.focal_x) || !near(same.focal_y, camera.focal_y)) return "its focal length";
  if (!near(same.centre_x, camera.centre_x) || !near(same.centre_y, camera.centre_y)) return "its principal point";
  if (same.distortion != camera.distortion) return "its lens";
  if (same.near_m != camera.near_m || same.far_m != camera.far_m) return "its near or far plane";
  return {};
}

}  // namespace

void check_images(const ImageStore& images, std::int64_t frames, std::size_t cameras, const std::string& where) {
  const std::string hint = "the pictures were put together wrongly";
  for (std::size_t i = 0; i < images.count(); ++i) {
    const ImageRecord& image = images.record(i);
    if (image.frame < 0 || image.frame >= frames)
      throw Error(
          where,
          "a picture is of frame " + std::to_string(image.frame) + ", and it has " + std::to_string(frames) + " frames",
          hint);
    if (image.camera < 0 || image.camera >= static_cast<int>(cameras))
      throw Error(where, "a picture is of camera number " + std::to_string(image.camera) + ", which is not there",
                  hint);
    if (std::find(kImageKinds.begin(), kImageKinds.end(), image.kind) == kImageKinds.end())
      throw Error(where, "a picture is of the unknown kind '" + image.kind + "'",
                  "the kinds are rgb, depth, instance, semantic and points");
    if (image.width <= 0 || image.height <= 0) throw Error(where, "a picture has no size", hint);
  }
}

ImageWriter::ImageWriter(const sql::Database& database, CameraWriter& cameras)
    : database_(database),
      cameras_(cameras),
      mask_(insert(database, "mask", "episode, instance, name, object, class, semantic, colour")),
      image_(insert(database, "image", "episode, frame, camera, kind, width, height, data")),
      visible_(insert(database, "mask_pixels", "episode, frame, camera, instance, pixels")),
      stored_(database, "SELECT data FROM image WHERE episode = ?1 AND frame = ?2 AND camera = ?3 AND kind = ?4",
              true) {}

void ImageWriter::write_masks(std::int64_t id, const EpisodeRecord& episode) {
  std::map<std::string, std::string> colours;
  for (const Object& object : episode.scene.objects)
    if (const auto colour = object.attributes.find("colour"); colour != object.attributes.end())
      colours.emplace(object.name, colour->second);
  for (const MaskEntry& m : episode.scene.masks) {
    const auto colour = colours.find(m.object);
    mask_.run(id, m.instance, m.name, m.object, m.class_name, m.semantic,
              colour == colours.end() ? std::nullopt : std::optional(colour->second));
  }
}

void ImageWriter::write_image(std::int64_t id, const ImageRecord& image, int camera,
                              const std::vector<std::uint8_t>& bytes) {
  image_.run(id, image.frame, camera, image.kind, image.width, image.height, sql::Blob{as_text(bytes)});
  if (image.kind != "instance") return;
  const auto visible = image.visible.empty() ? visible_pixels(bytes) : image.visible;  // who painted it counted already
  for (const auto& [instance, pixels] : visible) visible_.run(id, image.frame, camera, instance, pixels);
}

// One picture in memory at a time, and one for each thread that makes some.
void ImageWriter::write(std::int64_t id, const EpisodeRecord& episode) {
  if (!episode.images) return;
  episode.images->read_all([&](const ImageRecord& image, const std::vector<std::uint8_t>& bytes) {
    write_image(id, image, image.camera, bytes);
  });
}

int ImageWriter::place_camera(std::int64_t id, const CameraTrack& track, std::int64_t frames) {
  const std::string where = "episode " + std::to_string(id) + ", camera " + track.camera.name;
  std::string question = "SELECT ";  // piece by piece: GCC 12 warns of a sum of these where there is nothing wrong
  question += kCameraColumns;
  question += ", ordinal FROM camera WHERE episode = ?1 AND name = ?2";
  sql::Statement find(database_, question);
  if (find.start(id, track.camera.name).step()) {
    Camera known;
    read_camera(find, known);
    const std::string other = difference(known, track.camera);
    if (!other.empty())
      throw Error(where, "the episode has another camera of this name: " + other + " differs",
                  "give the new camera a name of its own, or render into a folder");
    return sqlite3_column_int(find.handle(), sqlite3_column_count(find.handle()) - 1);
  }
  if (static_cast<std::int64_t>(track.world_from_camera.size()) != frames)
    throw Error(where, "a new camera needs its pose at each of the " + std::to_string(frames) + " frames, not " +
                           std::to_string(track.world_from_camera.size()));
  sql::Statement last(database_, "SELECT coalesce(max(ordinal), -1) + 1 FROM camera WHERE episode = ?1");
  int ordinal = 0;
  if (last.start(id).step()) last.read(ordinal);
  cameras_.write(id, ordinal, track.camera);
  cameras_.write_poses(id, ordinal, track.world_from_camera.size(),
                       [&](std::size_t frame) { return &track.world_from_camera[frame]; });
  return ordinal;
}

// Throws Error when other bytes are stored there.
bool ImageWriter::is_stored(std::int64_t id, const ImageRecord& image, int camera, const std::string& name,
                            std::string_view bytes) {
  if (!stored_.start(id, image.frame, camera, image.kind).step()) return false;
  const auto* data = static_cast<const char*>(sqlite3_column_blob(stored_.handle(), 0));
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(stored_.handle(), 0));
  const bool same = std::string_view(data ? data : "", size) == bytes;
  sqlite3_reset(stored_.handle());
  if (same) return true;
  throw Error("episode " + std::to_string(id) + ", frame " + std::to_string(image.frame) + ", camera " + name +
                  ", kind " + image.kind,
              "another picture is stored there: it was made with another size, noise, light or version",
              "remove the stored ones, or render into a folder (--out)");
}

AddedImages ImageWriter::add(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras) {
  sql::Statement episode(database_, "SELECT frames FROM episode WHERE id = ?1");
  std::int64_t frames = 0;
  if (!episode.start(id).step()) throw_no_episode(database_, id);
  episode.read(frames);
  check_images(images, frames, cameras.size(), "episode " + std::to_string(id));
  std::vector<std::optional<int>> ordinals(cameras.size());  // of the cameras that pictures are of
  for (std::size_t i = 0; i < images.count(); ++i) {
    const auto camera = static_cast<std::size_t>(images.record(i).camera);
    if (!ordinals[camera]) ordinals[camera] = place_camera(id, cameras[camera], frames);
  }
  AddedImages result;
  for (std::size_t i = 0; i < images.count(); ++i) {
    const ImageRecord& image = images.record(i);
    const auto camera = static_cast<std::size_t>(image.camera);
    const std::vector<std::uint8_t> bytes = images.read(i);
    if (is_stored(id, image, *ordinals[camera], cameras[camera].camera.name, as_text(bytes))) {
      ++result.skipped;
      continue;
    }
    write_image(id, image, *ordinals[camera], bytes);
    ++result.added;
  }
  return result;
}

}  // namespace stampede
