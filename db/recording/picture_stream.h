// Pictures of a recording: which there are, when each was taken, and whether each is whole.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "db/recording/recording_file.h"
#include "db/recording/resample.h"
#include "engine/model/camera.h"
#include "engine/record/observation.h"

namespace stampede {

struct PictureStream {
  std::vector<std::filesystem::path> files;  // in the order of time
  std::vector<std::string> shown;
  std::vector<double> time;  // s, on the recording's time line, strictly rising
  std::string note;          // of pictures that were named twice; empty: none
};

// Throws Error: stamps that do not rise, files that are not there, names that are no stamps, no pictures.
PictureStream read_picture_stream(const RecordingFile& recording, const RecordedStream& stream);

// Width and height of the first picture, by its header. Throws Error.
std::array<int, 2> first_size(const RecordingFile& recording, const RecordedStream& stream);

// What the bytes of a picture say of themselves. Throws Error, which names `where`, for what is no whole PNG or JPEG
// file of the right kind: every chunk of a PNG must agree with its checksum, a JPEG must end where it says.
struct PictureHeader {
  int width = 0, height = 0;
};
PictureHeader check_picture(std::string_view bytes, StreamKind kind, const std::string& where);

// Pictures of the frames, those that are chosen[frame] >= 0, for the store: colours byte by byte as they were recorded,
// depths in our unit, cut to the stream's range. The files are read, checked and hashed when the store is asked for
// them, which throws Error for pictures that are not whole, or of another size than the camera's.
// Result: a digest of the recorded bytes, to be asked for when all of the store has been read.
std::function<std::string()> add_pictures(const RecordedStream& stream, const PictureStream& pictures,
                                          const std::vector<std::int64_t>& chosen, const Camera& camera,
                                          int camera_index, ImageStore& images);

}  // namespace stampede
