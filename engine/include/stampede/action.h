// What an agent can ask of the robot, one step at a time: low-level set-points, tool poses, whole skills.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace stampede {

// One number of an action.
struct ActionComponent {
  std::string name, unit;  // panda.joint1, rad
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();  // both allowed
};

// A way to act. Any step may use another one. A frame is one step of the environment, a twentieth of a second by
// default.
//
// | name | values | what it does |
// |---|---|---|
// | joint_position | n, rad | the arm goes there, through it where the next one comes in time; one frame |
// | joint_delta | n, rad | from where its reference is now, stopping there |
// | joint_velocity | n, rad/s | kept until the next action; one frame |
// | joint_torque | n, N m | beside those that bear the arm's weight; one frame |
// | tool_pose | x y z m, qx qy qz qw | inverse kinematics from the present joints, then as joint_delta |
// | tool_delta | x y z m, rotation vector rad | likewise, from the reference's pose: moved, and turned about itself |
// | tool_velocity | linear m/s, angular rad/s | damped least squares along one frame, not stopping at its end |
// | tool_impedance | as tool_pose, then stiffness N/m | as tool_pose, and the arm gives way to contact |
// | tool_path | as tool_pose | planned around obstacles and followed: to its end, or for `frames` |
// | tool_path_delta | as tool_delta | likewise |
// | gripper | opening m | the arm stays as it is; one frame |
// | release | none | likewise; opens the hand as far as it can beside what stands by its fingers |
// | hold | none | stands still until the goal has held long enough, for a second where it does not hold |
// | skill | none | see AgentAction::skill: to its end, or for `frames` |
// | go_on | none | the path, skill or hold that `frames` cut off goes on |
struct ActionSpace {
  std::string name;
  std::vector<ActionComponent> components;
};

// A continuous parameter of a skill with the values that it shall have: as `stampede list skills` shows them.
struct SkillParameter {
  std::string name;
  std::vector<double> values;
  friend bool operator==(const SkillParameter&, const SkillParameter&) = default;
};

struct AgentAction {
  std::string space;
  std::vector<double> values = {};  // one a component
  // Beside any space of the arm: the opening that the fingers go to, m. Nothing: what it was told last.
  std::optional<double> gripper = {};
  std::string frame = "world";  // of tool spaces: `world`, or `tool`, that of the reference's pose
  // joint_position, joint_impedance or cartesian_impedance, of the arm's spaces and of skills; empty: joint_position,
  // and the skill's own.
  std::string controller = {};
  int frames = 0;  // of tool_path, skill, hold and go_on: the step ends after so many; 0: where they end

  // Space skill.
  std::string skill = {};                       // an action of the domain: `pick`, `open_drawer`; see skills()
  std::vector<std::string> arguments = {};      // one a parameter: names of objects, the hand among them
  std::vector<SkillParameter> parameters = {};  // those that are not to be drawn
  friend bool operator==(const AgentAction&, const AgentAction&) = default;
};

// What an episode keeps of an action that was asked for and not refused: view `agent_actions` of a catalogue,
// EpisodeArrays::agent_actions.
struct AskedAction {
  AgentAction asked;  // its frame of reference is `world` where the space is not of the tool
  // From the frame of the observation that it answers to that of the next one; half-open. One and the same: a skill
  // that failed before anything moved.
  std::int64_t first_frame = 0, end_frame = 0;
  std::int64_t segment = -1;  // of the skill whose body is the policy that asked; -1: who drives the episode asked
  std::optional<double> reward = {};           // that the environment gave whoever drives the episode
  bool terminated = false, truncated = false;  // as in StepResult
  friend bool operator==(const AskedAction&, const AskedAction&) = default;
};

// A ground skill, and whether its precondition holds now.
struct SkillChoice {
  std::string skill;
  std::vector<std::string> arguments;
  bool feasible = false;
};

// A continuous parameter that a skill declares. Shapes: one entry a component in each list; grasps and poses have 7
// (x y z m, quaternion x y z w), a grasp an opening in m as eighth, and no bounds.
struct SkillParameterInfo {
  std::string name, unit, frame;
  std::vector<double> initial, lower, upper;
  std::string source;  // value, grasps, sample: where it comes from when it is not set
};

struct SkillDescription {
  std::string skill;                    // the action's name in the domain
  std::vector<std::string> parameters;  // names of its arguments
  std::vector<std::string> types;       // of each, `object` for any
  std::vector<SkillParameterInfo> continuous;
  std::string controller;  // its own
};

}  // namespace stampede
