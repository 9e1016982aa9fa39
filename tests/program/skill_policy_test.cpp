// Policies as the bodies of skills.
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "engine/episode/runner.h"
#include "engine/record/record.h"
#include "engine/rollout/priority_policy.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

// Brings the tip to the target by small steps, as a network would that was trained to.
class Servo final : public Policy {
 public:
  void begin(const PolicyCall& call) override {
    target_ = call.arguments.at("target"), speed_ = call.parameters.at("gain")[0];
  }
  std::optional<AgentAction> act(const EnvironmentObservation& now) override {
    const std::vector<double>&tip = now["gripper_pose"].reals(), &goal = now["object_pose/" + target_].reals();
    AgentAction action{.space = "tool_velocity", .values = std::vector<double>(6, 0.0)};
    for (std::size_t i = 0; i < 3; ++i) action.values[i] = std::clamp(speed_ * (goal[i] - tip[i]), -0.4, 0.4);
    return action;
  }

 private:
  std::string target_;
  double speed_ = 1;
};

template <typename Act>
PolicyEntry entry(Act act) {
  class Simple final : public Policy {
   public:
    explicit Simple(Act own) : act_(own) {}
    std::optional<AgentAction> act(const EnvironmentObservation& now) override { return act_(now, frame_++); }

   private:
    Act act_;
    int frame_ = 0;
  };
  return {.make = [act] { return std::make_unique<Simple>(act); }};
}

// A folder in which `reach` has another body.
std::filesystem::path own_reach(const Folder& folder, const std::string& run) {
  std::filesystem::create_directories(folder / "skills");
  std::ofstream(folder / "skills/reach.lua") << R"(-- Bring the tip of the hand into the target.
return skill {
  params = { "target: target" },
  precondition = { is_not.at("target") },
  effect = { is.at("target") },
  continuous = { gain = { 3, min = 1, max = 5 } },
  label = "reach for the {target}",
  run = )" << run << "\n}\n";
  return folder / "";
}

std::shared_ptr<SessionCore> session(const Folder& folder, const std::string& run) {
  return std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector{own_reach(folder, run)}, "");
}

const SegmentRecord& skill_of(const Episode& episode) {
  const auto& segments = episode.record->labels.segments;
  return *std::find_if(segments.begin(), segments.end(),
                       [](const SegmentRecord& one) { return one.kind == SegmentKind::skill; });
}

}  // namespace

TEST_CASE("a policy is the body of a skill: planned, tested, labelled, and replayed without it") {
  const Folder folder;
  const auto core = session(folder, R"(policy("servo", { seconds = 8 }),)");
  core->add_policy("servo",
                   {.make = [] { return std::make_unique<Servo>(); }, .channels = {"gripper_pose", "object_pose"}});
  const Episode episode = core->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
  CAPTURE(episode.reason, episode.detail);
  CHECK(episode.outcome == Outcome::success);
  CHECK(replay_episode(*episode.record).empty());
  const SegmentRecord& skill = skill_of(episode);
  CHECK(skill.effect_held == true);
  CHECK_THAT(skill.label, Catch::StartsWith("reach for the"));
  int policies = 0;
  for (const SegmentRecord& one : episode.record->labels.segments) policies += one.skill == "policy" ? 1 : 0;
  CHECK(policies == 1);
  const auto& asked = episode.record->agent_actions;  // one at each frame of the skill until it is there
  REQUIRE(asked.size() > 10);
  for (std::size_t i = 0; i < asked.size(); ++i) {
    CHECK(asked[i].segment == skill.ordinal);
    CHECK(asked[i].first_frame == skill.span.first_frame + static_cast<std::int64_t>(i));
    CHECK(asked[i].end_frame == asked[i].first_frame + 1);
    CHECK(asked[i].asked.space == "tool_velocity");
    CHECK(asked[i].asked.controller.empty());
    CHECK_FALSE(asked[i].reward);
  }
  CHECK(asked.back().end_frame <= skill.span.end_frame);
}

TEST_CASE("a policy sees pictures of the size that it was registered with, and only those") {
  const Folder folder;
  const auto core = session(folder, R"(policy("looks", { seconds = 0.1 }),)");
  std::vector<std::vector<std::int64_t>> shapes;
  PolicyEntry looks = entry([&](const EnvironmentObservation& now, int) {
    CHECK(now.channels.size() == 1);
    const auto& shape = now["front_rgb"].shape;
    shapes.emplace_back(shape.begin(), shape.end());
    return std::optional<AgentAction>(AgentAction{.space = "hold"});
  });
  looks.channels = {"front_rgb"};
  looks.width = 24, looks.height = 16;
  core->add_policy("looks", looks);
  core->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
  REQUIRE_FALSE(shapes.empty());
  for (const auto& shape : shapes) CHECK(shape == std::vector<std::int64_t>{16, 24, 3});
}

TEST_CASE("a policy that fails ends its skill with the reason, and undo takes it back") {
  const Folder folder;
  const std::vector<std::pair<PolicyEntry, std::string>> bad = {
      {entry([](const auto&, int) -> std::optional<AgentAction> { throw std::runtime_error("no weights"); }),
       "no weights"},
      {entry([](const auto&, int) { return std::optional<AgentAction>({.space = "joint_torques"}); }),
       "no action space"},
      {entry(
           [](const auto&, int) { return std::optional<AgentAction>({.space = "gripper", .values = {std::nan("")}}); }),
       "not a finite number"},
      {entry([](const auto&, int) { return std::optional<AgentAction>({.space = "hold"}); }), "cannot ask for hold"},
      {entry([](const auto&, int) { return std::optional<AgentAction>({.space = "skill", .skill = "fly"}); }),
       "no skill 'fly'"},
  };
  for (const auto& [policy, what] : bad) {
    CAPTURE(what);
    const auto core = session(folder, R"(policy("bad"),)");
    core->add_policy("bad", policy);
    const Episode episode = core->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
    CHECK(episode.reason == "policy_error");
    CHECK_THAT(episode.detail, Catch::Contains(what));
    CHECK(episode.record->agent_actions.empty());
  }
  CHECK_THROWS_WITH(session(folder, "policy(\"bad\"),")->add_policy("", {}), Catch::Contains("has a name"));

  // Time is up, or it says that it is done: the effect is tested.
  for (const bool waits : {true, false}) {
    const auto still = session(folder, R"(policy("still", { seconds = 0.5 }),)");
    still->add_policy("still", entry([waits](const auto&, int) {
                        return waits ? std::optional<AgentAction>({.space = "gripper", .values = {0.04}})
                                     : std::nullopt;
                      }));
    const Episode idle = still->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
    CHECK(idle.reason == "effect_mismatch");
    const std::int64_t frames = waits ? 10 : 0;
    CHECK(idle.frames > frames);
  }
}

TEST_CASE("a policy that nobody registered is an error before anything runs") {
  const Folder folder, files;
  const std::string refused =
      "skills/reach.lua: policy 'servoo': nobody has registered it\n    did you mean 'servo'? a program registers";
  for (const std::string run : {R"(policy("servoo"),)", R"(function(robot) robot:policy 'servoo' end,)"}) {
    CAPTURE(run);
    const auto made = std::make_shared<int>(0);
    const auto core =
        std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector{own_reach(folder, run)}, files / "none.db");
    core->add_policy("servo", {.make = [made] { return ++*made, std::make_unique<Servo>(); }});
    CHECK_THROWS_WITH(core->run("reach_target", {.seed = 4}), Catch::StartsWith(refused));
    RunRequest request{.tasks = {"close_drawer", "reach_target"}, .workers = 2};
    CHECK_THROWS_WITH(core->run_all(request), Catch::StartsWith(refused));
    CHECK(core->query("SELECT count(*) AS n FROM episodes").integer(0, "n") == 0);
    request.tasks = {"close_drawer"};  // which does without the skill
    CHECK(core->run_all(request).finished == 1);
    CHECK(*made == 0);
    std::filesystem::remove(files / "none.db");
  }
  // A name that is told by nothing but the run itself: no episode comes of it either.
  const auto core = session(folder, R"(function(robot) robot:policy("ser" .. "voo") end,)");
  CHECK_THROWS_WITH(core->run("reach_target", {.seed = 4}), Catch::Contains("nobody has registered it"));
}

TEST_CASE("a channel that there is not is an error of the program that registered the policy") {
  const Folder folder;
  const auto core = session(folder, R"(policy("servo"),)");
  core->add_policy("servo", {.make = [] { return std::make_unique<Servo>(); }, .channels = {"griper_pose"}});
  CHECK_THROWS_WITH(core->run("reach_target", {.seed = 4}), Catch::Contains("griper_pose"));
}

TEST_CASE("a policy may ask for paths and skills, between set-points") {
  const Folder folder;
  const auto core = session(
      folder,
      R"(function(robot, p) robot:policy("mixed", { until_effect = false }) robot:move_to(robot:tip():with_position(robot:view():pose(p.target):position())) end,)");
  core->add_policy("mixed", entry([](const EnvironmentObservation& now, int frame) -> std::optional<AgentAction> {
                     if (frame < 5) return AgentAction{.space = "joint_velocity", .values = {0.2, 0, 0, 0, 0, 0, 0}};
                     if (frame == 5) {
                       std::vector<double> pose = now["gripper_pose"].reals();
                       pose[2] += 0.05;
                       return AgentAction{.space = "tool_path", .values = pose};
                     }
                     if (frame < 9) return AgentAction{.space = "joint_delta", .values = {0, 0, 0, 0, 0, 0, 0.05}};
                     return std::nullopt;
                   }));
  const Episode episode = core->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
  CAPTURE(episode.reason, episode.detail);
  CHECK(episode.outcome == Outcome::success);
  std::vector<std::string> motions;
  for (const SegmentRecord& one : episode.record->labels.segments)
    if (one.kind == SegmentKind::motion) motions.push_back(one.skill);
  CHECK(motions ==
        std::vector<std::string>{"policy", "brake", "move_to", "policy", "brake", "move_to", "settle", "hold"});
  CHECK(replay_episode(*episode.record).empty());
  const auto& asked = episode.record->agent_actions;
  REQUIRE(asked.size() == 9);
  for (std::size_t i = 1; i < asked.size(); ++i) CHECK(asked[i].first_frame == asked[i - 1].end_frame);
  CHECK(asked[5].asked.space == "tool_path");
  CHECK(asked[5].end_frame - asked[5].first_frame > 3);
  CHECK(asked[8].end_frame == asked[8].first_frame + 1);  // and not to the skill's end
}

TEST_CASE("what policies of tries that were undone asked for is gone with them") {
  const Folder folder;
  const auto core = session(folder, R"(policy("third", { seconds = 8 }),)");
  const auto calls = std::make_shared<int>(0);
  class Third final : public Policy {
   public:
    explicit Third(bool fails) : fails_(fails) {}
    void begin(const PolicyCall& call) override { servo_.begin(call); }
    std::optional<AgentAction> act(const EnvironmentObservation& now) override {
      if (!fails_) return servo_.act(now);
      if (++frame_ > 3) throw std::runtime_error("lost");
      return AgentAction{.space = "joint_velocity", .values = std::vector<double>(7, 0.1)};
    }

   private:
    Servo servo_;
    bool fails_ = false;
    int frame_ = 0;
  };
  core->add_policy("third", {.make = [calls] { return std::make_unique<Third>(++*calls < 3); },
                             .channels = {"gripper_pose", "object_pose"}});
  const Episode episode = core->run("reach_target", {.seed = 4});
  CAPTURE(episode.reason, episode.detail);
  CHECK(episode.outcome == Outcome::success);
  CHECK(episode.undone == 2);
  const auto& asked = episode.record->agent_actions;
  REQUIRE(asked.size() > 10);
  CHECK(asked.front().first_frame == skill_of(episode).span.first_frame);
  for (const AskedAction& one : asked) CHECK(one.asked.space == "tool_velocity");
}

TEST_CASE("an agent that calls a skill with a policy as its body: what both asked for is there, each with its frames") {
  const Folder folder;
  const auto core = std::make_shared<SessionCore>(
      STAMPEDE_SOURCE_DIR,
      std::vector{own_reach(folder, R"(policy("mixed", { until_effect = false, seconds = 30 }),)")}, folder / "d.db");
  core->add_policy("mixed", entry([](const EnvironmentObservation& now, int frame) -> std::optional<AgentAction> {
                     if (frame == 4) return std::nullopt;
                     if (frame != 2) return AgentAction{.space = "joint_delta", .values = std::vector<double>(7, 0.01)};
                     std::vector<double> pose = now["gripper_pose"].reals();
                     pose[2] += 0.05;
                     return AgentAction{.space = "tool_path", .values = pose};
                   }));
  Environment world = core->environment("reach_target", {.record = true});
  world.reset({.seed = 4});
  world.step({.space = "skill", .frames = 5, .skill = "reach", .arguments = {"target", "panda.hand"}});
  StepResult now;
  int parts = 0;
  for (; now.ended.empty() && parts < 100; ++parts) now = world.step({.space = "go_on", .frames = 5});
  const Episode episode = world.episode();
  const EpisodeArrays arrays = core->arrays(episode, {{"agent_action", "skill"}});
  std::vector<AskedAction> own, of_policy;
  for (const AskedAction& one : arrays.agent_actions) (one.segment < 0 ? own : of_policy).push_back(one);
  REQUIRE(own.size() == 1 + static_cast<std::size_t>(parts));
  REQUIRE(of_policy.size() == 4);
  CHECK(own.front() == arrays.agent_actions.front());
  CHECK(own.front().end_frame == 5);
  const std::int64_t from = of_policy[2].first_frame, to = of_policy[2].end_frame;
  CHECK(of_policy[2].asked.space == "tool_path");
  CHECK((from < 5 && to > 5));  // it outlasts the call's first part
  CHECK(of_policy[3].first_frame == to);
  const auto ids = arrays.column("agent_action").integers();
  const auto skills = arrays.column("skill").integers();
  for (std::int64_t frame = from; frame < to; ++frame) {
    const auto at = static_cast<std::size_t>(frame);
    const AskedAction& acts = arrays.agent_actions.at(static_cast<std::size_t>(ids[at]));
    CHECK(acts == of_policy[2]);
    CHECK(acts.segment == skills[at]);
  }
  CHECK(arrays.agent_actions.at(static_cast<std::size_t>(ids[static_cast<std::size_t>(to + 1)])).segment == -1);
  CHECK(core->query("SELECT DISTINCT s.skill FROM agent_actions a JOIN segments s USING (episode, segment)")
            .text(0, "skill") == "reach");
}

TEST_CASE("what comes later in the order of priorities does not disturb what comes before") {
  Random random(RandomKey("priorities"));
  const auto drawn = [&](Eigen::Index rows) {
    Objective one{Eigen::MatrixXd(rows, 7), Eigen::VectorXd(rows)};
    for (double& value : one.jacobian.reshaped()) value = random.normal();
    for (double& value : one.rate) value = random.normal();
    return one;
  };
  for (int i = 0; i < 20; ++i) {
    const std::vector<Objective> all = {drawn(3), drawn(2), drawn(4)};
    const Eigen::VectorXd rate = by_priority(all, 7);
    CHECK((all[0].jacobian * rate - all[0].rate).norm() < 0.02 * (1 + all[0].rate.norm()));
    const Eigen::VectorXd first = by_priority({all[0]}, 7);
    CHECK((all[0].jacobian * (rate - first)).norm() < 1e-9);
  }
}

TEST_CASE("the tool stays while the elbow moves away") {
  const Folder folder;
  const auto core =
      session(folder, R"(policy("keep_tool", { with = { elbow = 0.3 }, until_effect = false, seconds = 6 }),)");
  const Episode episode = core->run("reach_target", {.seed = 4, .on_failure = OnFailure::stop});
  const auto& frames = episode.record->frames;
  const SegmentRecord& skill = skill_of(episode);
  const FrameRecord &first = frames.at(static_cast<std::size_t>(skill.span.first_frame)),
                    &last = frames.at(static_cast<std::size_t>(skill.span.end_frame) - 1);
  CHECK(last.joint_position[0] - first.joint_position[0] == Approx(0.3).margin(0.02));
  for (const FrameRecord& frame : frames) {
    for (std::size_t i = 0; i < 3; ++i)
      CHECK(std::abs(frame.hands[0].tip.position[i] - first.hands[0].tip.position[i]) < 3e-3);
    const Transform turned = to_transform(first.hands[0].tip).inverse() * to_transform(frame.hands[0].tip);
    CHECK(Eigen::AngleAxisd(turned.linear()).angle() < 0.02);
  }
}

}  // namespace stampede::program
