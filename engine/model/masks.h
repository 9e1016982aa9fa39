// Which number stands for what in instance and semantic masks.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "engine/model/scene.h"

namespace stampede {

// One thing that masks tell apart: a part of a body or of the robot, or a region; each can be seen.
struct MaskEntry {
  int instance = 0;    // in instance masks; 0 is the background
  std::string name;    // `panda.link3`, `chest.top_drawer`, `block1`
  std::string object;  // the object whose part it is: `chest.top_drawer`, `block1`, `panda.hand`; the robot's name
  std::string class_name;
  int semantic = 0;  // in semantic masks
};

// What has less alpha is seen through: drawn in colours only, in no mask.
inline constexpr double kOpaque = 0.99;

// Numbers parts and regions with something visible and opaque; 0 for the rest. The robot's parts from 1, then the
// fixtures' (in the scene's order): the same in every task of a world. The numbers of everything else are shuffled by
// `key`, so that a number never tells what a thing is for. Fills Scene::classes with the classes in use, sorted, when
// it is empty. Repeatable.
void number_masks(Scene& scene, RandomKey key);

// The class of a part: the type of the part's own object (`drawer`), else the class of its body (`chest`); `hand` for
// the robot's parts from the tip's part on, else the robot's name. Of a region: its object's class.
std::string class_of_part(const Scene& scene, int body, int part);  // body -1: the robot

// By instance. Throws Error when the scene has not been numbered.
std::vector<MaskEntry> mask_key(const Scene& scene);

}  // namespace stampede
