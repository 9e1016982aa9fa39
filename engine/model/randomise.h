// Domain randomisation (Tobin et al., IROS 2017, doi:10.1109/IROS.2017.8202133): looks, light, cameras and dynamics of
// a scene drawn within ranges. The drawn values are in the scene, so replay and later pictures agree by themselves.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/scene.h"

namespace stampede {

using Range = std::array<double, 2>;  // lower, upper

struct Randomisation {
  // Things whose looks are drawn: names of bodies, groups of them by class (`work_table`), `robot`, or `*` (all). What
  // tells something by its look keeps it (see telling.h), and what is drawn stands out from that.
  std::vector<std::string> looks;
  std::vector<Colour> colours;                 // drawn from these; empty: any
  std::vector<std::string> textures;           // checker stripes noise plain, or names of Scene::textures; empty: plain
  Range ambient{0.5, 0.5}, diffuse{0.6, 0.6};  // of Light; these leave it as the scene has it
  double light_direction_rad = 0;              // greatest tilt
  double camera_position_m = 0, camera_rotation_rad = 0;  // greatest jitter, each camera on its own
  // Things whose dynamics are drawn, named as in looks; `*`: mass and friction of all free bodies, and the damping of
  // all joints but the robot's.
  std::vector<std::string> dynamics;
  Range mass{1, 1}, friction{1, 1}, damping{1, 1};  // factors
};

// What `--randomise` means where the world says nothing.
Randomisation default_randomisation();

// What is said of the scene keeps its look. Throws Error for names that the scene does not have. Repeatable: a pure
// function of its arguments.
void randomise(Scene& scene, const Randomisation& ranges, RandomKey key, const std::vector<std::string>& said = {});

}  // namespace stampede
