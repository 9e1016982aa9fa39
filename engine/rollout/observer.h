// What an agent observes, channel by channel, of a world that is being run.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/record/arrays.h"
#include "engine/rollout/picture_channels.h"
#include "engine/rollout/symbol_channels.h"

namespace stampede {

// Lifetime: refers to the rollout, the options, the settings and the renderer.
class Observer {
 public:
  // Of the settings' channels. Throws Error for one that there is not, with the nearest name as cure. `renderer`: made
  // when the first picture is drawn.
  Observer(Rollout& rollout, const RunOptions& options, const EnvironmentSettings& settings,
           std::unique_ptr<Renderer>& renderer);
  Observer(const Observer&) = delete;  // its parts know the present by its address
  Observer& operator=(const Observer&) = delete;

  EnvironmentObservation observe();  // at a frame
  // Colours alone, without noise; `size` 0: as the camera's channels.
  ChannelValue picture(const std::string& camera, PictureSize size);
  SymbolChannels& symbols() { return symbols_; }

  // After the world was put back: nothing that was seen so far counts.
  void forget();

 private:
  void choose(const std::vector<std::string>& channels);
  EpisodeArrays columns(const ArrayRequest& request) const;  // of the present
  void add_columns(EnvironmentObservation& observation);
  ChannelValue made(const std::string& name);  // one that is neither a column nor a picture
  void hide(ChannelValue& value) const;
  bool names_hidden(const std::string& atom) const;

  Rollout& rollout_;
  const EnvironmentSettings& settings_;
  EpisodeRecord now_;  // its one frame is the present
  SymbolChannels symbols_;
  PictureChannels pictures_;
  std::vector<std::string> columns_, made_;
  std::set<std::string> hidden_;
};

}  // namespace stampede
