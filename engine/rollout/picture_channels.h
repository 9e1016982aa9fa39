// What an agent sees: pictures and point clouds of cameras, drawn when they are due.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "engine/record/record.h"
#include "engine/render/renderer.h"
#include "engine/rollout/rollout.h"
#include "stampede/environment.h"

namespace stampede {

// As the settings size them. Throws Error for sizes of cameras that there are not.
std::vector<Camera> sized_cameras(std::vector<Camera> cameras, const EnvironmentSettings& settings);

struct PictureChannelKind;

// Lifetime: refers to all that it is made of; pictures are drawn by the thread that asks first.
class PictureChannels {
 public:
  struct Channel {
    std::string name, camera;
    const PictureChannelKind* kind;
  };

  // `now`: its cameras see its one frame. `renderer`: made when the first picture is drawn.
  PictureChannels(const Rollout& rollout, const EnvironmentSettings& settings, const EpisodeRecord& now,
                  std::unique_ptr<Renderer>& renderer);
  std::vector<Channel> all() const;  // by camera
  void choose(std::vector<Channel> channels);
  void add_to(EnvironmentObservation& observation);  // those that were chosen
  // Colours alone, without noise; `size` 0: as the camera's channels.
  ChannelValue picture(const std::string& camera, PictureSize size);
  void forget() { drawn_.clear(); }  // what was drawn so far

 private:
  void look(const std::vector<std::string>& cameras);
  std::vector<Picture> draw(const std::vector<View>& views, const ScenePoses& poses, const PictureKinds& kinds);
  SceneState state() const;  // of the one frame, with the facts of the present
  View view_from(const std::string& camera, const ScenePoses& poses) const;

  const Rollout& rollout_;
  const EnvironmentSettings& settings_;
  const EpisodeRecord& now_;
  std::vector<Channel> chosen_;
  struct Drawn {
    std::int64_t frame = -1;
    Picture picture;
    View view;
  };
  std::map<std::string, Drawn> drawn_;
  std::map<std::string, PictureKinds> kinds_;  // by camera
  ShownFacts facts_that_show_;
  std::unique_ptr<Renderer>& renderer_;
  bool loaded_ = false;  // this scene, into the renderer
};

}  // namespace stampede
