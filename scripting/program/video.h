// Films: pictures one after another in a file that players show.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>

#include "engine/base/output_file.h"

namespace stampede::program {

// .mp4: H.264, 4:2:0, constant quality; a side that is odd is encoded one pixel longer, its last pixels repeated.
// The file has its name once finish() has returned (engine/base/output_file.h).
// Lifetime: one thread. Repeatable: the same pictures, the same bytes.
// Throws Error with the cure for another ending, a missing codec, a folder that is not there and a full disk.
class VideoWriter {
 public:
  VideoWriter(const std::filesystem::path& file, int width, int height, int rate_hz, const OutputRules& rules = {});
  ~VideoWriter();  // without finish() nothing stays
  VideoWriter(const VideoWriter&) = delete;
  VideoWriter& operator=(const VideoWriter&) = delete;

  void add(std::span<const std::uint8_t> rgb);  // height x width x 3, rows from the top
  void finish();

  // Throws Error when the ending is none that can be written: before anything is drawn.
  static void check_name(const std::filesystem::path& file);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

OutputKind film_kind();  // ours end in a mark that players skip

}  // namespace stampede::program
