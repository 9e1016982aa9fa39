// Which pictures and further channels of an episode somebody asks for.
#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/record/torque_noise.h"
#include "engine/render/picture.h"
#include "stampede/picture.h"

namespace stampede {

enum class WhichFrames { none, keyframes, all };
std::string_view to_string(WhichFrames value);
std::optional<WhichFrames> which_frames_from(std::string_view text);

// What somebody asks for; the rest is left to others: the command line goes before the task, the task before the world.
struct ObservationChoice {
  std::optional<WhichFrames> images;
  std::optional<std::vector<std::string>> cameras;
  std::optional<std::array<int, 2>> size;  // width, height
  std::optional<PictureKinds> kinds;
  std::optional<bool> points, shadows;
  std::optional<DrawnBy> renderer;
  std::optional<double> rgb_noise, depth_noise, torque_noise;
  std::optional<TorqueNoise> torque_model;
  std::optional<std::vector<std::string>> channels;
  std::map<std::string, std::string> as_text() const;  // what was chosen, `observe_size` -> `64x48` …
};
ObservationChoice before(const ObservationChoice& first, const ObservationChoice& otherwise);

}  // namespace stampede
