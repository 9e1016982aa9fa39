// Pictures and states of finished episodes on request, for programs that embed the engine.
#pragma once

#include <cstdint>
#include <memory>

#include "engine/record/record.h"
#include "stampede/picture.h"
#include "stampede/world_state.h"

namespace stampede {

// Keeps what the next picture of the same episode needs again, and draws in a thread of its own. Lifetime: one caller
// at a time, from any thread.
class Studio {
 public:
  Studio();
  ~Studio();
  Studio(Studio&&) noexcept;
  Studio& operator=(Studio&&) noexcept;

  // Throws Error for unknown frames and cameras, and for sizes that cannot be drawn.
  CameraPicture picture(const std::shared_ptr<const EpisodeRecord>& episode, std::int64_t frame,
                        const PictureRequest& request);
  CameraPoints points(const std::shared_ptr<const EpisodeRecord>& episode, std::int64_t frame,
                      const PictureRequest& request);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Throws Error for a frame that is not there.
WorldState world_state(const EpisodeRecord& episode, std::int64_t frame);

}  // namespace stampede
