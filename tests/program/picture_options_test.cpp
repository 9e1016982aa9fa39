// What people get wrong about pictures: told before anything runs or is drawn.
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {}  // namespace

TEST_CASE("options about pictures that make no sense are usage errors with a cure, and nothing is written") {
  struct Case {
    std::vector<std::string> words;
    std::string complaint, cure;
  };
  const std::vector<Case> cases = {
      {{"--camera", "frnt"}, "there is no camera 'frnt'", "did you mean 'front'?"},
      {{"--camera", "front", "--camera", "wirst"}, "there is no camera 'wirst'", "did you mean 'wrist'?"},
      {{"--size", "0x64"}, "1 to 4096 pixels", ""},
      {{"--size", "64x5000"}, "1 to 4096 pixels a side, not 5000", ""},
      {{"--size", "99999999999x2"}, "1 to 4096 pixels", ""},
      {{"--size", "64"}, "takes WIDTHxHEIGHT", "128x128"},
      {{"--size", "-3x64"}, "pixels a side, not -3", ""},
      {{"--kinds", "rgb,dpeth"}, "no kind of picture 'dpeth'", "did you mean 'depth'? the kinds are rgb, depth"},
      {{"--kinds", ""}, "no kind of picture ''", "the kinds are"},
      {{"--noise", "rgb"}, "takes NAME=NUMBER", "rgb=0.02"},
      {{"--noise", "rgb=much"}, "takes a number, not 'much'", ""},
      {{"--noise", "rgb=-1"}, "lies within 0 and 1", ""},
      {{"--noise", "smell=1"}, "no noise of 'smell'", "rgb=0.02"},
      {{"--noise", "rgb=nan"}, "takes a number, not 'nan'", ""},
      {{"--add-camera", "at:1,0,1"}, "takes NAME=", "look:"},
      {{"--add-camera", "Cam=at:1,0,1;look:0,0,0"}, "'Cam' cannot be a name", "small letters"},
      {{"--add-camera", "cam=at:1,0,1"}, "'look' is missing", "look:"},
      {{"--add-camera", "cam=at:1,0;look:0,0,0"}, "at takes x,y,z", ""},
      {{"--add-camera", "cam=at:1,0,1;look:1,0,1"}, "cannot look at where it stands", ""},
      {{"--add-camera", "cam=at:1,0,1;look:0,0,1;lok:2"}, "a camera has no 'lok:2'", "look"},
      {{"--add-camera", "cam=at:1,0,1;look:0,0,1;mount:panda.hnd"}, "no 'panda.hnd'", "did you mean 'panda.hand'?"},
      {{"--add-camera", "cam=at:1,0,1;look:0,0,1;fov:180"}, "fov lies within 1 and 170", ""},
      {{"--add-camera", "cam=at:1,0,1;look:0,0,1;size:0x3"}, "1 to 4096", ""},
      {{"--add-camera", "cam=at:1,0,1;look:0,0,1;near:2;far:1"}, "near must be less than far", ""},
  };
  const Folder folder;
  REQUIRE(say({"run", "reach_target", "--root", kRoot, "--out", folder / "d.db"}).code == kDone);
  for (const Case& one : cases)
    for (const bool run : {true, false}) {
      std::vector<std::string> words =
          run ? std::vector<std::string>{"run", "reach_target", "--images", "all", "--out", folder / "new.db"}
              : std::vector<std::string>{"render", folder / "d.db", "--out", folder / "pictures"};
      words.insert(words.end(), {"--root", kRoot});
      words.insert(words.end(), one.words.begin(), one.words.end());
      const Said said = say(words);
      INFO(words[0] + " " + one.words.back() + " -> " + said.err);
      CHECK(said.code == kUsage);
      CHECK(said.out.empty());
      CHECK(says(said.err, one.complaint));
      CHECK(says(said.err, one.cure));
      CHECK_FALSE(std::filesystem::exists(folder / "new.db"));
      CHECK_FALSE(std::filesystem::exists(folder / "pictures"));
    }
}

TEST_CASE("a sensor that the world does not have is told before anything runs") {
  const Folder folder;
  const Said said = say({"run", "reach_target", "--root", kRoot, "--out", folder / "o.db", "--channels", "wrnch"});
  CHECK(said.code == kUsage);
  CHECK(says(said.err, "no sensor 'wrnch'"));
  CHECK_FALSE(std::filesystem::exists(folder / "o.db"));
}

TEST_CASE("render says what it needs") {
  const Folder folder;
  REQUIRE(say({"run", "reach_target", "--root", kRoot, "--out", folder / "d.db"}).code == kDone);
  const std::string d = folder / "d.db";
  struct Case {
    std::vector<std::string> words;
    ExitCode code;
    std::string complaint;
  };
  for (const Case& one : std::vector<Case>{
           {{d}, kUsage, "say --out FOLDER, --into FILE, --video FILE, --sheet FILE or --overlay FOLDER"},
           {{d, "--out", folder / "x", "--into", d}, kUsage, "--out and --into at once"},
           {{d, "--video", folder / "x.avi"}, kUsage, "say .mp4"},
           {{d, "--video", folder / "x.mp4", "--kinds", "depth"}, kUsage, "films and sheets are for people"},
           {{d, "--sheet", folder / "x.png", "--frames", "1"}, kUsage, "it shows the start, each skill and the end"},
           {{d, "--out", folder / "x", "--frames", "some"}, kUsage, "--frames takes all, keyframes"},
           {{d, "--out", folder / "x", "--frames", "5-3"}, kUsage, "ends before it starts"},
           {{d, "first", "--out", folder / "x"}, kUsage, "an episode is a number"},
           {{d, "77", "--out", folder / "x"}, kBadInput, "77"},
           {{folder / "no.db", "--out", folder / "x"}, kCatalogue, "no.db"},
           {{d, "--into", folder / "no.db"}, kCatalogue, "no.db"},
           {{d, "--into", d, "--renderer", "osmesa"}, kUsage, "drawn again bit for bit"},
           {{d, "--out", folder / "x", "--renderer", "mesa"}, kUsage, "own, osmesa"},
           {{d, "--sheet", folder / "no/where.png"}, kBadInput, "where.png"},
           {{d, "--noise", "torque=1", "--out", folder / "x"}, kUsage, "no noise of 'torque' here"}}) {
    std::vector<std::string> words = one.words;
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--root", kRoot});
    const Said said = say(words);
    INFO(one.words.back() + " -> " + said.err);
    CHECK(said.code == one.code);
    CHECK(says(said.err, one.complaint));
    CHECK_FALSE(std::filesystem::exists(folder / "x"));
  }
}

TEST_CASE("a calibration file of the wrong shape is bad input with its place, before anything runs") {
  const Folder folder;
  const std::string good =
      R"({"cameras": [{"name": "front", "width": 64, "height": 48, "camera_matrix": [[60, 0, 32], [0, 60, 24], [0, 0, 1]],
          "mount": "world", "mount_from_camera": [[0,0,-1,1.3],[1,0,0,0],[0,-1,0,1.2],[0,0,0,1]], "near": 0.01, "far": 4}]})";
  const auto replaced = [&](const std::string& a, const std::string& b) {
    std::string text = good;
    return text.replace(text.find(a), a.size(), b);
  };
  const auto run_with = [&](const std::string& text) {
    std::ofstream(folder / "c.json") << text;
    return say({"run", "reach_target", "--root", kRoot, "--out", folder / "o.db", "--images", "keyframes", "--camera",
                "front", "--camera-file", folder / "c.json"});
  };
  for (const std::string& bad :
       {replaced("[0, 0, 1]]", "[0, 0]]"), replaced("60, 0, 32", "-60, 0, 32"), replaced("0,-1,0,1.2", "0,-2,0,1.2"),
        replaced("\"world\"", "\"panda.elbow\""), std::string("{"), std::string("[]")}) {
    const Said said = run_with(bad);
    INFO(bad + "\n" + said.err);
    CHECK(said.code == kBadInput);
    CHECK(says(said.err, "c.json"));
    CHECK_FALSE(std::filesystem::exists(folder / "o.db"));
  }
  const Said said = run_with(good);
  INFO(said.err);
  CHECK(said.code == kDone);
  CHECK(Catalogue::open(folder / "o.db").images(1).front().width == 64);
}

TEST_CASE("a missing texture is a complaint with the file, by check and by run") {
  const Folder mine;
  std::filesystem::create_directories(mine / "worlds/objects");
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "worlds/objects/mug.lua")
      << "-- A mug.\nreturn object { type = \"thing\", traits = { \"movable\" }, mass = 0.1, shape = box { 0.04, 0.04, "
         "0.04, texture = \"nowhere.png\" } }\n";
  std::ofstream(mine / "tasks/t.lua") << "-- Take it.\nreturn task {\n  world = \"tabletop\",\n  objects = { mug = { "
                                         "\"mug\" } },\n  init = { is.on('mug', 'table') },\n  goal = { "
                                         "is.holding('mug') },\n  instructions = { \"take it\" },\n}\n";
  const Said check = say({"check", "--root", kRoot, "--path", mine.text()});
  const Said run = say({"run", "t", "--root", kRoot, "--path", mine.text(), "--out", mine / "o.db", "--images", "all"});
  INFO(check.out + run.err);
  CHECK(check.code == kBadInput);
  CHECK(run.code == kBadInput);
  CHECK(says(check.out, "nowhere.png"));
  CHECK(says(run.err, "nowhere.png"));
}

TEST_CASE("a full disk while rendering into a catalogue: exit 4, the episode as it was, and it works again later") {
  const Folder folder;
  const std::string file = folder / "d.db";
  REQUIRE(say({"run", "reach_target", "--root", kRoot, "--out", file}).code == kDone);
  const std::string hash = Catalogue::open(file).content_hash();
  const auto size = std::filesystem::file_size(file);
  const pid_t child = fork();
  if (child == 0) {
    const rlimit limit{size + 100'000, size + 100'000};  // no file may grow beyond
    setrlimit(RLIMIT_FSIZE, &limit);
    if (!std::freopen((folder / "story.txt").c_str(), "w", stderr) || !std::freopen("/dev/null", "w", stdout))
      _exit(126);
    execl(STAMPEDE_PROGRAM, "stampede", "render", file.c_str(), "--into", file.c_str(), "--size", "256x256", "--root",
          kRoot, nullptr);
    _exit(127);
  }
  int status = 0;
  waitpid(child, &status, 0);
  INFO(file_text(folder / "story.txt"));
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == kCatalogue);
  CHECK(says(file_text(folder / "story.txt"), "space"));
  CHECK(Catalogue::open(file).images(1).empty());
  CHECK(Catalogue::open(file).content_hash() == hash);
  CHECK(say({"render", file, "--into", file, "--root", kRoot}).code == kDone);
}

}  // namespace stampede::program
