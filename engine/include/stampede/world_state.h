// The world in symbols and numbers at one frame: what a learner of abstractions observes beside the pictures. And
// sensors of one's own, which read it at any physics step.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stampede/basics.h"

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

class WorldView;  // the engine's own

// The simulator after a physics step, to be read and not changed. Names are those of WorldState; a hand's are
// `panda.hand`. Lifetime: that of the call that it is given to. Throws Error for a name that the scene does not have,
// with the nearest one as cure.
class STAMPEDE_EXPORT SimulatorView {
 public:
  explicit SimulatorView(const WorldView& view) : view_(&view) {}

  double time_s() const;                                // simulated, since the episode's first frame
  double joint_position(std::string_view joint) const;  // rad or m
  double joint_velocity(std::string_view joint) const;  // rad/s or m/s
  double joint_effort(std::string_view joint) const;    // N m or N, of its motor in this step
  StatePose pose(std::string_view object) const;  // of an object, part or region; of a hand, that between the pads
  std::array<double, 3> velocity(std::string_view object) const;  // of the centre of mass; m/s, world
  double opening_m() const;                                       // between the pads
  // Normal, N: the mean over the frame before; 0 where the two did not touch.
  double contact_force(std::string_view one, std::string_view other) const;
  // From a point to the first thing that collides on the straight way to another, m; both m, world. Nothing: it is
  // free.
  std::optional<double> distance(const std::array<double, 3>& from, const std::array<double, 3>& to) const;

 private:
  const WorldView* view_;
};

// A sensor of one's own: see Session::add_sensor. Its name and all of this but `read` are part of an episode's key.
struct SensorEntry {
  std::string unit;                     // of the values, or one of each kind: `N, N m`
  std::vector<std::string> components;  // names of the values: one, or one each
  int rate_hz = 20;                     // samples a second; divides the world's physics rate
  std::string version = {};             // another text, another sensor: another episode
  // Gives one finite number a component. It reads nothing but the view and keeps nothing, so that episodes repeat and a
  // step can be undone; several episodes may call it at once. What it throws, and other values, end the episode with
  // the reason `sensor_error`.
  std::function<std::vector<double>(const SimulatorView& now)> read;
};

}  // namespace stampede
