#include "db/count_visible.h"

#include "engine/render/png.h"

namespace stampede {

std::vector<std::pair<int, std::int64_t>> visible_pixels(std::span<const std::uint8_t> png) {
  Picture picture;
  from_png(png, PictureKind::instance, picture);
  return visible_pixels(picture);
}

void count_stored_masks(const sql::Database& database, std::optional<std::int64_t> of_episode) {
  sql::Statement masks(database,
                       "SELECT episode, frame, camera, data FROM image WHERE kind = 'instance' AND (?1 IS NULL OR "
                       "episode = ?1)");
  sql::Statement visible(
      database, "INSERT INTO mask_pixels (episode, frame, camera, instance, pixels) VALUES (?1, ?2, ?3, ?4, ?5)");
  for (masks.start(of_episode); masks.step();) {
    std::int64_t episode = 0, frame = 0, camera = 0;
    std::string png;
    masks.read(episode, frame, camera, png);
    for (const auto& [instance, pixels] :
         visible_pixels({reinterpret_cast<const std::uint8_t*>(png.data()), png.size()}))
      visible.run(episode, frame, camera, instance, pixels);
  }
}

}  // namespace stampede
