// Which pictures and further channels of an episode are wanted, and how they are made from its recorded frames.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/record/observation_choice.h"
#include "engine/record/record.h"
#include "engine/record/torque_noise.h"
#include "engine/render/renderer.h"
#include "engine/render/sensor_noise.h"

namespace stampede {

// What is off is not computed.
struct Observation {
  WhichFrames images = WhichFrames::none;
  std::vector<std::string> cameras;  // empty: all of the scene
  int width = 0, height = 0;         // pixels; 0: each camera's own
  PictureKinds kinds;
  bool points = false;  // point clouds too (kind `points`: binary PLY)
  bool shadows = false;
  DrawnBy renderer = DrawnBy::own;
  CameraNoise noise;
  double torque_noise = 0;   // N m, standard deviation added to channel `joint_torque`
  TorqueNoise torque_model;  // of the arm, beside that; empty: none
  // Sensors of the world, by name, "*": all; and kMargins.
  std::vector<std::string> channels = {"*"};
};
Observation chosen(const ObservationChoice& choice);

// The channel of signed margins (margins.h), which is no sensor of the world: recorded where it is named, not by "*".
inline constexpr const char* kMargins = "margins";
bool asks_for_channel(const Observation& observation, std::string_view name);  // by its name
std::vector<std::string> channel_names(const Scene& scene);                    // that can be asked for

// Throws Error for cameras and sensors that the scene does not have (with the nearest name as cure), sizes out of 1 …
// 4096, and the torque noise of another robot.
void check_observation(const Scene& scene, const Observation& observation);

// Of a finished episode, as its options hold it: what `render` does without further words. Throws Error.
ObservationChoice observation_of(const EpisodeRecord& episode);
// What ObservationChoice::as_text says, among other options.
ObservationChoice observation_from(const std::map<std::string, std::string>& options);

// Pictures that were made, in the order (frame, camera, kind). Beyond a few MB they lie in a temporary file without a
// name, so a long episode with images takes bounded memory. Lifetime: shared; append from one thread.
struct ImageRecord {
  std::int64_t frame = 0;
  int camera = 0;    // index in EpisodeScene::cameras
  std::string kind;  // rgb depth instance semantic points
  int width = 0, height = 0;
  std::vector<std::pair<int, std::int64_t>> visible = {};  // of kind instance: pixels by instance; else empty
};
class ImageStore {
 public:
  ImageStore();
  ~ImageStore();
  ImageStore(const ImageStore&) = delete;
  ImageStore& operator=(const ImageStore&) = delete;
  void append(ImageRecord image, const std::vector<std::uint8_t>& bytes);  // throws Error when the disk is full
  // A picture that is made when it is asked for: the same bytes each time, by any thread. What `make` throws, the
  // reader gets.
  void append_made(ImageRecord image, std::function<std::vector<std::uint8_t>()> make);
  std::size_t count() const;
  std::int64_t bytes() const;  // that the store holds itself
  const ImageRecord& record(std::size_t index) const;
  std::vector<std::uint8_t> read(std::size_t index) const;
  // All of them, taken in order and one at a time, each made once, by set_makers() threads. Not twice at the same time.
  using Take = std::function<void(const ImageRecord&, const std::vector<std::uint8_t>&)>;
  void read_all(const Take& take) const;
  void set_makers(int threads);  // 1 where it is not said

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// Where everything was at a frame, from what the record holds: its frames, and its facts where shapes are shown by
// some.
SceneState state_at(const Scene& scene, const EpisodeRecord& episode, std::int64_t frame);

// Draws frames of one episode: the same pixels while it runs, after it, and from a catalogue. Lifetime: one thread;
// the renderer must outlive it. Throws Error for an unknown camera, with the nearest name as cure.
class EpisodePainter {
 public:
  EpisodePainter(Renderer& renderer, const EpisodeRecord& episode, std::shared_ptr<const Scene> scene,
                 const Observation& observation);
  ~EpisodePainter();
  const std::vector<int>& cameras() const;  // wanted ones, indices into the scene's cameras
  std::vector<View> views(std::int64_t frame) const;
  // One picture a wanted camera, noise included.
  void paint(std::int64_t frame, std::vector<Picture>& pictures);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The frames that `which` means: none, all, or keyframes: the first and the last, those of each keyframe method, and
// the first of each skill segment.
std::vector<std::int64_t> wanted_frames(const EpisodeRecord& episode, WhichFrames which);

// Pictures of these frames, encoded. The image's camera is an index into the scene's cameras. `encoders`: threads that
// encode beside the drawing; they do not change the bytes.
void paint_frames(EpisodePainter& painter, const Observation& observation, const std::vector<std::int64_t>& frames,
                  ImageStore& images, int encoders = 0);

// All that the episode's own options want, into episode.images; nothing when they want none or no start was made.
void paint_episode(Renderer& renderer, EpisodeRecord& episode, int encoders = 0);

}  // namespace stampede
