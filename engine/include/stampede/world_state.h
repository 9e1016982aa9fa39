// The world in symbols and numbers at one frame: what a learner of abstractions observes beside the pictures.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace stampede {

// A ground atom: `(on cup shelf)` is {"on", {"cup", "shelf"}}.
struct StateFact {
  std::string predicate;
  std::vector<std::string> arguments;
  bool holds = true;  // in the simulator
  bool known = true;  // to who has seen what the robot has seen; false with `holds`: hidden, in a closed drawer say
};

struct StateJoint {
  std::string name;     // panda.joint1, chest.top_drawer
  double position = 0;  // rad or m
  double fraction = 0;  // 0 at the lower limit … 1 at the upper; 0 for a joint without limits
};

struct StatePose {
  std::string object;
  std::array<double, 3> position{};          // m, world
  std::array<double, 4> orientation_xyzw{};  // world_from_object
};

struct StateHand {
  std::string name;
  double opening_m = 0;  // between the pads
};

// Each list by name; facts by predicate, then arguments; traits, attributes and derived facts included.
struct WorldState {
  std::int64_t frame = 0;
  double time_s = 0;  // simulated, since the episode's first frame
  std::vector<StateFact> facts;
  std::vector<StateJoint> joints;
  std::vector<StatePose> objects;
  std::vector<StateHand> hands;
};

}  // namespace stampede
