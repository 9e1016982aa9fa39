// A task as an environment: reset, step, observe. The caller decides at each step how to act: by set-points of joints
// or tool, or by whole skills.
//
//   Environment world = session.environment("stack_blocks", {.channels = {"joint_positions", "front_rgb"}});
//   world.reset({.seed = 7});
//   for (bool over = false; !over;) {
//     const StepResult now = world.step({.space = "joint_delta", .values = policy(now.observation)});
//     over = now.terminated || now.truncated;
//   }
#pragma once

#include <concepts>
#include <cstdint>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "stampede/action.h"
#include "stampede/basics.h"
#include "stampede/episode.h"
#include "stampede/error.h"
#include "stampede/world_state.h"

namespace stampede {

// What a channel says at one moment. Names, shapes, units and frames are those of `EpisodeArrays` without the axis of
// frames (stampede/arrays.h); texts are lists.
struct STAMPEDE_EXPORT ChannelValue {
  std::string name;
  std::vector<std::int64_t> shape;
  std::string unit, frame;
  std::vector<std::string> labels = {};  // of the last axis: joints, components; facts and applicable: see Environment
  std::variant<std::vector<double>, std::vector<std::uint8_t>, std::vector<float>, std::vector<std::uint16_t>,
               std::vector<std::int64_t>, std::vector<std::string>>
      data;
  // Throw Error when the channel is of another type.
  const std::vector<double>& reals() const;
  const std::vector<std::uint8_t>& bytes() const;  // truth values, and the colours of pictures
  const std::vector<std::string>& texts() const;
};

struct STAMPEDE_EXPORT EnvironmentObservation {
  std::int64_t frame = 0;
  double time_s = 0;  // simulated, since reset
  std::vector<ChannelValue> channels;
  const ChannelValue& operator[](std::string_view name) const;  // throws Error with the nearest name as cure
};

// Pixels. 0: the camera's own.
struct PictureSize {
  int width = 0, height = 0;
};

// sparse: 1 when the episode ends in success, else 0. dense: how far the plan for the goal has come, 1 where the goal
// holds (see engine/episode/README.md). task: the task's own `reward`, and 1 at success.
enum class RewardKind { sparse, dense, task };

struct EnvironmentSettings {
  // Any mix of raw and abstract channels: the columns of `EpisodeArrays` by name or group (`object_pose` is all
  // object_pose/NAME), and facts, known, applicable, fact_names, feasible_skills, pddl, sentences, plan, progress,
  // object_pose_in/NAME/OTHER, goal (1 for each of `facts` that the goal asks for, -1 for those that it rules out, 0
  // for the others; of an ordered goal, of the part that comes next). Pictures: CAMERA_rgb, CAMERA_depth, CAMERA_mask,
  // CAMERA_semantic_mask, CAMERA_point_cloud.
  std::vector<std::string> channels = {"joint_positions", "joint_velocities", "gripper_open", "gripper_pose",
                                       "task_low_dim_state"};
  bool hidden = false;  // also what nobody can see: facts that are not known, poses of things in closed drawers
  RewardKind reward = RewardKind::sparse;
  double frame_hz = 0;        // steps a second; 0: the world's. Physics runs at a multiple of it.
  double physics_hz = 0;      // 0: the world's
  double horizon_s = 0;       // simulated; 0: the task's
  bool record = false;        // keep the episode, for `episode()`; else memory does not grow
  int width = 0, height = 0;  // of pictures, pixels; 0: each camera's own
  std::map<std::string, PictureSize> picture_sizes = {};  // by camera, where it is another one
  bool shadows = false;
  DrawnBy renderer = DrawnBy::own;
  std::map<std::string, double> picture_hz = {};  // by camera, where a picture need not be new at every frame
  double rgb_noise = 0, depth_noise = 0;          // as PictureStorage
  double torque_noise = 0;                        // N m, of the sensor `joint_torque`
  std::string torque_model = {};                  // of the same, of a real arm, as an episode's options keep it
};

// A moment to which an environment can go back. Lifetime: a value; it outlives the environment, and restores into any
// environment of the same task and settings: one that stands at the same start, or at none yet.
class STAMPEDE_EXPORT SavedState {
 public:
  struct Data;
  std::shared_ptr<const Data> data;
};

struct ResetRequest {
  std::string variation = {};         // canonical text, or axes of it; empty: the first
  std::int64_t seed = 0;              // from 1'000'000 up: the test split
  std::string where = {}, goal = {};  // PDDL, as EpisodeRequest
  bool randomise = false;
  // What is otherwise than usual, each with its strength: `camera=1,layout=0.5`. The axes: layout, camera, start,
  // sentence, light, texture, noise; see Session::evaluate.
  std::string perturb = {};
  // Instead of all these: the frame of an episode that this engine recorded with the same scripts.
  std::optional<Episode> episode = {};
  std::int64_t frame = 0;
  std::optional<std::vector<std::string>> channels = {};  // from now on; nothing: as before
};

// Why an action cannot be done. Nothing has changed then.
struct ActionRefusal {
  std::string what, cure;
};

// A skill that ended in a step.
struct SkillEnd {
  std::string skill;
  std::vector<std::string> arguments;
  bool success = false;
  std::string reason, detail;                          // reason `none`, or as in the catalogue
  std::optional<bool> precondition_held, effect_held;  // nothing: not reached
  std::vector<std::string> missing_effects;
};

struct StepResult {
  EnvironmentObservation observation;
  double reward = 0;
  bool terminated = false;  // success, or the task says that it has failed
  bool truncated = false;   // the horizon, or a limit of the caller
  bool success = false;
  std::optional<ActionRefusal> refusal;  // the action was not done
  std::string reason = "none", detail;   // why the episode ended
  std::int64_t frames = 0;               // that went by
  std::vector<StateFact> changes;        // facts that came (`holds`) and went, as far as they are known
  std::string running;                   // a skill, path or hold that was cut off and can go_on; empty: none
  std::vector<SkillEnd> ended;
  // What kept the arm from going as the action asks: any of speed, acceleration, jerk, torque (of a joint), tool_speed,
  // reference (it waits for an arm that does not get on), approach (something is ahead, and is met slowly) and contact
  // (the arm presses no harder). Of actions for a frame only: paths and skills are planned within the limits.
  std::vector<std::string> limited;
};

// What a skill was called with, for the policy that is its body; or, where a policy acts in a whole episode, its task.
struct PolicyCall {
  std::string task = {}, instruction = {};                     // of a whole episode; one of the task's sentences
  std::string skill = {};                                      // empty: a whole episode
  std::map<std::string, std::string> arguments = {};           // parameter -> object
  std::map<std::string, std::vector<double>> parameters = {};  // continuous ones, and `with` of robot:policy
};

// What a Policy, a sensor or another function of a program throws when not its skill has failed, but the run is to end,
// as Ctrl-C in it asks for: no episode counts what it was in the midst of, those that are finished are kept, and who
// began the run gets it thrown. It is no std::exception, as nothing between there and here may take it for a failure.
struct STAMPEDE_EXPORT Interruption {
  std::exception_ptr cause;
};

// A controller, such as a learned one, as the body of a skill, or as what acts in whole episodes
// (stampede/evaluation.h). One is made for each call.
class STAMPEDE_EXPORT Policy {
 public:
  virtual ~Policy();
  virtual void begin(const PolicyCall&) {}
  // Asked at each frame: any action but hold and go_on; a path or a skill is done to its end. Nothing: it is done. What
  // it throws, and an action that cannot be done, end the skill with the reason `policy_error`.
  virtual std::optional<AgentAction> act(const EnvironmentObservation& now) = 0;
};

struct PolicyEntry {
  std::function<std::unique_ptr<Policy>()> make;
  std::vector<std::string> channels = {"joint_positions", "gripper_pose", "gripper_open", "task_low_dim_state"};
  bool hidden = false;        // as EnvironmentSettings
  int width = 0, height = 0;  // of pictures
  std::string version = {};   // part of an episode's key: another text, another policy
};

// Lifetime: movable, used by the thread that reset it; two environments never meet. Throws Error for unknown
// variations and channels, and for a start that cannot be made. Repeatable: the same requests and actions, the same
// bits.
class STAMPEDE_EXPORT Environment {
 public:
  struct Impl;
  explicit Environment(std::unique_ptr<Impl> impl);  // see Session::environment
  ~Environment();
  Environment(Environment&&) noexcept;
  Environment& operator=(Environment&&) noexcept;

  EnvironmentObservation reset(const ResetRequest& request = {});
  // As restore; where another start is under way, or its episode has been taken, that of the state is made first. For
  // a SavedState alone, so that `reset({})` means the request.
  template <std::same_as<SavedState> State>
  EnvironmentObservation reset(const State& state) {
    return reset_to(state);
  }

  // After the end, and for what cannot be done, the result holds a refusal and nothing has changed.
  StepResult step(const AgentAction& action);

  // Known from the beginning; before the first reset they are those of the first variation.
  double frame_hz() const;   // steps of set-points a second
  double horizon_s() const;  // simulated; the episode is truncated then
  std::vector<ActionSpace> spaces() const;
  std::vector<SkillDescription> skill_descriptions() const;

  std::vector<std::string> instructions() const;  // what the task is called in words, for this start
  // Every ground skill of the scene, in a fixed order, with what can be done now: an action mask.
  std::vector<SkillChoice> skills() const;

  EnvironmentObservation observe() const;
  // What a camera sees now, without noise: colours, height x width x 3. Only this is drawn, whatever the channels are.
  ChannelValue picture(const std::string& camera, PictureSize size = {}) const;
  // Ground atoms of the channels `facts` and `known`, in their order.
  std::vector<StateFact> atoms() const;

  // Between two steps; throws Error while a skill, path or hold is cut off. Contact caches are dropped, so a run that
  // saves differs in its last digits from one that does not; what follows a save and a restore is equal, bit for bit.
  SavedState save();
  EnvironmentObservation restore(const SavedState& state);

  // The episode so far; it ends here. With `record` set it holds all of it, is stored in the session's catalogue where
  // there is one, and replays.
  Episode episode();

 private:
  EnvironmentObservation reset_to(const SavedState& state);

  Own<Impl> impl_;
};

}  // namespace stampede
