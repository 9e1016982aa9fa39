// Recordings from the command line: an episode leaves as one, comes back as one of a real robot, and is looked at.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

// A simulated episode with pictures as a recording folder.
std::string recorded(const Folder& folder) {
  const std::string demos = folder / "demos.db", lab = folder / "lab";
  REQUIRE(say({"run", "reach_target", "--images", "all", "--camera", "front", "--kinds", "rgb,depth", "--out", demos,
               "--root", kRoot})
              .code == kDone);
  REQUIRE(say({"export", "recording", demos, "--episode", "1", "--out", lab, "--root", kRoot}).code == kDone);
  return lab;
}

std::string asked(const std::string& catalogue, const std::string& sql) {
  return say({"query", catalogue, sql, "--format", "csv"}).out;
}

TEST_CASE("a recording is imported once, the same with any number of workers, and shown as what was recorded") {
  const Folder folder;
  const std::string lab = recorded(folder), real = folder / "real.db", other = folder / "other.db";
  const Said first = say({"import", "recording", lab, "--out", real, "--workers", "1", "--root", kRoot});
  INFO(first.err);
  REQUIRE(first.code == kDone);
  REQUIRE(say({"import", "recording", lab, "--out", real, "--root", kRoot}).code == kDone);
  CHECK(asked(real, "SELECT source, count(*) AS n FROM episodes GROUP BY source") == "source,n\nreal,1\n");
  CHECK(asked(real, "SELECT count(*) AS n FROM episodes WHERE seed IS NULL AND variation IS NULL AND draws IS NULL") ==
        "n\n1\n");
  CHECK(asked(real, "SELECT count(*) > 0 AS n FROM facts WHERE labelled_by = 'model'") == "n\n1\n");

  REQUIRE(say({"import", "recording", lab, "--out", other, "--workers", "2", "--root", kRoot}).code == kDone);
  CHECK(say({"query", real, "--hash"}).out == say({"query", other, "--hash"}).out);

  const Said sheet = say({"render", real, "--sheet", folder / "sheet.png"});
  INFO(sheet.err);
  CHECK(sheet.code == kDone);
  CHECK(says(sheet.out, "reach_target recorded:"));
  CHECK(says(say({"show", real, "1"}).out, "recorded"));
  const Said replay = say({"replay", real});
  CHECK(replay.code == kNo);
  CHECK(says(replay.out + replay.err, "recorded"));
}

TEST_CASE("an imported episode is exported and imported as the same recording") {
  const Folder folder;
  const std::string demos = folder / "demos.db", real = folder / "real.db";
  REQUIRE(say({"run", "pick_up_cup", "--images", "keyframes", "--size", "64x48", "--kinds", "rgb,depth", "--out", demos,
               "--root", kRoot})
              .code == kDone);
  std::string last = demos;
  for (const char* name : {"first", "second", "third"}) {
    REQUIRE(say({"export", "recording", last, "--episode", "1", "--out", folder / name, "--root", kRoot}).code ==
            kDone);
    const Said said = say({"import", "recording", folder / name, "--out", real, "--root", kRoot});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    last = real;
  }
  CHECK(asked(real, "SELECT count(*) AS n FROM episodes") == "n\n1\n");
  for (const char* file : {"recording.json", "cameras.json", "wrench.csv", "joints.csv"})
    CHECK(file_text(folder / "first/" + file) == file_text(folder / "second/" + file));
}

TEST_CASE("an export leaves a folder alone in which there is something") {
  const Folder folder;
  const std::string demos = folder / "demos.db", lab = folder / "lab";
  REQUIRE(say({"run", "reach_target", "--episodes", "2", "--out", demos, "--root", kRoot}).code == kDone);
  put(folder, "lab/joints.csv", "what the robot recorded");
  std::filesystem::create_directories(folder / "empty");
  for (const std::vector<std::string>& which : {std::vector<std::string>{"--episode", "1"}, {}}) {
    const auto exported = [&](const std::string& out) {
      std::vector<std::string> words = {"export", "recording", demos, "--out", out, "--root", kRoot};
      words.insert(words.end(), which.begin(), which.end());
      return say(words);
    };
    const Said said = exported(lab);
    CHECK(said.code == kBadInput);
    CHECK(says(said.err, "not empty"));
    CHECK(says(said.err, "name a new folder"));
    CHECK(exported(folder / "lab/joints.csv").code == kBadInput);
  }
  CHECK(file_text(folder / "lab/joints.csv") == "what the robot recorded");
  CHECK_FALSE(std::filesystem::exists(folder / "lab/recording.json"));
  CHECK(say({"export", "recording", demos, "--out", folder / "empty", "--root", kRoot}).code == kDone);
  CHECK(std::filesystem::exists(folder / "empty/episode_000002/recording.json"));
}

TEST_CASE("the model lies over the pictures of an episode that it made, to a third of a pixel") {
  const Folder folder;
  const std::string lab = recorded(folder), real = folder / "real.db";
  REQUIRE(say({"import", "recording", lab, "--out", real, "--root", kRoot}).code == kDone);
  const Said overlay = say({"render", real, "1", "--overlay", folder / "over", "--frames", "0,5", "--json"});
  INFO(overlay.err);
  REQUIRE(overlay.code == kDone);
  CHECK(std::filesystem::exists(folder / "over/episode_000001/front/000005.png"));
  const auto camera = nlohmann::json::parse(overlay.out)["episodes"][0]["cameras"][0];
  INFO(overlay.out);
  CHECK(camera["camera"] == "front");
  CHECK(camera["pictures"] == 2);
  CHECK(camera["median_px"] < 0.34);
}

TEST_CASE("frames and cameras that an episode does not have are named") {
  const Folder folder;
  const std::string lab = recorded(folder), real = folder / "real.db", demos = folder / "demos.db";
  REQUIRE(say({"import", "recording", lab, "--out", real, "--root", kRoot}).code == kDone);
  const auto overlay = [&](const std::string& option, const std::string& value) {
    return say({"render", real, "1", "--overlay", folder / "over", option, value});
  };
  const Said camera = overlay("--camera", "nose"), frame = overlay("--frames", "500");
  CHECK(camera.code == kNo);
  CHECK(says(camera.err, "no colour pictures of camera nose; known: front"));
  CHECK(frame.code == kNo);
  CHECK(says(frame.err, "episode 1 has no frame 500: its last is "));
  const auto drawn = [&](const std::string& frames) {
    return say({"render", demos, "1", "--out", folder / "drawn", "--size", "32x24", "--frames", frames});
  };
  const Said all = drawn("500,600-700"), one = drawn("2,500"), both = drawn("2-500");
  CHECK(all.code == kNo);
  CHECK(says(all.err, "has no frame 500, 600: its last is "));
  CHECK(one.code == kDone);
  CHECK(says(one.err, "has no frame 500"));
  CHECK(both.code == kDone);
  CHECK(both.err.empty());
}

TEST_CASE("an import that is asked for wrongly says how it is written, and leaves no catalogue behind") {
  const Folder folder;
  put(folder, "lab/recording.json", "{}");
  const std::string lab = folder / "lab", real = folder / "real.db";
  const auto refused = [&](const std::vector<std::string>& words, const std::string& cure) {
    std::vector<std::string> all = {"import"};
    all.insert(all.end(), words.begin(), words.end());
    all.insert(all.end(), {"--out", real, "--root", kRoot});
    const Said said = say(all);
    INFO(said.err);
    CHECK(said.code != kDone);
    CHECK(says(said.err, cure));
    CHECK_FALSE(std::filesystem::exists(real));
  };
  refused({"recordings", lab}, "did you mean 'recording'?");
  refused({lab}, "stampede import recording " + lab);
  refused({"recording", lab}, "\"stampede_recording\": 1");
}

TEST_CASE("labels by people take the place of those that came with a recording") {
  const Folder folder;
  const std::string lab = recorded(folder), real = folder / "real.db", labels = folder / "labels.json";
  REQUIRE(say({"import", "recording", lab, "--out", real, "--root", kRoot}).code == kDone);
  put(folder, "labels.json",
      R"({"labelled_by": "person", "segments": [{"kind": "skill", "name": "touch", "arguments": ["target"],
          "start_s": 0.1, "end_s": 0.5, "label": "touch the ball"}]})");
  const Said said = say({"import", "labels", labels, real, "--episode", "1", "--root", kRoot});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  CHECK(asked(real, "SELECT skill, labelled_by, label FROM segments WHERE kind = 'skill'") ==
        "skill,labelled_by,label\ntouch,person,touch the ball\n");
  put(folder, "empty.json", R"({"labelled_by": "person"})");
  const Said none = say({"import", "labels", folder / "empty.json", real, "--episode", "1", "--root", kRoot});
  CHECK(none.code == kBadInput);
  CHECK(says(none.err, "it holds no labels"));
  const Said bad = say({"import", "labels", labels, real, "--episode", "9", "--root", kRoot});
  CHECK(bad.code == kBadInput);
  CHECK(says(bad.err, "9"));
}

}  // namespace
}  // namespace stampede::program
