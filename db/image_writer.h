// Writes what cameras saw.
#pragma once

#include <string_view>
#include <vector>

#include "db/camera_writer.h"
#include "db/catalogue.h"

namespace stampede {

struct ImageRecord;  // engine/record/observation.h

class ImageWriter {
 public:
  ImageWriter(const sql::Database& database, CameraWriter& cameras);
  void write_masks(std::int64_t id, const EpisodeRecord& episode);  // what their numbers stand for
  void write(std::int64_t id, const EpisodeRecord& episode);
  AddedImages add(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras);

 private:
  int place_camera(std::int64_t id, const CameraTrack& track, std::int64_t frames);
  void write_image(std::int64_t id, const ImageRecord& image, int camera, const std::vector<std::uint8_t>& bytes);
  bool is_stored(std::int64_t id, const ImageRecord& image, int camera, const std::string& name,
                 std::string_view bytes);

  const sql::Database& database_;
  CameraWriter& cameras_;
  sql::Statement mask_, image_, visible_, stored_;
};

// Throws Error for pictures of frames and cameras that are not there, of unknown kinds, or without size.
void check_images(const ImageStore& images, std::int64_t frames, std::size_t cameras, const std::string& where);

}  // namespace stampede
