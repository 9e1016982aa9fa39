// Controllers composed by priority: what a later one wants is done as far as it does not disturb those before it.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "engine/model/kinematics.h"
#include "stampede/environment.h"

namespace stampede {

// What a controller wants of the joints: `jacobian` times their velocity shall be `rate`. Shapes: rows x joints, rows.
struct Objective {
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd rate;
};
// Of a moment; an observation has the channels joint_positions, gripper_pose and tool_jacobian.
using Controller = std::function<Objective(const EnvironmentObservation&)>;

// Joint velocities (rad/s): each objective in the null space of those before it, by damped pseudo-inverses
// (Siciliano, Slotine, ICAR 1991, doi:10.1109/ICAR.1991.240390).
Eigen::VectorXd by_priority(const std::vector<Objective>& objectives, Eigen::Index joints);

// Keeps the tool where it is while the elbow moves away: joint velocities of the null space turn the first joint by
// `elbow` rad (parameter of the call, 0.4 where it is not given) from where it was. Done when it is there, or cannot
// come nearer.
PolicyEntry keep_tool_policy();

}  // namespace stampede
