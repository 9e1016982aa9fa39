// A stored episode as what can be drawn: its record, its scene, its cameras.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "engine/record/record.h"

namespace stampede {

class ImageStore;
class Renderer;
struct Observation;

struct StoredEpisode {
  std::int64_t id = 0;
  EpisodeRecord episode;
  std::shared_ptr<const Scene> scene;  // null: nothing can be drawn
  std::string why_not;                 // then in words
};

StoredEpisode stored_of(EpisodeRecord episode, std::int64_t id = 0);
// Without scripts: from the catalogue alone. Throws Error for an unknown id.
StoredEpisode read_stored(const Catalogue& catalogue, std::int64_t id);

// The scene with these cameras beside its own. A camera of `named` that pictures made later brought along is there too.
std::shared_ptr<const Scene> with_cameras(const StoredEpisode& stored, const std::vector<Camera>& further,
                                          const std::vector<std::string>& named);

// Pictures of these frames, encoded; the image's camera is an index into the result's cameras. Stops early and gives
// nothing when `stop` is set.
struct RenderedEpisode {
  std::shared_ptr<ImageStore> images;
  std::vector<CameraTrack> cameras;  // that were drawn, at the size of their pictures, with the poses of all frames
  std::vector<std::int64_t> frames;  // that were drawn
};
RenderedEpisode render_stored(Renderer& renderer, const StoredEpisode& stored, const Observation& observation,
                              const std::vector<std::int64_t>& frames, const std::atomic<bool>* stop);

}  // namespace stampede
