// What is done to a world from outside, as values.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "engine/model/trajectory.h"

namespace stampede {

enum class ControllerKind { joint_position, joint_impedance, cartesian_impedance };
std::string_view to_string(ControllerKind kind);
std::optional<ControllerKind> controller_from(std::string_view name);
std::vector<std::string> controller_names();
// Throws Error with the nearest name for one that there is not.
void check_controller(std::string_view name, const std::string& place);

// Everything that changes a world from outside is one of these: writer, reader and replayer share the list.
// Operations take effect at the step at which they are applied. `robot`: which robot of the scene, from 0.
namespace operation {
struct Boundary {};  // contacts are found anew, so that a snapshot taken here restores bit for bit
struct Controller {
  ControllerKind kind = ControllerKind::joint_position;
  double stiffness = 0;  // 0: the default of the kind (N m/rad; cartesian: N/m); damping is critical
  int robot = 0;
};
struct Follow {  // the arm's reference from this step on; every controller derives its set-points from it
  Trajectory trajectory;
  int robot = 0;
};
struct Hand {
  double opening = 0;  // m, both fingers together
  double force = 20;   // N
  int robot = 0;
};
struct Setpoint {  // a reference for this step on, from an agent
  JointVector position, velocity;
  int robot = 0;
};
struct Servo {  // what an agent asks of the arm from this step on, in place of a trajectory or set-point
  // position: rad, to be reached; velocity: rad/s, to be kept; both within the joints' limits of speed, acceleration
  // and range. passage: positions of a way, each to be passed when the next is due, however fast; where none comes, it
  // is reached after all. torque: N m beside those that bear the weight of the arm and of what it holds; a joint that
  // would pass its limit of speed, or could not stop short of its stop, is held back.
  enum class Of { position, velocity, torque, passage };
  Of of = Of::position;
  JointVector value;
  int robot = 0;
};
struct Place {  // teleports a free body (scene sampling only)
  int body = 0;
  Transform world_from_body = Transform::Identity();
};
}  // namespace operation
using Operation = std::variant<operation::Boundary, operation::Controller, operation::Follow, operation::Hand,
                               operation::Setpoint, operation::Place, operation::Servo>;

struct Command {
  std::int64_t step = 0;  // applied before this physics step
  Operation operation;
};
std::string_view operation_kind(const Operation& operation);  // `boundary`, `follow` …
// Full precision, little-endian, without the robot's index, which is stored beside them.
std::string operation_to_bytes(const Operation& operation);
Operation operation_from_bytes(std::string_view kind, std::string_view bytes);  // throws Error

std::optional<int> robot_of(const Operation& operation);  // nothing: it is for no robot
void set_robot(Operation& operation, int robot);          // of one that is for a robot

}  // namespace stampede
