// Where recordings take place: our robots and worlds, and a robot that is not ours and comes as a URDF in the folder.
#include "scripting/commands/recording_stage.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>

#include "db/catalogue.h"
#include "db/recording/export_recording.h"
#include "db/stored_episode.h"
#include "tests/support/crane.h"
#include "tests/support/lab.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

const RecordingStager& our_stager() {
  static const RecordingStager stager = program::stager_of(Library::load({{STAMPEDE_SOURCE_DIR}}));
  return stager;
}

const char* const kRobot = R"({ "name": "crane", "urdf": "crane.urdf", "arm": ["turn", "shoulder", "elbow", "wrist"],
  "tip": { "link": "palm", "at": [0.08, 0, 0] }, "fingers": ["left_slide", "right_slide"], "opening": 0.06,
  "base": { "position": [0.1, 0.2, 0.3] } })";

std::array<double, 4> crane_at(double time) {
  return {0.8 * std::sin(time), -0.6 + 0.3 * std::cos(time), 0.5 + 0.3 * std::sin(2 * time), -time};
}

// The lab with that robot in place of the panda, for two seconds, with a camera on its palm.
void put_crane(const Lab& lab) {
  lab.write("crane.urdf", kCraneUrdf);
  std::string joints =
      "time_s,turn_position_rad,shoulder_position_rad,elbow_position_rad,wrist_position_rad,shoulder_effort_nm\n";
  for (int row = 0; row <= 200; ++row) {
    joints += std::to_string(100 + row * 0.01);
    for (const double value : crane_at(row * 0.01)) joints += "," + std::to_string(value);
    joints += ",35\n";
  }
  lab.write("joints.csv", joints);
  std::string gripper = "time_s,opening_m\n";
  for (int row = 0; row <= 100; ++row) gripper += std::to_string(100 + row * 0.02) + ",0.05\n";
  lab.write("gripper.csv", gripper);
  lab.replace("cameras.json", "robot.hand", "robot.palm");
  lab.change([](auto& json) { json["robot"] = nlohmann::json::parse(kRobot); });
}

void refused(const Lab& lab, const std::string& place, const std::string& complaint, const std::string& cure) {
  INFO(complaint);
  try {
    lab.import({}, our_stager());
    FAIL("it was taken");
  } catch (const Error& error) {
    CHECK_THAT(error.what(), Contains(place) && Contains(complaint));
    CHECK_THAT(error.hint(), Contains(cure));
  }
}

template <typename Change>
void refuse(const Change& change, const std::string& place, const std::string& complaint, const std::string& cure) {
  const Lab lab;
  put_crane(lab);
  change(lab);
  refused(lab, place, complaint, cure);
}

}  // namespace

TEST_CASE("a robot of one's own comes as a URDF, and its poses are those of its kinematics") {
  const Lab lab;
  put_crane(lab);
  lab.add_pictures("wrist", 10, 100, 5);
  Catalogue catalogue = Catalogue::write(lab.folder() / "a.db");
  const std::int64_t id = store_recording(lab.folder(), our_stager(), {}, catalogue, {"test", "test"}).id;
  const EpisodeRecord e = catalogue.read_episode(id);
  REQUIRE(e.frames.size() == 41);
  std::vector<std::string> names;
  for (const JointName& joint : e.scene.joints) names.push_back(joint.name);
  CHECK(names == std::vector<std::string>{"crane.turn", "crane.shoulder", "crane.elbow", "crane.wrist",
                                          "crane.left_slide", "crane.right_slide"});
  CHECK(e.scene.joints[4].unit == "m");
  for (std::size_t i = 0; i < e.frames.size(); ++i) {
    const FrameRecord& frame = e.frames[i];
    const auto [turn, shoulder, elbow, wrist] = crane_at(0.05 * static_cast<double>(i));
    const std::array<double, 6> wanted{turn, shoulder, elbow, wrist, 0.025, 0.025};
    for (std::size_t j = 0; j < wanted.size(); ++j) CHECK(frame.joint_position.at(j) == Approx(wanted[j]).margin(1e-5));
    CHECK(frame.joint_effort[1] == 35);
    CHECK(std::isnan(frame.joint_effort[0]));
    const Pose& tip = frame.hands.at(0).tip;
    double reach = 0, height = 0, bent = 0;
    for (const auto& [bend, length] : {std::pair(shoulder, 0.3), {elbow, 0.25}, {wrist, 0.08}}) {
      bent += bend;  // downwards
      reach += length * std::cos(bent), height -= length * std::sin(bent);
    }
    CHECK(tip.position[0] == Approx(0.1 + reach * std::cos(turn)).margin(1e-5));
    CHECK(tip.position[1] == Approx(0.2 + reach * std::sin(turn)).margin(1e-5));
    CHECK(tip.position[2] == Approx(0.3 + 0.4 + height).margin(1e-5));
    CHECK(std::abs(tip.quaternion[3]) == Approx(std::abs(std::cos(turn / 2) * std::cos(bent / 2))).margin(1e-5));
    CHECK(frame.hands[0].opening == Approx(0.05));
  }
  const Rows steps = catalogue.query("SELECT * FROM steps WHERE frame = 17");
  CHECK(steps.real(0, "j4") == e.frames[17].joint_position[3]);
  CHECK(steps.is_null(0, "j5"));  // a finger is no joint of the arm
  CHECK(steps.real(0, "action_x") == e.frames[17].action->tool_pose.position[0]);
  const StoredEpisode stored = read_stored(catalogue, id);
  REQUIRE(stored.scene);  // whole: without the folder
  CHECK(stored.scene->robot.body.parts.size() == 7);
  export_recording(catalogue, stored, lab.folder() / "again");
  CHECK_THROWS_WITH(record_of(lab.folder() / "again", our_stager(), {}), Contains("there is no robot 'crane'"));
  lab.write("again/crane.urdf", kCraneUrdf);
  nlohmann::json json = nlohmann::json::parse(lab.read("again/recording.json"));
  json["robot"] = nlohmann::json::parse(kRobot);
  lab.write("again/recording.json", json.dump());
  const EpisodeRecord back = record_of(lab.folder() / "again", our_stager(), {});
  CHECK(back.frames.at(17).joint_position == e.frames.at(17).joint_position);
  CHECK(back.frames[17].hands[0].tip == e.frames[17].hands[0].tip);
}

TEST_CASE("a URDF that is another robot's than the recording is refused, with what is there") {
  refuse([](const Lab& lab) { lab.replace("joints.csv", "elbow_position_rad", "joint3_position_rad"); }, "joints.csv:1",
         "no column 'joint3_position_rad'", "");
  refuse([](const Lab& lab) { lab.replace("joints.csv", "shoulder_position_rad", "shoulder_position_m"); },
         "joints.csv:1", "no column 'shoulder_position_m'", "did you mean 'shoulder_position_rad'?");
  refuse(
      [](const Lab& lab) {
        lab.replace("crane.urdf", "\"shoulder\" type=\"revolute\"", "\"shoulder\" type=\"prismatic\"");
        lab.replace("joints.csv", "shoulder_position_rad", "shoulder_position_m");
        lab.replace("joints.csv", "shoulder_effort_nm", "shoulder_effort_n");
      },
      "crane", "joint 'shoulder' of the arm is not a hinge", "only turning joints");
  refuse([](const Lab& lab) { lab.replace("crane.urdf", "joint name=\"wrist\"", "joint name=\"roll\""); },
         "recording.json", "wrist", "");
  refuse([](const Lab& lab) { lab.change([](auto& json) {
                                json["robot"]["arm"] = {"turn", "shoulder", "elbow"};
                              }); },
         "joints.csv:1", "no column 'wrist_position_rad'", "");
  refuse([](const Lab& lab) { lab.change([](auto& json) { json["robot"]["tip"]["link"] = "hand"; }); },
         "recording.json", "hand", "");
  refuse([](const Lab& lab) { lab.replace("crane.urdf", "lower=\"-1.8\"", "lower=\"-0.1\""); }, "joints.csv:2",
         "another robot", "");
  refuse([](const Lab& lab) { lab.replace("crane.urdf", "</robot>", ""); }, "crane.urdf", "", "");
  refuse([](const Lab& lab) { lab.change([](auto& json) { json["robot"]["urdf"] = "other.urdf"; }); }, "recording.json",
         "other.urdf", "");
}

TEST_CASE("a recording takes place with our robot, among a world's fixtures, and the files that say so are stored") {
  const Lab lab;
  const EpisodeRecord alone = lab.import({}, our_stager());
  CHECK(alone.world == "none");
  CHECK(alone.scene.objects.size() == 1);  // the hand
  REQUIRE(alone.made.definitions.size() == 1);
  CHECK(alone.made.definitions[0].path == "worlds/robots/panda.lua");
  const EpisodeRecord bare = lab.import();  // the same robot, made without Lua: other files, the same numbers
  CHECK(bare.made.key != alone.made.key);
  CHECK(bare.frames.at(7).hands.at(0).tip == alone.frames.at(7).hands.at(0).tip);
  lab.change([](auto& json) { json["world"] = "tabletop"; });
  const EpisodeRecord there = lab.import({}, our_stager());
  CHECK(there.world == "tabletop");
  CHECK(std::any_of(there.scene.objects.begin(), there.scene.objects.end(),
                    [](const Object& object) { return object.name == "table"; }));
  CHECK(std::any_of(there.made.definitions.begin(), there.made.definitions.end(),
                    [](const DefinitionRecord& file) { return file.kind == "world" && file.name == "tabletop"; }));
}

TEST_CASE("a robot or world that there is not is refused, with what is probably meant") {
  const Lab lab;
  lab.change([](auto& json) { json["robot"]["name"] = "pandas"; });
  refused(lab, "recording.json", "there is no robot 'pandas'", "did you mean 'panda'?");
  lab.change([](auto& json) { json["robot"]["name"] = "my_lab_robot"; });
  refused(lab, "recording.json", "no robot 'my_lab_robot'", "`robot.urdf`");
  lab.change([](auto& json) { json["robot"]["name"] = "panda", json["world"] = "kitchen9"; });
  refused(lab, "recording.json", "there is no world 'kitchen9'", "");
}
