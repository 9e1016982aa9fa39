// What a real arm's torque sensors say beside the torques of an ideal one: friction, offsets that drift while the arm
// warms up, noise. `python -m stampede.torque_noise` fits it from a recording.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/random.h"

namespace stampede {

// Of one joint. The reading is the ideal torque, and coulomb tanh(velocity / smooth) + viscous velocity + offset +
// drift (1 - exp(-t / drift_time)) + white n, with n normal; t is the time since the arm was switched on.
struct JointTorqueNoise {
  std::string joint;   // name in the URDF
  double coulomb = 0;  // N m
  double smooth = 1;   // rad/s, above 0: where friction turns its sign
  double viscous = 0;  // N m s/rad
  double offset = 0;   // N m, when it is cold
  double drift = 0;    // N m, until it is warm
  double white = 0;    // N m, standard deviation; not negative
};

struct TorqueNoise {
  double drift_time_s = 1;  // above 0
  // How long the recording was: an episode begins at a moment of it, the same for equal keys.
  double recorded_s = 0;
  std::vector<JointTorqueNoise> joints;
  bool empty() const { return joints.empty(); }
};

// One line, as an episode's options keep it, and back: exact. Throws Error for what is no such text.
std::string to_text(const TorqueNoise& noise);
TorqueNoise torque_noise_from(std::string_view text);

// The model in the order of an arm's joints. Throws Error, with the arm's joints, where one of them has no noise, or
// the noise is of a joint that it does not have: it was fitted to another robot.
TorqueNoise of_arm(const TorqueNoise& noise, const std::vector<std::string>& joints);

// When the episode begins, s since the arm was switched on.
double warm_up_s(const TorqueNoise& noise, RandomKey key);

// What is added to joint `index`'s torque. `random`: one normal draw.
double torque_error(const TorqueNoise& noise, std::size_t index, double velocity, double since_on_s, Random& random);

}  // namespace stampede
