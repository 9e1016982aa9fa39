// Where `render` puts what it drew: one class for each kind of place.
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "db/stored_episode.h"
#include "engine/base/output_file.h"
#include "engine/record/observation.h"
#include "engine/render/canvas.h"
#include "engine/render/renderer.h"
#include "scripting/commands/render_shots.h"

namespace stampede::program {

// What is wanted of an episode. Lifetime: shared by all workers; nothing in it changes.
struct RenderRequest {
  ObservationChoice given;                                         // on the command line
  std::function<std::vector<Camera>(const Scene& scene)> further;  // cameras of the command line
  std::function<std::vector<std::int64_t>(const EpisodeRecord& episode, WhichFrames stored)> frames;
  std::function<std::string(const EpisodeRecord& episode)> lacking;  // which frames it does not have, in words, or ""
  const std::atomic<bool>* stop = nullptr;

  std::vector<std::string> named() const { return given.cameras.value_or(std::vector<std::string>{}); }
  bool stopped() const { return stop != nullptr && stop->load(); }
};

// What came of one episode.
struct Drawn {
  StoredEpisode stored;              // its scene with the cameras that are wanted
  std::vector<std::string> changed;  // scripts
  RenderedEpisode rendered;
  std::vector<Canvas> canvases;  // sheet: its block
  std::int64_t pictures = 0, bytes = 0, frames = 0, skipped = 0;
};

// masks.csv, cameras.csv and one file a picture: episode_000012/front/rgb/000034.png. Throws Error: disk full.
void write_folder(const std::filesystem::path& folder, Drawn& drawn, const OutputRules& rules);

// Frames one by one, the instruction and the running skill under each. Lifetime: one thread.
class Film {
 public:
  Film(std::filesystem::path file, OutputRules rules);
  ~Film();
  void add(Renderer& renderer, const RenderRequest& request, Drawn& drawn);
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// One block of a contact sheet: a header, the start, a picture amid each skill, the end.
Canvas sheet_block(Renderer& renderer, const RenderRequest& request, Drawn& drawn);
// Blocks one below the other. Throws UsageError when there are too many for one picture.
void write_sheet(const std::filesystem::path& file, const std::vector<Canvas>& blocks, const OutputRules& rules);
OutputKind sheet_kind();  // pictures for people, marked as ours

// What films and sheets share: pictures for people.
struct Portrait {
  Observation observation;  // cameras, size, shadows
  bool all = false;         // all cameras side by side, as they were asked for; else one of them a shot
};
Portrait portrait_of(const RenderRequest& request, const StoredEpisode& stored, std::array<int, 2> size);

class PortraitPainter {
 public:
  PortraitPainter(Renderer& renderer, const StoredEpisode& stored, const Portrait& portrait);
  const std::vector<Shot>& shots() const { return shots_; }
  // The pictures of the cameras that are asked for side by side on the canvas, or that of the shot's camera.
  void paint(std::int64_t frame, Canvas& canvas, int x, int y);
  int width() const;
  int height() const;

 private:
  Renderer& renderer_;
  const StoredEpisode& stored_;
  const Portrait& portrait_;
  std::vector<Shot> shots_;
  EpisodePainter painter_;
  std::vector<Picture> pictures_;
};

std::string instruction_of(const EpisodeRecord& episode);
// The innermost skill segment that runs at the frame; the last one at the end. Null: none.
const SegmentRecord* skill_at(const EpisodeRecord& episode, std::int64_t frame);
std::string label_of(const SegmentRecord& segment);

}  // namespace stampede::program
