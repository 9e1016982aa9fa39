// Our drawing of the robot over stored pictures of an episode, and how far its outline is from theirs.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "db/stored_episode.h"
#include "engine/render/edge_alignment.h"
#include "engine/render/renderer.h"

namespace stampede {

struct OverlayPicture {
  std::int64_t frame = 0;
  std::string camera;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // the stored picture, the robot's place tinted and outlined
};

struct OverlayRequest {
  std::vector<std::string> cameras;  // empty: all that have colour pictures
  std::vector<std::int64_t> frames;  // of which those with pictures are taken
  AlignmentOptions alignment;
};

struct CameraAlignment {
  std::string camera;
  std::int64_t pictures = 0;
  Alignment alignment;
};

struct Overlays {
  std::vector<CameraAlignment> cameras;  // by name
  std::vector<std::string> left_out;     // cameras that nobody calibrated
};

// The robot is drawn at the joint states of the moment at which each picture was taken, between frames on straight
// lines. The episode's scene may have been given other cameras. Pictures of frames at which the joints are not known
// are left out. `keep` gets each picture. Throws Error for cameras that the scene does not have.
Overlays overlays_of(Renderer& renderer, const Catalogue& catalogue, const StoredEpisode& stored,
                     const OverlayRequest& request, const std::function<void(const OverlayPicture&)>& keep);

}  // namespace stampede
