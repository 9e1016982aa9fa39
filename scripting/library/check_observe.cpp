// What is observed of an episode, as a world or a task says.
#include <algorithm>
#include <cmath>

#include "engine/record/observation.h"
#include "engine/render/picture.h"
#include "scripting/library/checks.h"

namespace stampede {
namespace {

constexpr int kMostPixels = 4096;

bool size_fits(const Value& size) {
  return std::all_of(size.items.begin(), size.items.end(), [](const Value& side) {
    return !side.is_number() ||
           (side.number >= 1 && side.number <= kMostPixels && side.number == std::floor(side.number));
  });
}

}  // namespace

void check_size(const Definition& definition, const Value& size, const std::string& path) {
  if (!size_fits(size)) definition.complain(path, "a picture has 1 to 4096 whole pixels a side", "size = { 128, 128 }");
}

void check_observe(const Definition& definition, const Value& world) {
  const Value& node = definition.node["observe"];
  if (node["images"].is_text() && !which_frames_from(node["images"].text))
    definition.require_known("observe.images", "choice of frames", node["images"], {"none", "keyframes", "all"});
  std::vector<std::string> kinds;
  for (const PictureKind kind : kPictureKinds) kinds.emplace_back(to_string(kind));
  for (const Value& kind : node["kinds"].items) {
    if (kind.is_text() && kind.text == "points")
      definition.complain("observe.kinds", "point clouds are asked for by themselves", "points = true");
    else
      definition.require_known("observe.kinds", "kind of picture", kind, kinds);
  }
  check_size(definition, node["size"], "observe.size");
  if (!world["calibration"].present()) {  // which may bring cameras of its own
    for (const Value& camera : node["cameras"].items)
      definition.require_known("observe.cameras", "camera", camera, keys_of(world["cameras"].fields));
  }
  std::vector<std::string> channels = keys_of(world["sensors"].fields);
  channels.emplace_back(kMargins);
  for (const Value& channel : node["channels"].items) {
    if (channel.text != "*") definition.require_known("observe.channels", "sensor", channel, channels);
  }
  for (const char* noise : {"rgb", "depth", "torque"}) {
    if (node["noise"][noise].is_number() && node["noise"][noise].number < 0)
      definition.complain(std::string("observe.noise.") + noise, "a standard deviation is not negative");
  }
}

}  // namespace stampede
