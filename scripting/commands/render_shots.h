// An episode as a film maker sees it: stretches with one camera each, the one that sees most of what happens there.
#pragma once

#include "db/stored_episode.h"
#include "engine/render/renderer.h"

namespace stampede::program {

// An outermost skill segment and what follows it until the next. Lifetime: the episode's.
struct Shot {
  const SegmentRecord* skill = nullptr;         // null: the episode has none
  std::vector<std::string> things;              // what it is about: objects and their parts, else the hand; no fixtures
  std::int64_t first_frame = 0, end_frame = 0;  // half-open; shots follow each other without gaps
  // Where the last of the skill's effects comes true; else where half of the way that its things go, or turn, lies
  // behind them.
  std::int64_t telling_frame = 0;
  std::size_t camera = 0;  // an index into the cameras that were looked through
};

// At least one; their cameras are 0. The scene and the episode belong together.
std::vector<Shot> shots_of(const EpisodeRecord& episode, const Scene& scene);

// Sets each shot's camera, of these (in the scene's order). Every thing counts the same, by the share of the most
// pixels that any of the cameras sees of it; what a film cuts to sees clearly more than what it cuts from. It starts
// from `usual`.
void choose_cameras(Renderer& renderer, const StoredEpisode& stored, const std::vector<std::string>& cameras,
                    std::size_t usual, std::vector<Shot>& shots);

}  // namespace stampede::program
