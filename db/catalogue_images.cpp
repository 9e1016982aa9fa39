// Pictures that are asked for, or that come later than their episode.
#include "db/catalogue_impl.h"
#include "db/check_numbers.h"
#include "db/episode_writer.h"

namespace stampede {

AddedImages Catalogue::add_images(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras) {
  const sql::Database& database = impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  if (!impl_->writer) impl_->writer = std::make_unique<EpisodeWriter>(database);
  try {
    database.run("BEGIN IMMEDIATE");
    const AddedImages added = impl_->writer->add_images(id, images, cameras);
    database.run("COMMIT");
    return added;
  } catch (...) {
    roll_back(database);
    throw;
  }
}

std::vector<ImageEntry> Catalogue::images(std::int64_t id) const {
  sql::Statement episode(impl_->database, "SELECT frames FROM episode WHERE id = ?1");
  std::int64_t frames = 0;
  if (!episode.start(id).step()) throw_no_episode(impl_->database, id);
  episode.read(frames);
  const std::string here = "episode " + std::to_string(id) + ", a picture's ";
  sql::Statement rows(impl_->database,
                      "SELECT i.frame, c.name, i.kind, i.width, i.height, length(i.data) FROM image i "
                      "JOIN camera c ON c.episode = i.episode AND c.ordinal = i.camera "
                      "WHERE i.episode = ?1 ORDER BY i.frame, i.camera, i.kind");
  std::vector<ImageEntry> list;
  for (rows.start(id); rows.step();) {
    ImageEntry& e = list.emplace_back();
    rows.read(e.frame, e.camera, e.kind, e.width, e.height, e.bytes);
    require_within(impl_->database.path(), here + "frame", e.frame, 0, frames - 1);
    require_within(impl_->database.path(), here + "width", e.width, 1, kMostPixels);
    require_within(impl_->database.path(), here + "height", e.height, 1, kMostPixels);
  }
  return list;
}

std::vector<std::string> Catalogue::read_images(std::int64_t id, const std::vector<std::int64_t>& frames,
                                                std::string_view camera, std::string_view kind) const {
  sql::Statement row(impl_->database,
                     "SELECT i.data FROM image i JOIN camera c ON c.episode = i.episode AND c.ordinal = i.camera "
                     "WHERE i.episode = ?1 AND i.frame = ?2 AND c.name = ?3 AND i.kind = ?4");
  std::vector<std::string> files(frames.size());
  for (std::size_t i = 0; i < frames.size(); ++i)
    if (row.start(id, frames[i], camera, kind).step()) row.read(files[i]);
  return files;
}

std::vector<std::uint8_t> Catalogue::read_image(std::int64_t id, std::int64_t frame, std::string_view camera,
                                                std::string_view kind) const {
  const std::string bytes = read_images(id, {frame}, camera, kind).front();
  if (bytes.empty())
    throw Error(impl_->database.path(),
                "episode " + std::to_string(id) + " has no picture of frame " + std::to_string(frame) + ", camera '" +
                    std::string(camera) + "', kind '" + std::string(kind) + "'",
                "`stampede query images_by_episode` lists what there is; `stampede render --into` adds more");
  return {bytes.begin(), bytes.end()};
}

}  // namespace stampede
