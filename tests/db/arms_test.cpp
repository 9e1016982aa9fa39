// Views of arms of any size: joints by what they are, whatever stands before and behind them.
#include <catch2/catch.hpp>

#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

// An arm with joints of the robot before it that nothing drives, as of a lift that is locked, with two fingers and a
// drawer. Each number differs from all others.
EpisodeRecord episode_of_arm(std::size_t arm, std::size_t before) {
  EpisodeRecord e = sample_episode("lift", "colour=red", 1);
  e.scene.joints.clear();
  const auto add = [&](const std::string& name, int body, bool slides, bool driven) {
    e.scene.joints.push_back({name, {body, 1}, slides ? "slider" : "hinge", slides ? "m" : "rad", -9, 9, driven});
  };
  for (std::size_t j = 1; j <= before; ++j) add("bot.lift" + std::to_string(j), -1, true, false);
  for (std::size_t j = arm; j > 0; --j)
    add("bot.axis" + std::to_string(j), -1, false, true);  // names that do not count
  for (const char* finger : {"bot.thumb", "bot.index"}) add(finger, -1, true, true);
  add("chest.drawer", 3, true, false);
  double number = 0;
  for (FrameRecord& frame : e.frames) {
    frame.joint_position.clear();
    for (std::size_t j = 0; j < e.scene.joints.size(); ++j) frame.joint_position.push_back(++number);
    frame.joint_velocity = frame.joint_effort = frame.joint_position;
    if (!frame.action) continue;
    frame.action->joint_position.clear();
    for (std::size_t j = 0; j < arm; ++j) frame.action->joint_position.push_back(++number);
    for (double& one : frame.action->tool_pose.position) one = ++number;
    frame.action->gripper = ++number;
  }
  return e;
}

}  // namespace

TEST_CASE("where nothing was commanded, an arm's joints are those driven that turn") {
  const Folder folder;
  EpisodeRecord e = episode_of_arm(4, 2);
  for (FrameRecord& frame : e.frames) frame.action.reset();
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  const std::int64_t id = catalogue.add(e, kEngine);
  const Rows joints = catalogue.query("SELECT joint FROM joints WHERE arm_joint AND frame = 0 ORDER BY arm_joint");
  const std::vector<std::string> arm = {"bot.axis4", "bot.axis3", "bot.axis2", "bot.axis1"};
  CHECK(catalogue.read_arrays(id, {.columns = {"joint_positions"}}).column("joint_positions").labels == arm);
  REQUIRE(joints.size() == arm.size());
  for (std::size_t j = 0; j < arm.size(); ++j) CHECK(joints.text(j, "joint") == arm[j]);
  const Rows steps = catalogue.query("SELECT * FROM steps WHERE frame = 3");
  CHECK(steps.real(0, "j1") == e.frames[3].joint_position[2]);
  CHECK(steps.real(0, "j4") == e.frames[3].joint_position[5]);
  CHECK(steps.is_null(0, "j5"));
  CHECK(steps.is_null(0, "action_j1"));
}

TEST_CASE("steps and joints tell of each arm what it has, and nothing else") {
  const Folder folder;
  for (const std::size_t before : {0, 3, 11})
    for (const std::size_t arm : {1, 4, 6, 7, 9, 16}) {
      INFO("an arm of " << arm << " behind " << before);
      const EpisodeRecord e = episode_of_arm(arm, before);
      Catalogue catalogue = Catalogue::write(folder / (std::to_string(before) + "_" + std::to_string(arm) + ".db"));
      catalogue.add(e, kEngine);
      const Rows steps = catalogue.query("SELECT * FROM steps ORDER BY frame");
      const Rows joints = catalogue.query("SELECT * FROM joints WHERE arm_joint ORDER BY frame, arm_joint");
      REQUIRE(steps.size() == e.frames.size());
      REQUIRE(joints.size() == arm * e.frames.size());
      for (std::size_t frame = 0; frame < steps.size(); ++frame) {
        const FrameRecord& truth = e.frames[frame];
        for (std::size_t j = 0; j < 7; ++j) {
          const std::string name = "j" + std::to_string(j + 1);
          REQUIRE(steps.is_null(frame, name) == (j >= arm));
          REQUIRE(steps.is_null(frame, "action_" + name) == (j >= arm || !truth.action));
          if (j < arm) REQUIRE(steps.real(frame, name) == truth.joint_position[before + j]);
          if (j < arm && truth.action) REQUIRE(steps.real(frame, "action_" + name) == truth.action->joint_position[j]);
        }
        for (std::size_t j = 0; j < arm; ++j) {
          REQUIRE(joints.integer(frame * arm + j, "arm_joint") == static_cast<std::int64_t>(j) + 1);
          REQUIRE(joints.text(frame * arm + j, "joint") == "bot.axis" + std::to_string(arm - j));
          REQUIRE(joints.real(frame * arm + j, "position") == truth.joint_position[before + j]);
        }
        REQUIRE(steps.is_null(frame, "action_x") == !truth.action.has_value());
        REQUIRE(steps.is_null(frame, "action_gripper") == !truth.action.has_value());
        if (!truth.action) continue;
        const auto& [position, quaternion] = truth.action->tool_pose;
        for (std::size_t i = 0; i < 3; ++i)
          REQUIRE(steps.real(frame, std::array{"action_x", "action_y", "action_z"}[i]) == position[i]);
        for (std::size_t i = 0; i < 4; ++i)
          REQUIRE(steps.real(frame, std::array{"action_qx", "action_qy", "action_qz", "action_qw"}[i]) ==
                  quaternion[i]);
        REQUIRE(steps.real(frame, "action_gripper") == truth.action->gripper);
      }
    }
}
