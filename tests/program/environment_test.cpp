// Acting in a task: every space, every channel, rewards, and going back.
#include <malloc.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <set>
#include <thread>

#include "db/catalogue.h"
#include "engine/base/random.h"
#include "engine/episode/runner.h"
#include "engine/record/arrays.h"
#include "engine/record/record.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// One for all tests.
std::shared_ptr<SessionCore> session() {
  static const auto core = std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
  return core;
}

Environment environment(const std::string& task, const EnvironmentSettings& settings = {}) {
  return session()->environment(task, settings);
}

AgentAction skill(const TaskPlanStep& step) {
  return {.space = "skill", .skill = step.action, .arguments = step.arguments};
}

// The skills of an episode that nobody called from within another one.
std::vector<TaskPlanStep> calls_of(const EpisodeRecord& record) {
  std::vector<TaskPlanStep> calls;
  for (const SegmentRecord& one : record.labels.segments) {
    if (one.kind != SegmentKind::skill) continue;
    if (record.labels.segments.at(static_cast<std::size_t>(one.parent)).kind != SegmentKind::subgoal) continue;
    calls.push_back({one.case_name.empty() ? one.skill : one.skill + "_" + one.case_name, one.arguments});
  }
  return calls;
}

// Within the bounds, and no further than a policy would go in a frame where they are wide.
AgentAction random_action(const ActionSpace& space, Random& random) {
  AgentAction action{.space = space.name};
  for (const ActionComponent& one : space.components)
    action.values.push_back(random.between(std::max(one.lower, -3000.0), std::min(one.upper, 3000.0)));
  return action;
}

const ActionSpace& space_of(const std::vector<ActionSpace>& spaces, const std::string& name) {
  return *std::find_if(spaces.begin(), spaces.end(), [&](const ActionSpace& one) { return one.name == name; });
}

// All that is observed, as one list of numbers.
std::vector<double> numbers(const EnvironmentObservation& observation) {
  std::vector<double> all = {static_cast<double>(observation.frame), observation.time_s};
  for (const ChannelValue& one : observation.channels)
    std::visit(
        [&](const auto& data) {
          if constexpr (std::is_arithmetic_v<typename std::remove_cvref_t<decltype(data)>::value_type>)
            for (const auto value : data) all.push_back(static_cast<double>(value));
        },
        one.data);
  return all;
}

// What two episodes have in common whoever drove them.
EpisodeArrays without_agent(EpisodeArrays arrays) {
  std::erase_if(arrays.columns, [](const ArrayColumn& one) { return one.name.starts_with("agent_"); });
  return arrays;
}

// Steps, and keeps what an episode should say of what was asked.
class Asker {
 public:
  explicit Asker(Environment world) : world_(std::move(world)) {}
  StepResult step(const AgentAction& action) {
    const std::int64_t frame = world_.observe().frame;
    StepResult now = world_.step(action);
    if (!now.refusal)
      asked.push_back({action, frame, now.observation.frame, -1, now.reward, now.terminated, now.truncated});
    return now;
  }
  Environment& world() { return world_; }

  std::vector<AskedAction> asked;

 private:
  Environment world_;
};

std::vector<double> row_of(const ArrayColumn& column, std::int64_t frame) {
  std::size_t width = 1;
  for (std::size_t i = 1; i < column.shape.size(); ++i) width *= static_cast<std::size_t>(column.shape[i]);
  const auto data = column.reals().subspan(static_cast<std::size_t>(frame) * width, width);
  return {data.begin(), data.end()};
}

// What a policy would do that knows the data by heart: for each frame what is stored of it, as single precision has it.
struct Played {
  bool success = false;
  std::string why = "not done";
  double force = 0;  // N, greatest between the robot and anything
};

Played play_stored_actions(const std::string& task, std::int64_t seed) {
  const Episode run = session()->run(task, {.seed = seed});
  const EpisodeRecord& demo = *run.record;
  Environment world = environment(task, {.hidden = true, .record = true});
  world.reset({.variation = demo.variation, .seed = seed});
  Played played;
  AgentAction action{.space = "joint_position"};
  constexpr std::size_t kMore = 20;  // frames: the last action stands
  for (std::size_t frame = 0; frame + 1 < demo.frames.size() + kMore && !played.success; ++frame) {
    if (frame + 1 < demo.frames.size()) {
      const ActionRecord& stored = *demo.frames[frame].action;
      action.values.clear();
      for (const double value : stored.joint_position) action.values.push_back(static_cast<float>(value));
      action.gripper = static_cast<float>(stored.gripper);
    }
    const StepResult now = world.step(action);
    played.success = now.success;
    if (now.refusal) played.why = now.refusal->what;
    if (now.refusal || now.terminated || now.truncated) break;
  }
  const Episode acted = world.episode();
  for (const ContactRecord& contact : acted.record->labels.contacts)
    if ((contact.object_a == "panda") != (contact.object_b == "panda"))
      played.force = std::max(played.force, contact.peak_force);
  return played;
}

}  // namespace

TEST_CASE("an agent that plays back a plan's skills gets the bytes of the run") {
  for (const std::string task : {"reach_target", "close_drawer", "pick_and_lift", "stack_blocks"}) {
    CAPTURE(task);
    const Episode run = session()->run(task, {.seed = 5, .on_failure = OnFailure::stop});
    REQUIRE(run.outcome == Outcome::success);
    Environment world = environment(task, {.record = true});
    world.reset({.seed = 5});
    StepResult now;
    for (const TaskPlanStep& step : calls_of(*run.record)) {
      now = world.step(skill(step));
      REQUIRE_FALSE(now.refusal);
      REQUIRE(now.ended.size() == 1);
      CHECK(now.ended.front().success);
      CHECK(now.ended.front().effect_held == true);
      CHECK_FALSE(now.terminated);
    }
    now = world.step({.space = "hold"});
    CHECK(now.terminated);
    CHECK(now.success);
    CHECK(now.reward == 1);
    const Episode acted = world.episode();
    CHECK(acted.outcome == Outcome::success);
    CHECK(acted.key != run.key);
    CHECK(first_difference(session()->arrays(run, {}), without_agent(session()->arrays(acted, {}))) == "");
    CHECK(first_difference(session()->arrays(acted, {}), session()->arrays(run, {})) == "");
    CHECK(acted.record->labels.segments.size() == run.record->labels.segments.size());
  }
}

TEST_CASE("every action space moves the arm within its limits, and what was done replays") {
  const std::vector<std::string> spaces = {"joint_position", "joint_delta", "joint_velocity", "joint_torque",
                                           "tool_pose",      "tool_delta",  "tool_velocity",  "tool_impedance",
                                           "gripper",        "release"};
  for (const std::string& name : spaces) {
    CAPTURE(name);
    const bool of_hand = name == "gripper" || name == "release";
    Environment world = environment("pick_and_lift", {.channels = {"joint_positions", "gripper_pose"}, .record = true});
    EnvironmentObservation seen = world.reset({.seed = 11});
    const std::vector<double> first = seen["joint_positions"].reals();
    const auto limits = space_of(world.spaces(), "joint_position").components;
    REQUIRE(first.size() == limits.size());
    Random random(RandomKey("actions").with(name));
    const ActionSpace space = space_of(world.spaces(), name);
    double moved = 0;
    for (int i = 0; i < 60; ++i) {
      AgentAction action = random_action(space, random);
      if (name == "tool_pose" || name == "tool_impedance") {  // near where the tool is, or nothing reaches it
        const std::vector<double> pose = seen["gripper_pose"].reals();
        for (std::size_t k = 0; k < 7; ++k) action.values[k] = pose[k];
        for (std::size_t k = 0; k < 3; ++k) action.values[k] += random.between(-0.03, 0.03);
      }
      if (i % 7 == 0 && !of_hand) action.gripper = random.between(0, 0.08);
      const StepResult now = world.step(action);
      if (now.refusal)
        CHECK_THAT(now.refusal->what, Catch::Contains("no joint positions"));
      else
        CHECK(now.frames == 1);
      seen = now.observation;
      const std::vector<double>& q = seen["joint_positions"].reals();
      for (std::size_t j = 0; j < q.size(); ++j) {
        REQUIRE(std::isfinite(q[j]));
        CHECK(q[j] >= limits[j].lower - 1.1e-3);
        CHECK(q[j] <= limits[j].upper + 1.1e-3);
        moved = std::max(moved, std::abs(q[j] - first[j]));
      }
    }
    if (!of_hand) CHECK(moved > 0.05);
    const Episode episode = world.episode();
    CHECK(episode.reason == "goal_false");
    REQUIRE(episode.record);
    CHECK(replay_episode(*episode.record).empty());
    CHECK(episode.record->labels.segments.back().skill == "control");
  }
}

TEST_CASE("a position is reached, a velocity is kept, and a path goes around what is in the way") {
  Environment world =
      environment("reach_target", {.channels = {"joint_positions", "joint_velocities", "gripper_pose"}});
  const std::vector<double> start = world.reset({.seed = 1})["joint_positions"].reals();
  std::vector<double> wanted = start;
  for (double& value : wanted) value += 0.1;
  StepResult now;
  for (int i = 0; i < 10; ++i) now = world.step({.space = "joint_position", .values = wanted});
  for (std::size_t j = 0; j < wanted.size(); ++j)
    CHECK(now.observation["joint_positions"].reals()[j] == Approx(wanted[j]).margin(2e-3));
  std::vector<double> still(wanted.size(), 0.0), turning = still;
  turning[0] = 0.5;
  for (int i = 0; i < 8; ++i) now = world.step({.space = "joint_velocity", .values = turning});
  CHECK(now.observation["joint_velocities"].reals()[0] == Approx(0.5).margin(0.02));
  for (int i = 0; i < 6; ++i) now = world.step({.space = "joint_velocity", .values = still});
  CHECK(now.observation["joint_velocities"].reals()[0] == Approx(0).margin(2e-3));
  std::vector<double> pose = now.observation["gripper_pose"].reals();
  pose[0] -= 0.1, pose[1] += 0.1;
  now = world.step({.space = "tool_path", .values = pose});
  REQUIRE_FALSE(now.refusal);
  REQUIRE(now.ended.size() == 1);
  CHECK(now.ended.front().success);
  CHECK(now.frames > 3);
  for (std::size_t k = 0; k < 3; ++k) CHECK(now.observation["gripper_pose"].reals()[k] == Approx(pose[k]).margin(3e-3));
  now = world.step({.space = "tool_delta", .values = {0.02, 0, 0, 0, 0, 0}, .frame = "tool"});
  CHECK_FALSE(now.refusal);
  pose[2] = -3;  // below the floor
  now = world.step({.space = "tool_path", .values = pose});
  CHECK(now.refusal);
  CHECK(now.frames == 0);
}

TEST_CASE("what is held falls where the hand is told to release it, and the hand is open then") {
  Environment world = environment("pick_and_lift", {.channels = {"gripper_opening", "gripper_touch_forces"}});
  world.reset({.seed = 3});
  const std::vector<SkillChoice> choices = world.skills();
  const auto pick = std::find_if(choices.begin(), choices.end(),
                                 [](const SkillChoice& one) { return one.feasible && one.skill == "pick"; });
  REQUIRE(pick != choices.end());
  StepResult now = world.step({.space = "skill", .skill = pick->skill, .arguments = pick->arguments});
  const auto force_on_pads = [&] {
    const std::vector<double>& forces = now.observation["gripper_touch_forces"].reals();
    return *std::max_element(forces.begin(), forces.end());
  };
  REQUIRE(force_on_pads() > 1);
  for (int i = 0; i < 30; ++i) now = world.step({.space = "release"});
  CHECK(force_on_pads() == 0);
  CHECK(now.observation["gripper_opening"].reals()[0] == Approx(0.08).margin(1e-3));
}

TEST_CASE("what kept the arm from going as an action asks is told, and nothing where it goes so") {
  Environment world = environment("reach_target");
  world.reset({.seed = 1});
  const std::vector<double> still(7, 0.0);
  std::vector<double> turning = still;
  turning[0] = 0.5;
  StepResult now = world.step({.space = "joint_velocity", .values = turning});
  CHECK_THAT(now.limited, Catch::VectorContains(std::string("acceleration")));
  for (int i = 0; i < 12; ++i) now = world.step({.space = "joint_velocity", .values = turning});
  CHECK(now.limited == std::vector<std::string>{});
  now = world.step({.space = "joint_velocity", .values = still});
  for (int i = 0; i < 12; ++i) now = world.step({.space = "joint_velocity", .values = still});
  CHECK(now.limited == std::vector<std::string>{});
  std::set<std::string> limits;
  for (int i = 0; i < 80; ++i) {
    now = world.step({.space = "tool_velocity", .values = {0, 0, -0.4, 0, 0, 0}});
    limits.insert(now.limited.begin(), now.limited.end());
  }
  CHECK(limits.contains("approach"));   // of the table
  CHECK(limits.contains("reference"));  // which is ahead of an arm that stands on it
  now = world.step({.space = "hold"});
  CHECK(now.limited == std::vector<std::string>{});
}

TEST_CASE("the actions that are stored with a demo do its task again, a frame each") {
  // Knobs that turn on the spot, doors that are pushed and pulled, lids, a switch, and joints led up to their stops.
  for (const char* task :
       {"turn_tap", "change_clock", "close_drawer", "close_fridge", "close_laptop_lid", "open_door", "open_window",
        "toilet_seat_down", "press_switch", "put_knife_on_chopping_board", "put_tray_in_oven"}) {
    CAPTURE(task);
    const Played played = play_stored_actions(task, 0);
    CAPTURE(played.why);
    CHECK(played.success);
    CHECK(played.force < 100);
  }
}

TEST_CASE("what was moved from says so, whatever it is asked") {
  const auto said = Catch::Contains("moved from");
  Environment first = environment("reach_target");
  first.reset();
  Environment second = std::move(first);
  second.reset();
  // NOLINTBEGIN(bugprone-use-after-move)
  CHECK_THROWS_WITH(first.reset(), said);
  CHECK_THROWS_WITH(first.step({.space = "hold"}), said);
  CHECK_THROWS_WITH(first.frame_hz(), said);
  CHECK_THROWS_WITH(first.save(), said);
  // NOLINTEND(bugprone-use-after-move)
  first = std::move(second);
  first.reset();
}

TEST_CASE("the goal must hold for as many frames, however an agent waits for it") {
  const auto pose = [](const StepResult& now) { return now.observation["gripper_pose"].reals(); };
  const auto hold = [](int frames) {
    return [frames](const StepResult&) { return AgentAction{.space = "hold", .frames = frames}; };
  };
  const auto path = [&](int frames) {
    return [&pose, frames](const StepResult& now) {
      std::vector<double> there = pose(now);
      there[2] = there[2] < 0.85 ? 0.9 : 0.8;
      return AgentAction{.space = "tool_path", .values = there, .frames = frames};
    };
  };
  const auto either = [](const StepResult& now) {
    if (now.frames == 3) return AgentAction{.space = "gripper", .values = {0.08}};
    return AgentAction{.space = "hold", .frames = 3};
  };
  const auto on = [](const StepResult& now) {
    return AgentAction{.space = now.running.empty() ? "hold" : "go_on", .frames = 4};
  };
  struct Way {
    std::string name;
    std::function<AgentAction(const StepResult&)> act;
    int most = 20;
  };
  const Environment drawn = environment("lamp_on");
  REQUIRE(drawn.frame_hz() == 20);
  for (const Way& way : std::vector<Way>{{"hold", hold(0)},
                                         {"a frame", hold(1)},
                                         {"some frames", hold(3), 21},
                                         {"all frames", hold(20)},
                                         {"more frames", hold(40)},
                                         {"a hand and some frames", either},
                                         {"on and on", on},
                                         {"a path, cut off", path(2)},
                                         {"a path", path(0), 60}}) {
    CAPTURE(way.name);
    Environment world = environment("lamp_on", {.channels = {"gripper_pose"}, .record = true});
    world.reset({.seed = 5});
    StepResult now = world.step({.space = "skill", .skill = "press", .arguments = {"lamp.button", "panda.hand"}});
    REQUIRE(now.ended.front().success);
    std::int64_t frames = 0;
    while (!now.terminated && frames < 100) {
      now = world.step(way.act(now));
      CAPTURE(now.refusal ? now.refusal->what : "");
      REQUIRE_FALSE(now.refusal);
      frames += now.frames;
    }
    CHECK(now.success);
    CHECK(now.running.empty());
    CHECK(frames >= 20);
    CHECK(frames <= way.most);
    CHECK(world.episode().outcome == Outcome::success);
  }
}

TEST_CASE("what cannot be done is said, and nothing changes") {
  Environment world = environment("stack_blocks", {.channels = {"task_low_dim_state", "joint_positions", "facts"}});
  const std::vector<double> before = numbers(world.reset({.seed = 2}));
  const double nan = std::nan("");
  const std::vector<double> zero(7, 0.0);
  const std::vector<std::pair<AgentAction, std::string>> wrong = {
      {{.space = "joint_positions", .values = zero}, "there is no action space"},
      {{.space = "joint_velocity", .values = {0, 0, 0}}, "has 7 values, not 3"},
      {{.space = "joint_velocity", .values = {0, nan, 0, 0, 0, 0, 0}}, "not a finite number"},
      {{.space = "joint_velocity", .values = {0, 99, 0, 0, 0, 0, 0}}, "out of its bounds"},
      {{.space = "joint_velocity", .values = zero, .gripper = 0.5}, "out of its bounds"},
      {{.space = "joint_velocity", .values = zero, .controller = "magic"}, "there is no controller"},
      {{.space = "tool_delta", .values = {0, 0, 0, 0, 0, 0}, .frame = "camera"}, "frame of reference"},
      {{.space = "tool_pose", .values = {0.4, 0, 0.3, 0, 0, 0, 0}}, "quaternion has no length"},
      {{.space = "tool_pose", .values = {0.3, 0.3, 1.4, 1, 0, 0, 0}}, "no joint positions"},
      {{.space = "skill", .skill = "pik"}, "there is no skill 'pik'"},
      {{.space = "skill", .skill = "pick", .arguments = {"block1"}}, "takes 3 arguments"},
      {{.space = "skill", .skill = "pick", .arguments = {"nothing", "table", "panda.hand"}}, "there is no 'nothing'"},
      {{.space = "skill",
        .skill = "pick",
        .arguments = {"block1", "table", "panda.hand"},
        .parameters = {{"speed", {1}}}},
       "no continuous parameter"},
      {{.space = "skill",
        .skill = "pick",
        .arguments = {"block1", "table", "panda.hand"},
        .parameters = {{"grasp", {1}}}},
       "has 7 values, not 1"},
      {{.space = "hold", .frames = -1}, "not negative"},
      {{.space = "go_on"}, "nothing that could go on"},
  };
  for (const auto& [action, what] : wrong) {
    CAPTURE(action.space, what);
    const StepResult now = world.step(action);
    REQUIRE(now.refusal);
    CHECK_THAT(now.refusal->what, Catch::Contains(what));
    CHECK(now.frames == 0);
    CHECK(numbers(now.observation) == before);
  }
  CHECK_THROWS_WITH(environment("stack_blocks").step({.space = "hold"}), Catch::Contains("call reset()"));
  CHECK_THROWS_WITH(environment("stack_block"), Catch::Contains("stack_blocks"));
  CHECK_THROWS_WITH(world.reset({.variation = "colour=plaid"}), Catch::Contains("has no variation"));
  CHECK_THROWS_WITH(world.reset({.channels = std::vector<std::string>{"joint_position"}}),
                    Catch::Contains("joint_positions"));
}

TEST_CASE("an arm may be sent to where it was measured, a little beyond its stops") {
  Environment world = environment("pick_and_lift", {.channels = {"joint_positions", "gripper_opening"}});
  const EnvironmentObservation before = world.reset({.seed = 2});
  AgentAction action{.space = "joint_position", .values = before["joint_positions"].reals()};
  action.values.resize(7);  // without the fingers
  const ActionComponent turn = world.spaces().front().components[6];
  REQUIRE(turn.name == "panda.joint7");
  const auto sent_over = [&](double joint, double hand) {
    action.values[6] = turn.upper + joint;
    action.gripper = 0.08 + hand;
    const std::optional<ActionRefusal> refusal = world.step(action).refusal;
    return refusal ? refusal->what : "";
  };
  for (int i = 0; i < 60; ++i) REQUIRE(sent_over(0.9e-3, 0.9e-3) == "");
  const EnvironmentObservation now = world.step(action).observation;
  CHECK(now["joint_positions"].reals()[6] == Approx(turn.upper).margin(1e-3));
  CHECK(now["gripper_opening"].reals()[0] == Approx(0.08).margin(1e-3));
  CHECK_THAT(sent_over(1.1e-3, 0), Catch::StartsWith("panda.joint7 is out of its bounds"));
  CHECK_THAT(sent_over(0, 1.1e-3), Catch::StartsWith("opening is out of its bounds"));
}

TEST_CASE("a skill goes on in parts, and another action cuts it off") {
  const TaskPlan plan = session()->plan("pick_and_lift", {.seed = 3});
  REQUIRE_FALSE(plan.steps.empty());
  Environment whole = environment("pick_and_lift"), parts = environment("pick_and_lift", {.record = true});
  whole.reset({.seed = 3});
  parts.reset({.seed = 3});
  const StepResult once = whole.step(skill(plan.steps.front()));
  AgentAction some = skill(plan.steps.front());
  some.frames = 4;
  StepResult now = parts.step(some);
  CHECK(now.frames == 4);
  CHECK_THAT(now.running, Catch::StartsWith("(pick"));
  CHECK(now.ended.empty());
  while (!now.running.empty()) now = parts.step({.space = "go_on", .frames = 3});
  CHECK(numbers(now.observation) == numbers(once.observation));
  CHECK(now.ended.front().success);

  parts.reset({.seed = 3});
  parts.step(some);
  now = parts.step({.space = "joint_velocity", .values = std::vector<double>(7, 0.0)});
  REQUIRE(now.ended.size() == 1);
  CHECK(now.ended.front().reason == "interrupted");
  CHECK(now.running.empty());
  now = parts.step(skill(plan.steps.front()));  // and it can be begun again
  REQUIRE(now.ended.size() == 1);
  CHECK(now.ended.front().success);
  const Episode episode = parts.episode();
  CHECK(replay_episode(*episode.record).empty());
  std::vector<std::string> names;
  for (const SegmentRecord& one : episode.record->labels.segments)
    if (one.kind == SegmentKind::skill || one.skill == "control") names.push_back(one.skill);
  CHECK(names == std::vector<std::string>{"pick", "control", "pick"});
}

TEST_CASE("parameters and the controller of a skill are the agent's to choose") {
  const TaskPlan plan = session()->plan("pick_and_lift", {.seed = 3});
  Environment world = environment("pick_and_lift", {.record = true});
  world.reset({.seed = 3});
  const auto described = world.skill_descriptions();
  const auto pick =
      std::find_if(described.begin(), described.end(), [](const auto& one) { return one.skill == "pick"; });
  REQUIRE(pick != described.end());
  const auto height = std::find_if(pick->continuous.begin(), pick->continuous.end(),
                                   [](const auto& one) { return one.name == "height"; });
  REQUIRE(height != pick->continuous.end());
  CHECK(height->unit == "m");
  const double wanted = (height->lower[0] + height->upper[0]) / 2;
  AgentAction action = skill(plan.steps.front());
  action.parameters = {{"height", {wanted}}};
  action.controller = "joint_impedance";
  const StepResult now = world.step(action);
  REQUIRE_FALSE(now.refusal);
  CHECK(now.ended.front().success);
  const Episode episode = world.episode();
  const auto segment = std::find_if(episode.record->labels.segments.begin(), episode.record->labels.segments.end(),
                                    [](const SegmentRecord& one) { return one.kind == SegmentKind::skill; });
  CHECK(segment->controller == "joint_impedance");
  int chosen = 0;
  for (const ParameterRecord& one : segment->parameters) {
    if (one.name == "height") CHECK(one.values == std::vector<double>{wanted});
    if (one.name == "height" || one.name == "controller") chosen += one.chosen_by == ChosenBy::agent ? 1 : 0;
  }
  CHECK(chosen == 2);
}

TEST_CASE("the skills that can be done now are those whose precondition holds") {
  Environment world = environment("stack_blocks", {.channels = {"applicable", "feasible_skills"}});
  EnvironmentObservation seen = world.reset({.seed = 4});
  for (int round = 0; round < 2; ++round) {
    const std::vector<SkillChoice> choices = world.skills();
    std::vector<std::string> names;
    REQUIRE(seen["applicable"].bytes().size() == choices.size());
    for (std::size_t i = 0; i < choices.size(); ++i) CHECK((seen["applicable"].bytes()[i] != 0) == choices[i].feasible);
    CHECK(seen["feasible_skills"].texts().size() ==
          static_cast<std::size_t>(
              std::count_if(choices.begin(), choices.end(), [](const auto& one) { return one.feasible; })));
    int tried = 0;
    const SavedState here = world.save();
    for (const SkillChoice& one : choices) {  // what is masked is refused by its precondition, the rest is not
      if (tried > 5) break;
      tried += one.feasible ? 0 : 1;
      if (one.feasible) continue;
      const StepResult now = world.step({.space = "skill", .skill = one.skill, .arguments = one.arguments});
      REQUIRE(now.ended.size() == 1);
      CHECK(now.ended.front().precondition_held == false);
      CHECK(now.ended.front().reason == "precondition_false");
      world.restore(here);
    }
    const auto pick = std::find_if(choices.begin(), choices.end(),
                                   [](const SkillChoice& one) { return one.feasible && one.skill == "pick"; });
    if (round == 0) {
      REQUIRE(pick != choices.end());
      const StepResult now = world.step({.space = "skill", .skill = pick->skill, .arguments = pick->arguments});
      REQUIRE(now.ended.front().success);
      seen = now.observation;
    }
  }
}

TEST_CASE("a saved state branches: the same future, bit for bit, here and in another environment") {
  const EnvironmentSettings settings{
      .channels = {"joint_positions", "task_low_dim_state", "facts"}, .reward = RewardKind::dense, .record = true};
  Environment one = environment("stack_blocks", settings), two = environment("stack_blocks", settings);
  one.reset({.seed = 6});
  two.reset({.seed = 6});
  const TaskPlan plan = session()->plan("stack_blocks", {.seed = 6});
  one.step(skill(plan.steps.at(0)));
  const SavedState saved = one.save();
  const auto future = [&](Environment& world) {
    std::vector<double> all;
    Random random(RandomKey("future"));
    const ActionSpace space = space_of(world.spaces(), "joint_delta");
    for (int i = 0; i < 5; ++i) {
      const StepResult now = world.step(random_action(space, random));
      const std::vector<double> seen = numbers(now.observation);
      all.insert(all.end(), seen.begin(), seen.end());
      all.push_back(now.reward);
    }
    const StepResult now = world.step(skill(plan.steps.at(1)));
    const std::vector<double> seen = numbers(now.observation);
    all.insert(all.end(), seen.begin(), seen.end());
    all.push_back(now.reward);
    return all;
  };
  const std::vector<double> first = future(one);
  const SavedState later = one.save();
  one.restore(saved);
  one.step({.space = "gripper", .values = {0.08}});  // another branch
  one.restore(saved);
  CHECK(future(one) == first);
  two.restore(saved);
  CHECK(future(two) == first);
  two.restore(later);  // from another branch to a later moment
  const Episode episode = two.episode();
  CHECK(replay_episode(*episode.record).empty());
  Environment fresh = environment("stack_blocks", settings), begun = environment("stack_blocks", settings);
  fresh.reset(saved);  // the start is made for it
  CHECK(future(fresh) == first);
  CHECK(replay_episode(*fresh.episode().record).empty());
  fresh.reset(saved);  // and anew, once the episode was taken
  CHECK(future(fresh) == first);
  begun.restore(saved);
  CHECK(future(begun) == first);
  begun.reset({.seed = 7});
  CHECK_THROWS_WITH(begun.restore(saved), Catch::Contains("of another task"));
  begun.reset(saved);
  CHECK(future(begun) == first);
  Environment other = environment("reach_target");
  CHECK_THROWS_WITH(other.restore(saved),
                    Catch::Contains("the state is of task 'stack_blocks', not of 'reach_target'"));
  other.reset();
  CHECK_THROWS_WITH(other.restore(saved), Catch::Contains("of another task"));
  Environment unrecorded = environment("reach_target"), recorded = environment("reach_target", {.record = true});
  unrecorded.reset({});
  CHECK_THROWS_WITH(recorded.restore(unrecorded.save()), Catch::Contains("saved without a record"));
  CHECK_THROWS_WITH(one.restore({}), Catch::Contains("empty state"));
}

TEST_CASE("going back takes with it what was recorded since, and what was seen is seen again") {
  const EnvironmentSettings settings{
      .channels = {"facts", "applicable", "feasible_skills", "plan", "goal", "pddl", "sentences", "gripper_pose"},
      .record = true};
  Environment straight = environment("stack_blocks", settings), winding = environment("stack_blocks", settings);
  const auto same = [](const EnvironmentObservation& a, const EnvironmentObservation& b) {
    REQUIRE(a.channels.size() == b.channels.size());
    for (std::size_t i = 0; i < a.channels.size(); ++i) {
      INFO(a.channels[i].name);
      CHECK(a.channels[i].data == b.channels[i].data);
    }
  };
  straight.reset({.seed = 6});
  winding.reset({.seed = 6});
  const TaskPlan plan = session()->plan("stack_blocks", {.seed = 6});
  const EnvironmentObservation first = winding.observe();
  const SavedState begin = winding.save();
  straight.save();  // what is saved is marked among the commands
  winding.step(skill(plan.steps.at(0)));
  winding.step(skill(plan.steps.at(1)));
  winding.restore(begin);
  same(winding.observe(), first);
  for (Environment* world : {&straight, &winding})
    for (const TaskPlanStep& step : plan.steps) world->step(skill(step));
  same(winding.observe(), straight.observe());
  const Episode a = straight.episode(), b = winding.episode();
  CHECK(a.record->labels.grasps.size() == 2 * plan.steps.size() / 4);
  CHECK(b.record->labels.grasps.size() == a.record->labels.grasps.size());
  CHECK(b.record->labels.vias.size() == a.record->labels.vias.size());
  CHECK(b.record->labels.segments.size() == a.record->labels.segments.size());
  CHECK(b.record->labels.contacts.size() == a.record->labels.contacts.size());
  CHECK(b.record->frames.size() == a.record->frames.size());
  CHECK(b.record->agent_actions == a.record->agent_actions);
  CHECK(b.record->made.key == a.record->made.key);
}

TEST_CASE("where one thing is, seen from another") {
  Environment world = environment("stack_blocks", {.channels = {"object_pose_in/block1/block2", "object_pose"}});
  const EnvironmentObservation now = world.reset({.seed = 6});
  const std::vector<double>&seen = now["object_pose_in/block1/block2"].reals(),
        &one = now["object_pose/block1"].reals(), &two = now["object_pose/block2"].reals();
  REQUIRE(seen.size() == 7);
  const auto distance = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  };
  CHECK(std::abs(distance(one, two) - distance(seen, {0, 0, 0})) < 1e-9);
  CHECK_THROWS_WITH(environment("stack_blocks", {.channels = {"object_pose_in/block1/blok2"}}).reset({.seed = 6}),
                    Catch::Contains("there is no 'blok2' here") && Catch::Contains("block2"));
  CHECK_THROWS_WITH(environment("stack_blocks", {.channels = {"object_pose_in/block1"}}).reset({.seed = 6}),
                    Catch::Contains("there is no '' here"));
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)  // their allocators count nothing here
TEST_CASE("a saved state shares what was recorded before it: it costs the same however long that is") {
  Environment world = environment("reach_target", {.channels = {"joint_positions"}, .horizon_s = 200, .record = true});
  world.reset({.seed = 3});
  const auto act = [&](int frames) {
    for (int i = 0; i < frames; ++i) {
      const double turn = i % 40 < 20 ? 0.01 : -0.01;
      REQUIRE_FALSE(world.step({.space = "joint_delta", .values = std::vector<double>(7, turn)}).terminated);
    }
  };
  const auto cost = [&] {  // bytes a state, of many with some frames between them
    constexpr int kStates = 32;
    std::vector<SavedState> states(kStates);
    const std::size_t frames = ::mallinfo2().uordblks;
    act(kStates);
    const std::size_t before = ::mallinfo2().uordblks;
    for (SavedState& state : states) state = world.save(), act(1);
    return (static_cast<double>(::mallinfo2().uordblks - before) - static_cast<double>(before - frames)) / kStates;
  };
  act(100);
  const double early = cost();
  act(1200);
  const double late = cost();
  CAPTURE(early, late);
  CHECK(late < 100'000);
  CHECK(late < 1.2 * early + 4'000);
  const Episode episode = world.episode();
  CHECK(replay_episode(*episode.record).empty());
  CHECK(episode.record->agent_actions.size() == 1428);
}
#endif

TEST_CASE("a request in braces is the default start, and what a task offers is known before it") {
  Environment world = environment("stack_blocks", {.frame_hz = 10, .horizon_s = 7});
  const std::vector<ActionSpace> spaces = world.spaces();
  const auto skills = world.skill_descriptions();
  CHECK(space_of(spaces, "joint_position").components.size() == 7);
  CHECK(world.frame_hz() == 10);
  CHECK(world.horizon_s() == 7);
  CHECK_FALSE(skills.empty());
  const std::vector<double> braces = numbers(world.reset({})), nothing = numbers(world.reset());
  CHECK(braces == nothing);
  CHECK(world.frame_hz() == 10);
  CHECK(world.horizon_s() == 7);
  REQUIRE(world.spaces().size() == spaces.size());
  for (std::size_t i = 0; i < spaces.size(); ++i) {
    const ActionSpace now = world.spaces()[i];
    CHECK(now.name == spaces[i].name);
    REQUIRE(now.components.size() == spaces[i].components.size());
    for (std::size_t k = 0; k < now.components.size(); ++k) {
      CHECK(now.components[k].name == spaces[i].components[k].name);
      CHECK(now.components[k].lower == spaces[i].components[k].lower);
      CHECK(now.components[k].upper == spaces[i].components[k].upper);
    }
  }
  REQUIRE(world.skill_descriptions().size() == skills.size());
  for (std::size_t i = 0; i < skills.size(); ++i) CHECK(world.skill_descriptions()[i].skill == skills[i].skill);
}

TEST_CASE("cameras have sizes of their own, and are drawn when asked") {
  Environment world = environment(
      "reach_target",
      {.channels = {"front_rgb", "wrist_rgb"}, .width = 32, .height = 24, .picture_sizes = {{"wrist", {20, 10}}}});
  const EnvironmentObservation seen = world.reset({.seed = 3});
  CHECK(seen["front_rgb"].shape == std::vector<std::int64_t>{24, 32, 3});
  CHECK(seen["wrist_rgb"].shape == std::vector<std::int64_t>{10, 20, 3});
  CHECK(world.picture("wrist").bytes() == seen["wrist_rgb"].bytes());
  CHECK(world.picture("overhead", {16, 8}).shape == std::vector<std::int64_t>{8, 16, 3});
  world.step({.space = "joint_position", .values = {0.5, 0.1, 0, -1, 0, 1.2, 0.8}});
  CHECK(world.picture("wrist").bytes() != seen["wrist_rgb"].bytes());
  CHECK_THROWS_WITH(world.picture("wrst"), Catch::Contains("did you mean 'wrist'"));
  CHECK_THROWS_WITH(environment("reach_target", {.picture_sizes = {{"frnt", {8, 8}}}}).reset(),
                    Catch::Contains("did you mean 'front'"));
}

TEST_CASE("the goal is one number an atom") {
  Environment stack = environment("stack_blocks", {.channels = {"goal"}});
  const EnvironmentObservation seen = stack.reset({.variation = "height=2", .seed = 1});
  const std::vector<StateFact> atoms = stack.atoms();
  const std::vector<double>& goal = seen["goal"].reals();
  REQUIRE(goal.size() == atoms.size());
  for (std::size_t i = 0; i < atoms.size(); ++i) {
    const auto& arguments = atoms[i].arguments;
    const bool block_on_block = atoms[i].predicate == "on" && arguments[0].starts_with("block") &&
                                arguments[1].starts_with("block") && arguments[0] != arguments[1];
    CHECK(goal[i] == (block_on_block || atoms[i].predicate == "hand_empty" ? 1 : 0));
  }
  Environment usb = environment("take_usb_out_of_computer", {.channels = {"goal"}});
  const std::vector<double> signs = usb.reset()["goal"].reals();
  CHECK(std::count(signs.begin(), signs.end(), -1) == 2);  // in neither port
}

TEST_CASE("channels say what the arrays of the recorded episode say") {
  Environment world = environment("close_drawer", {.channels = {"time",
                                                                "joint_positions",
                                                                "joint_velocities",
                                                                "joint_forces",
                                                                "gripper_open",
                                                                "gripper_pose",
                                                                "gripper_matrix",
                                                                "gripper_touch_forces",
                                                                "task_low_dim_state",
                                                                "object_pose",
                                                                "object_pose_in_tool",
                                                                "object_joint_positions",
                                                                "progress",
                                                                "front_camera_intrinsics",
                                                                "wrist_camera_extrinsics",
                                                                "front_rgb",
                                                                "wrist_depth",
                                                                "front_point_cloud",
                                                                "sentences",
                                                                "pddl",
                                                                "fact_names",
                                                                "known"},
                                                   .record = true,
                                                   .width = 32,
                                                   .height = 32});
  std::vector<EnvironmentObservation> seen = {world.reset({.seed = 8})};
  AgentAction some = skill(session()->plan("close_drawer", {.seed = 8}).steps.front());
  some.frames = 9;
  seen.push_back(world.step(some).observation);
  seen.push_back(world.step({.space = "go_on", .frames = 20}).observation);
  seen.push_back(world.step({.space = "gripper", .values = {0.05}}).observation);
  const Episode episode = world.episode();
  const EpisodeArrays arrays = session()->arrays(episode, {});
  for (const EnvironmentObservation& now : seen) {
    CAPTURE(now.frame);
    int compared = 0;
    for (const ChannelValue& one : now.channels) {
      const ArrayColumn* column = arrays.find(one.name);
      if (column == nullptr || column->type() != "float64") continue;
      CAPTURE(one.name);
      ++compared;
      CHECK(one.unit == column->unit);
      CHECK(one.frame == column->frame);
      if (column->rate_hz == 0) {
        CHECK(one.shape == column->shape);
        continue;
      }
      CHECK(one.shape == std::vector<std::int64_t>(column->shape.begin() + 1, column->shape.end()));
      CHECK(one.reals() == row_of(*column, now.frame));
    }
    CHECK(compared > 15);
    CHECK(now["front_camera_intrinsics"].reals()[0] > 0);
    CHECK(now["front_rgb"].shape == std::vector<std::int64_t>{32, 32, 3});
    CHECK(now["front_rgb"].bytes() ==
          session()->picture(episode, now.frame, {.camera = "front", .width = 32, .height = 32}).rgb);
    CHECK(now["front_point_cloud"].shape == std::vector<std::int64_t>{32, 32, 3});
    CHECK_FALSE(now["sentences"].texts().empty());
    CHECK_THAT(now["pddl"].texts().front(), Catch::Contains("(:goal"));
  }
  CHECK_THROWS_WITH(seen.front()["front_depth"], Catch::Contains("was not asked for"));
  CHECK_THROWS_WITH(seen.front()["pddl"].reals(), Catch::Contains("no float64"));
}

TEST_CASE("a camera has a rate of its own") {
  Environment world =
      environment("reach_target",
                  {.channels = {"front_rgb", "wrist_rgb"}, .width = 16, .height = 12, .picture_hz = {{"wrist", 5}}});
  EnvironmentObservation before = world.reset();
  const AgentAction turn{.space = "joint_velocity", .values = {1, 0.5, 0, 0, 0, 1, 1}};
  std::vector<int> news;  // frames at which the wrist's picture is another one
  int front_news = 0;
  for (int frame = 1; frame <= 8; ++frame) {
    EnvironmentObservation now = world.step(turn).observation;
    if (now["wrist_rgb"].bytes() != before["wrist_rgb"].bytes()) news.push_back(frame);
    front_news += now["front_rgb"].bytes() != before["front_rgb"].bytes() ? 1 : 0;
    before = std::move(now);
  }
  CHECK(news == std::vector{4, 8});
  CHECK(front_news > 4);
}

TEST_CASE("what nobody can see is left out unless it is asked for") {
  for (const bool hidden : {false, true}) {
    Environment world =
        environment("find_item_in_drawer", {.channels = {"object_pose/item", "facts"}, .hidden = hidden});
    const EnvironmentObservation seen = world.reset({.seed = 7});
    CHECK(std::isnan(seen["object_pose/item"].reals()[0]) != hidden);
    const std::vector<StateFact> atoms = world.atoms();
    bool known = false;
    for (std::size_t i = 0; i < atoms.size(); ++i)
      known =
          known || (seen["facts"].bytes()[i] != 0 && !atoms[i].arguments.empty() && atoms[i].arguments[0] == "item");
    CHECK(known == hidden);
  }
}

TEST_CASE("the dense reward rises along a demonstration, and is 1 where the goal holds alone") {
  // Tests beside facts, effects that come true one after the other, objects that the tip is in before they are grasped.
  for (const std::string task : {"reach_target", "close_drawer", "stack_blocks", "pick_up_cup",
                                 "take_toilet_roll_off_stand", "take_usb_out_of_computer"}) {
    CAPTURE(task);
    const Episode run = session()->run(task, {.seed = 3, .on_failure = OnFailure::stop});
    REQUIRE(run.outcome == Outcome::success);
    Environment world = environment(task, {.channels = {"progress"}, .reward = RewardKind::dense});
    world.reset({.seed = 3});
    double best = -1;
    StepResult now;
    for (const TaskPlanStep& step : calls_of(*run.record)) {
      AgentAction action = skill(step);
      action.frames = 1;
      for (now = world.step(action);; now = world.step({.space = "go_on", .frames = 1})) {
        CHECK(now.reward > best - 0.25);  // fingers that close push what they are about to hold
        if (now.reward == 1) CHECK(now.observation["progress"].reals()[0] == 1);
        best = std::max(best, now.reward);
        if (now.running.empty()) break;
      }
    }
    CHECK(now.reward == 1);
    CHECK(world.step({.space = "tool_pose", .values = {9, 9, 9, 0, 0, 0, 1}}).reward == 1);  // refused: as things stand
    CHECK(world.step({.space = "hold"}).success);
  }
}

TEST_CASE("an episode that ends between two frames is recorded to the next one, and replays") {
  const Folder folder;
  const Said made = say({"run", "push_buttons", "--root", kRoot, "--behaviour", "random_applicable", "--skills", "6",
                         "--episodes", "6", "--out", folder / "d.db"});
  CHECK((made.code == kDone || made.code == kNo));  // whether or not one of them succeeds by chance
  const Said out_of_order =
      say({"query", folder / "d.db", "SELECT count(*) FROM episodes WHERE reason = 'out_of_order'"});
  CHECK_FALSE(says(out_of_order.out, " 0"));
  CHECK(say({"replay", folder / "d.db"}).code == kDone);
}

TEST_CASE("an episode's frame is a start, and goes on as it did") {
  const Episode run = session()->run("pick_and_lift", {.seed = 9, .on_failure = OnFailure::stop});
  const EpisodeArrays arrays = session()->arrays(run, {});
  Environment world = environment("pick_and_lift", {.channels = {"joint_positions", "task_low_dim_state"}});
  const EnvironmentObservation seen = world.reset({.episode = run, .frame = run.frames / 2});
  CHECK(seen.frame == run.frames / 2);
  CHECK(seen["joint_positions"].reals() == row_of(arrays.column("joint_positions"), run.frames / 2));
  CHECK(seen["task_low_dim_state"].reals() == row_of(arrays.column("task_low_dim_state"), run.frames / 2));
  CHECK_FALSE(world.step({.space = "gripper", .values = {0.08}}).refusal);
  CHECK_THROWS_WITH(world.reset({.episode = run, .frame = run.frames}), Catch::Contains("it has no frame"));
  CHECK_THROWS_WITH(environment("reach_target").reset({.episode = run}), Catch::Contains("of task 'pick_and_lift'"));
}

TEST_CASE("rates, horizon, start and goal are the caller's") {
  Environment world = environment("pick_and_lift", {.frame_hz = 10, .physics_hz = 480, .horizon_s = 0.5});
  world.reset({.seed = 1});
  StepResult now;
  int steps = 0;
  do {
    now = world.step({.space = "gripper", .values = {0.08}});
    ++steps;
  } while (!now.terminated && !now.truncated && steps < 100);
  CHECK(steps == 5);
  CHECK(now.truncated);
  CHECK_FALSE(now.terminated);
  CHECK(now.reason == "timeout");
  CHECK(now.observation.time_s == Approx(0.5));
  CHECK(world.step({.space = "hold"}).refusal->what == "the episode has ended");
  CHECK_THROWS_WITH(environment("pick_and_lift", {.frame_hz = 7}).reset(), Catch::Contains("no whole number of steps"));

  Environment other = environment("close_drawer", {.channels = {"pddl"}});
  const EnvironmentObservation seen = other.reset({.seed = 2, .goal = "(open chest.top_drawer)"});
  CHECK_THAT(seen["pddl"].texts().front(), Catch::Contains("(open chest--top_drawer)"));
}

TEST_CASE("what an agent did is in the catalogue, with its name, and replays from there") {
  const Folder folder;
  const auto core =
      std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, folder / "d.db");
  Environment world = core->environment("reach_target", {.record = true});
  for (int i = 0; i < 2; ++i) {  // the same start, other actions: two episodes
    world.reset({.seed = 3});
    for (int k = 0; k < 6; ++k)
      world.step({.space = "joint_velocity", .values = std::vector<double>(7, 0.1 * (i + 1))});
    const Episode episode = world.episode();
    CHECK(episode.id == i + 1);
    CHECK(episode.frames == 7);
    CHECK(world.step({.space = "hold"}).refusal);
    CHECK_THROWS_WITH(world.episode(), Catch::Contains("taken already"));
  }
  CHECK(core->query("SELECT episode FROM episodes WHERE reason = 'goal_false'").rows.size() == 2);
  const auto stored = [&](std::int64_t id) {
    return std::get<std::int64_t>(
        core->query("SELECT count(*) FROM steps WHERE episode = " + std::to_string(id)).rows[0][0]);
  };
  CHECK(stored(1) == 7);
  CHECK(say({"replay", folder / "d.db"}).code == kDone);
  Environment unrecorded = core->environment("reach_target", {});
  unrecorded.reset();
  CHECK_THROWS_WITH(unrecorded.episode(), Catch::Contains("nothing was recorded"));
}

TEST_CASE(
    "what an agent asked for is kept as it was asked, in memory and in the catalogue, and what was refused is not") {
  const Folder folder;
  const auto stored =
      std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, folder / "d.db");
  const TaskPlanStep pick = session()->plan("pick_and_lift", {.seed = 3}).steps.front();
  std::vector<Episode> episodes;
  std::vector<std::vector<AskedAction>> asked;
  std::vector<ActionSpace> spaces;
  for (const auto& core : {session(), stored}) {
    Asker agent(core->environment("pick_and_lift",
                                  {.channels = {"gripper_pose"}, .reward = RewardKind::dense, .record = true}));
    std::vector<double> pose = agent.world().reset({.seed = 3})["gripper_pose"].reals();
    spaces = agent.world().spaces();
    pose[2] -= 0.03;
    const std::vector<double> turn(7, 0.01), still(7, 0.0);
    agent.step({.space = "joint_delta", .values = turn, .gripper = 0.05});
    agent.step({.space = "tool_delta", .values = {0.01, 0, 1.0 / 300, 0, 0.01, 0}, .frame = "tool"});
    agent.step({.space = "joint_velocity", .values = turn, .controller = "joint_impedance"});
    CHECK(agent.step({.space = "joint_delta", .values = std::vector<double>(7, 9.0)}).refusal);
    CHECK(agent.step({.space = "tool_path", .values = {0, 0, -3, 1, 0, 0, 0}}).refusal);
    CHECK(agent.step({.space = "skill", .skill = "pick", .arguments = {"nothing"}}).refusal);
    agent.step({.space = "joint_torque", .values = still});
    agent.step({.space = "gripper", .values = {0.08}});
    agent.step({.space = "tool_path", .values = pose, .gripper = 0.08, .frames = 3});
    agent.step({.space = "go_on"});
    agent.step(
        {.space = "tool_impedance", .values = {pose[0], pose[1], pose[2], pose[3], pose[4], pose[5], pose[6], 800}});
    AgentAction grasp = skill(pick);
    grasp.parameters = {{"height", {0.1}}};
    grasp.controller = "joint_impedance";
    grasp.frames = 4;
    agent.step(grasp);
    CHECK_FALSE(agent.step({.space = "go_on", .frames = 5}).running.empty());
    CHECK(agent.step({.space = "go_on"}).ended.front().success);
    agent.step({.space = "hold", .frames = 2});
    agent.step({.space = "tool_delta", .values = {0, 0, 0.01, 0, 0, 0}});
    agent.step({.space = "hold"});
    episodes.push_back(agent.world().episode());
    asked.push_back(agent.asked);
  }
  REQUIRE(episodes.front().record);
  CHECK(asked.front().size() == 14);
  CHECK(episodes.front().record->agent_actions == asked.front());
  const EpisodeArrays memory = session()->arrays(episodes.front(), {}), catalogue = stored->arrays(episodes.back(), {});
  CHECK(catalogue.agent_actions == asked.back());
  CHECK(asked.back() == asked.front());
  CHECK(first_difference(memory, catalogue) == "");
  CHECK(first_difference(catalogue, memory) == "");
  CHECK(Catalogue::open(folder / "d.db").read_episode(episodes.back().id).agent_actions == asked.back());
  CHECK(replay_episode(*episodes.front().record).empty());

  const auto ids = memory.column("agent_action").integers();
  const auto rewards = memory.column("agent_reward").reals();
  for (std::size_t i = 0; i < asked.front().size(); ++i) {
    const AskedAction& one = asked.front()[i];
    CAPTURE(i, one.asked.space);
    CHECK(one.first_frame == (i == 0 ? 0 : asked.front()[i - 1].end_frame));
    const std::string name = "agent_action/" + one.asked.space;
    for (std::int64_t frame = one.first_frame; frame < one.end_frame; ++frame) {
      CHECK(ids[static_cast<std::size_t>(frame)] == static_cast<std::int64_t>(i));
      if (one.asked.values.size() > 1) CHECK(row_of(memory.column(name), frame) == one.asked.values);
    }
    if (one.end_frame > one.first_frame) CHECK(rewards[static_cast<std::size_t>(one.end_frame - 1)] == one.reward);
  }
  CHECK(ids.back() == -1);
  CHECK(std::isnan(row_of(memory.column("agent_action/joint_delta"), 1)[0]));
  CHECK(memory.column("agent_action/gripper").reals()[0] == 0.05);
  CHECK(memory.column("agent_action/tool_delta").frame == "world or tool");
  CHECK(memory.column("agent_action/tool_impedance").unit == "m, 1, N/m");
  int described = 0;
  for (const ActionSpace& space : spaces) {
    const ArrayColumn* column = memory.find("agent_action/" + space.name);
    if (column == nullptr || space.name == "gripper") continue;
    CAPTURE(space.name);
    ++described;
    REQUIRE(column->labels.size() == space.components.size());
    for (std::size_t i = 0; i < space.components.size(); ++i) CHECK(column->labels[i] == space.components[i].name);
  }
  CHECK(described == 6);

  const Rows rows = stored->query(
      "SELECT parameters, controller, arguments ->> 0 AS first, end_frame - frame AS frames, segment "
      "FROM agent_actions WHERE skill = 'pick'");
  REQUIRE(rows.size() == 1);
  CHECK(rows.text(0, "parameters") == R"({"height":[0.1]})");
  CHECK(rows.text(0, "controller") == "joint_impedance");
  CHECK(rows.text(0, "first") == pick.arguments.front());
  CHECK(rows.integer(0, "frames") == 4);
  CHECK(rows.is_null(0, "segment"));
  CHECK(stored->query("SELECT * FROM agent_actions").size() == asked.back().size());
  CHECK(stored->query("SELECT options ->> 'reward' AS kind FROM episodes").text(0, "kind") == "dense");
}

TEST_CASE("actions of a branch that was left are gone, and the last one tells how the episode ended") {
  Asker agent(environment("reach_target", {.horizon_s = 0.3, .record = true}));
  agent.world().reset({.seed = 2});
  const AgentAction turn{.space = "joint_velocity", .values = std::vector<double>(7, 0.1)};
  agent.step(turn);
  const SavedState saved = agent.world().save();
  const std::vector<AskedAction> before = agent.asked;
  agent.step({.space = "gripper", .values = {0.02}});
  agent.step(turn);
  const SavedState later = agent.world().save();
  const std::vector<AskedAction> others = agent.asked;
  agent.world().restore(saved);
  agent.asked = before;
  agent.step({.space = "joint_delta", .values = std::vector<double>(7, 0.0)});
  agent.world().restore(later);
  agent.asked = others;
  StepResult now;
  while (!now.truncated) now = agent.step(turn);
  CHECK(agent.step(turn).refusal);
  CHECK(agent.asked.size() == 6);
  CHECK(agent.asked.back().truncated);
  const Episode episode = agent.world().episode();
  CHECK(episode.record->agent_actions == agent.asked);
}

TEST_CASE("who asks otherwise makes another episode, though the same was done") {
  std::set<std::string> keys, ends;
  for (const double gripper : {0.08, 0.08, -1.0}) {  // it is open already
    Environment world = environment("reach_target", {.record = true});
    world.reset({.seed = 2});
    AgentAction action{.space = "joint_velocity", .values = std::vector<double>(7, 0.1)};
    if (gripper >= 0) action.gripper = gripper;
    world.step(action);
    const Episode episode = world.episode();
    keys.insert(episode.key);
    ends.insert(episode.record->state_hash);
  }
  CHECK(keys.size() == 2);
  CHECK(ends.size() == 1);
}

TEST_CASE("environments in two threads do what one does alone") {
  const auto drive = [](std::int64_t seed) {
    Environment world = environment("reach_target");
    std::vector<double> all = numbers(world.reset({.seed = seed}));
    Random random(RandomKey("drive").with(seed));
    const ActionSpace space = space_of(world.spaces(), "joint_delta");
    for (int i = 0; i < 30; ++i) {
      const std::vector<double> now = numbers(world.step(random_action(space, random)).observation);
      all.insert(all.end(), now.begin(), now.end());
    }
    return all;
  };
  const std::vector<double> first = drive(1), second = drive(2);
  std::vector<double> a, b;
  std::thread left([&] { a = drive(1); }), right([&] { b = drive(2); });
  left.join();
  right.join();
  CHECK(a == first);
  CHECK(b == second);
}

}  // namespace stampede::program
