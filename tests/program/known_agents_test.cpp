// What environments say is known by its hash: observations, rewards, refusals, going back, and the episode in the end.
#include <catch2/catch.hpp>
#include <cmath>

#include "engine/base/hash.h"
#include "engine/base/random.h"
#include "engine/base/text.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// How an agent acts in a task, drawn from the name of the case.
struct KnownAgent {
  const char* hash = "";  // of all that it was told
  const char* task = "";
  const char* channels = "";
  EnvironmentSettings settings;
  ResetRequest start = {};
  int skills = 0;      // feasible ones, drawn
  int set_points = 0;  // in each space of single frames
};

constexpr const char* kNumbers =
    "time step progress joint_positions joint_velocities joint_forces gripper_open gripper_opening "
    "gripper_joint_positions gripper_joint_forces gripper_pose gripper_matrix gripper_velocity gripper_touch_forces "
    "task_low_dim_state object_pose object_pose_in_tool object_joint_positions object_joint_velocities tool_jacobian "
    "sensor";
constexpr const char* kSymbols = "facts known applicable fact_names plan feasible_skills pddl sentences progress goal";
constexpr const char* kPoses = "facts known applicable plan object_pose sensor/margins object_pose_in/item/chest";
constexpr const char* kPictures =
    "front_rgb wrist_rgb front_depth wrist_mask front_semantic_mask front_point_cloud front_camera_extrinsics";

const std::vector<KnownAgent>& known_agents() {
  static const std::vector<KnownAgent> agents = {
      {.hash = "a75904e136dab570ecb7f0a41bd39bb3",
       .task = "pick_and_lift",
       .channels = kNumbers,
       .settings = {.reward = RewardKind::dense, .record = true, .torque_noise = 0.2},
       .start = {.seed = 3},
       .skills = 2,
       .set_points = 6},
      {.hash = "6421ad15fe6e901fced733ceaf089bc6",
       .task = "put_item_in_drawer",
       .channels = kSymbols,
       .settings = {.reward = RewardKind::dense, .record = true},
       .start = {.seed = 2, .randomise = true},
       .skills = 6,
       .set_points = 1},
      {.hash = "9422f8f0ff26e4473fe5b970a8098e61",
       .task = "find_item_in_drawer",
       .channels = kPoses,
       .settings = {.record = true},
       .start = {.seed = 3},
       .skills = 8},
      {.hash = "a74ba329d154857839b69e7316f791d0",
       .task = "find_item_in_drawer",
       .channels = kPoses,
       .settings = {.hidden = true, .reward = RewardKind::task, .frame_hz = 10, .record = true},
       .start = {.seed = 3},
       .skills = 4,
       .set_points = 2},
      {.hash = "88b22643442b4b36fdf1d7e1149a0cc9",
       .task = "stack_blocks",
       .channels = kPictures,
       .settings = {.record = true,
                    .width = 32,
                    .height = 24,
                    .picture_sizes = {{"wrist", {20, 16}}},
                    .shadows = true,
                    .picture_hz = {{"wrist", 5}},
                    .rgb_noise = 0.02,
                    .depth_noise = 0.01},
       .start = {.seed = 5, .perturb = "layout=1,camera=0.5,start=1,light=1,texture=1,noise=1"},
       .skills = 2,
       .set_points = 1},
      {.hash = "af6acfcf3cdd30e162f18b4c7224ccdd",
       .task = "close_drawer",
       .channels = kNumbers,
       .settings = {.reward = RewardKind::task, .horizon_s = 6, .record = true},
       .start = {.seed = 1, .perturb = "start=1"},
       .skills = 3,
       .set_points = 12},
  };
  return agents;
}

// Of NaN there is one.
void add(Hasher& hash, double value) { hash.number(std::isnan(value) ? 0.5e-300 : value); }

void add(Hasher& hash, const std::vector<std::string>& texts) {
  for (const std::string& text : texts) hash.text(text);
}

void add(Hasher& hash, const ChannelValue& channel) {
  hash.text(channel.name).text(channel.unit).text(channel.frame);
  add(hash, channel.labels);
  for (const std::int64_t size : channel.shape) hash.number(size);
  std::visit(
      [&](const auto& data) {
        for (const auto& value : data) {
          if constexpr (std::is_arithmetic_v<std::remove_cvref_t<decltype(value)>>)
            add(hash, static_cast<double>(value));
          else
            hash.text(value);
        }
      },
      channel.data);
}

void add(Hasher& hash, const EnvironmentObservation& seen) {
  hash.number(seen.frame).number(seen.time_s);
  for (const ChannelValue& one : seen.channels) add(hash, one);
}

void add(Hasher& hash, const StepResult& now) {
  add(hash, now.observation);
  hash.number(now.reward).number(now.terminated).number(now.truncated).number(now.success).number(now.frames);
  hash.text(now.reason).text(now.detail).text(now.running);
  if (now.refusal) hash.text(now.refusal->what).text(now.refusal->cure);
  add(hash, now.limited);
  for (const StateFact& fact : now.changes) {
    hash.text(fact.predicate).number(fact.holds);
    add(hash, fact.arguments);
  }
  for (const SkillEnd& end : now.ended) {
    hash.text(end.skill).text(end.reason).text(end.detail).number(end.success);
    hash.number(end.precondition_held.value_or(false)).number(end.effect_held.value_or(false));
    add(hash, end.arguments);
    add(hash, end.missing_effects);
  }
}

class Doing {
 public:
  Doing(SessionCore& session, const KnownAgent& agent)
      : agent_(agent), world_(session.environment(agent.task, with_channels(agent))) {}

  std::string hash_of(SessionCore& session) {
    add(hash_, world_.reset(agent_.start));
    add(hash_, world_.instructions());
    const SavedState begun = world_.save();
    act();
    const std::string once = hash_.digest();
    add(hash_, world_.restore(begun));
    act();
    const Episode episode = world_.episode();
    hash_.text(episode.reason).text(episode.detail).text(once);
    for (const ArrayColumn& column : session.arrays(episode, {}).columns) {
      hash_.text(column.name);
      if (column.type() == "float64")
        for (const double value : column.reals()) add(hash_, value);
    }
    return hash_.digest();
  }

 private:
  static EnvironmentSettings with_channels(const KnownAgent& agent) {
    EnvironmentSettings settings = agent.settings;
    settings.channels = split(agent.channels, ' ');
    return settings;
  }

  void act() {
    Random random(RandomKey("known agent").with(agent_.task));
    for (int i = 0; i < agent_.skills && !over_; ++i) call_skill(random);
    for (const ActionSpace& space : world_.spaces())
      if (space.name != "skill" && space.name != "go_on" && !space.name.starts_with("tool_path"))
        for (int i = 0; i < agent_.set_points && !over_; ++i) set(space, i, random);
    step({.space = "hold", .frames = 2});
    over_ = false;
  }

  void call_skill(Random& random) {
    static const std::vector<std::string> controllers = {"", "joint_impedance", "cartesian_impedance"};
    std::vector<SkillChoice> choices = world_.skills();
    std::erase_if(choices, [](const SkillChoice& one) { return !one.feasible; });
    if (choices.empty()) return;
    const SkillChoice& one = choices[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(choices.size())))];
    step({.space = "skill",
          .controller = controllers[static_cast<std::size_t>(random.below(3))],
          .skill = one.skill,
          .arguments = one.arguments});
  }

  void set(const ActionSpace& space, int i, Random& random) {
    AgentAction action{.space = space.name};
    for (const ActionComponent& one : space.components)
      action.values.push_back(random.between(std::max(one.lower, -300.0), std::min(one.upper, 300.0)));
    if (i % 3 == 1 && space.name != "gripper" && space.name != "release") action.gripper = random.between(0, 0.08);
    if (i % 2 == 1 && space.name.starts_with("tool_")) action.frame = "tool";
    step(action);
  }

  void step(const AgentAction& action) {
    const StepResult now = world_.step(action);
    add(hash_, now);
    over_ = now.terminated || now.truncated;
  }

  const KnownAgent& agent_;
  Environment world_;
  Hasher hash_;
  bool over_ = false;
};

}  // namespace

// As with runs: what an agent is told does not change from one release to the next, or a change says that it does.
TEST_CASE("agents of every kind are told what they are known by") {
  const auto session = std::make_shared<SessionCore>(kRoot, std::vector<std::filesystem::path>{}, "");
  for (const KnownAgent& agent : known_agents()) {
    CAPTURE(agent.task, agent.channels);
    CHECK(Doing(*session, agent).hash_of(*session) == agent.hash);
  }
}

}  // namespace stampede::program
