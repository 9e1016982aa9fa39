// Which pictures and further channels of an episode are wanted, and how they are made from its recorded frames.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/episode/record.h"
#include "engine/render/renderer.h"
#include "engine/render/sensor_noise.h"

namespace stampede {

enum class WhichFrames { none, keyframes, all };
std::string_view to_string(WhichFrames value);
std::optional<WhichFrames> which_frames_from(std::string_view text);

// What is off is not computed.
struct Observation {
  WhichFrames images = WhichFrames::none;
  std::vector<std::string> cameras;  // empty: all of the scene
  int width = 0, height = 0;         // pixels; 0: each camera's own
  PictureKinds kinds;
  bool points = false;  // point clouds too (kind `points`: binary PLY)
  bool shadows = false;
  CameraNoise noise;
  double torque_noise = 0;                             // N m, standard deviation added to channel `joint_torque`
  std::vector<std::string> channels;                   // sensors of the world, by name; {"*"}: all
  std::map<std::string, std::string> as_text() const;  // what alters data, for keys and catalogues; empty when default
};

// Pictures that were made, in the order (frame, camera, kind). Beyond a few MB they lie in a temporary file without a
// name, so a long episode with images takes bounded memory. Lifetime: shared; append from one thread.
struct ImageRecord {
  std::int64_t frame = 0;
  int camera = 0;    // index in EpisodeRecord::cameras
  std::string kind;  // rgb depth instance semantic points
  int width = 0, height = 0;
};
class ImageStore {
 public:
  ImageStore();
  ~ImageStore();
  ImageStore(const ImageStore&) = delete;
  ImageStore& operator=(const ImageStore&) = delete;
  void append(ImageRecord image, const std::vector<std::uint8_t>& bytes);  // throws Error when the disk is full
  std::size_t count() const;
  std::int64_t bytes() const;
  const ImageRecord& record(std::size_t index) const;
  std::vector<std::uint8_t> read(std::size_t index) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Where everything was at a frame, from what the record holds.
SceneState state_at(const Scene& scene, const EpisodeRecord& episode, std::int64_t frame);

// Draws frames of one episode: the same pixels while it runs, after it, and from a catalogue. Lifetime: one thread;
// the renderer must outlive it. Throws Error for an unknown camera, with the nearest name as cure.
class EpisodePainter {
 public:
  EpisodePainter(Renderer& renderer, const EpisodeRecord& episode, std::shared_ptr<const Scene> scene,
                 const Observation& observation);
  const std::vector<int>& cameras() const;  // wanted ones, indices into the scene's cameras
  std::vector<View> views(std::int64_t frame) const;
  // One picture a wanted camera, noise included.
  void paint(std::int64_t frame, std::vector<Picture>& pictures);

 private:
  struct Impl;
  std::shared_ptr<Impl> impl_;
};

// The frames that `which` means: none, the episode's keyframes (all methods, first and last frame included), or all.
std::vector<std::int64_t> wanted_frames(const EpisodeRecord& episode, WhichFrames which);

// Pictures of all wanted frames, encoded, into episode.images.
void paint_episode(Renderer& renderer, EpisodeRecord& episode, const Observation& observation);

}  // namespace stampede
