#include "engine/record/arrays.h"

#include <sqlite3.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <iterator>

#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

bool equal(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }  // SQLite keeps one zero
template <typename Whole>
bool equal(Whole a, Whole b) {
  return a == b;
}

bool same(const ArrayColumn& a, const ArrayColumn& b) {
  if (a.name != b.name || a.shape != b.shape || a.unit != b.unit || a.frame != b.frame || a.rate_hz != b.rate_hz ||
      a.labels != b.labels || a.data.index() != b.data.index())
    return false;
  return std::visit(
      [&](const auto& values) {
        const auto& others = std::get<std::decay_t<decltype(values)>>(b.data);
        return std::equal(values.begin(), values.end(), others.begin(), others.end(),
                          [](auto x, auto y) { return equal(x, y); });
      },
      a.data);
}

void check_same(const EpisodeArrays& a, const EpisodeArrays& b) {
  CHECK(std::tie(a.task, a.variation, a.seed, a.frames, a.frame_hz) ==
        std::tie(b.task, b.variation, b.seed, b.frames, b.frame_hz));
  REQUIRE(a.columns.size() == b.columns.size());
  for (std::size_t i = 0; i < a.columns.size(); ++i) {
    INFO(a.columns[i].name);
    CHECK(same(a.columns[i], b.columns[i]));
  }
  REQUIRE(a.atoms.size() == b.atoms.size());
  REQUIRE(a.segments.size() == b.segments.size());
  for (std::size_t i = 0; i < a.segments.size(); ++i)
    CHECK(std::tie(a.segments[i].id, a.segments[i].name, a.segments[i].arguments, a.segments[i].label) ==
          std::tie(b.segments[i].id, b.segments[i].name, b.segments[i].arguments, b.segments[i].label));
  CHECK(a.agent_actions == b.agent_actions);
  REQUIRE(a.pictures.size() == b.pictures.size());
  for (std::size_t i = 0; i < a.pictures.size(); ++i) CHECK(a.pictures[i].stored == b.pictures[i].stored);
}

}  // namespace

TEST_CASE("arrays of a catalogue are those of the episode in memory, to the last bit") {
  const Folder folder;
  EpisodeRecord episode = sample_episode("lift", "colour=red", 7);
  episode.images = sample_images(episode, {0, 4});
  for (FrameRecord& frame : episode.frames)  // the robot's second joint is a finger: nothing commands it
    if (frame.action) frame.action->joint_position.resize(1);
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(episode, kEngine);
  const EpisodeArrays whole = catalogue.read_arrays(1);
  check_same(whole, episode_arrays(episode));
  CHECK(whole.columns.size() > 30);
  CHECK(whole.column("sensor/wrench").shape == std::vector<std::int64_t>{2, 2});
  CHECK(whole.column("sensor/wrench").rate_hz == 120);
  CHECK(whole.pictures.at(0).name == "front_rgb");
  CHECK(whole.pictures.at(0).stored == std::vector<std::int64_t>{0, 4});
  for (const ArrayRequest& request :
       {ArrayRequest{{"joint_positions"}}, ArrayRequest{{"object_pose", "skill"}}, ArrayRequest{{"action", "facts"}},
        ArrayRequest{{"wrist_camera_extrinsics", "front_depth"}}, ArrayRequest{{"gripper_open", "gripper_pose"}},
        ArrayRequest{{"agent_action"}}, ArrayRequest{{"agent_reward", "agent_action/tool_path"}}})
    check_same(catalogue.read_arrays(1, request), episode_arrays(episode, request));
  CHECK_THROWS_WITH(catalogue.read_arrays(2), Catch::Contains("there is no episode 2"));
}

TEST_CASE("the README describes the columns of sensors and cameras") {
  std::ifstream file(std::string(STAMPEDE_SOURCE_DIR) + "/engine/record/README.md");
  const std::string readme{std::istreambuf_iterator<char>(file), {}};
  const auto described = [&](std::string name) {
    for (const char* camera : {"front", "wrist"})
      if (name.starts_with(std::string(camera) + "_")) name = "CAMERA" + name.substr(5);
    if (name.starts_with("sensor")) name = name.substr(0, name.find('/')) + "/NAME";
    if (name.starts_with("agent_action/") && name != "agent_action/gripper") name = "agent_action/SPACE";
    if (name.starts_with("object_pose")) return;
    INFO(name);
    CHECK(readme.find("`" + name + "`") != std::string::npos);
  };
  const EpisodeArrays arrays = episode_arrays(sample_episode("lift", "colour=red", 7));
  for (const ArrayColumn& column : arrays.columns) described(column.name);
  REQUIRE(arrays.pictures.size() == 8);
  for (const ArrayPictures& pictures : arrays.pictures) described(pictures.name);
}

TEST_CASE("arrays of a damaged catalogue are an error, not a crash") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  catalogue.add(sample_episode("lift", "colour=red", 7), kEngine);
  catalogue.close();
  sqlite3* handle = nullptr;
  REQUIRE(sqlite3_open((folder / "a.db").c_str(), &handle) == SQLITE_OK);
  CHECK(sqlite3_exec(handle, "UPDATE joint_state SET frame = 900 WHERE frame = 3", nullptr, nullptr, nullptr) ==
        SQLITE_OK);
  sqlite3_close(handle);
  CHECK_THROWS_WITH(Catalogue::open(folder / "a.db").read_arrays(1), Catch::Contains("joint_state"));
}
