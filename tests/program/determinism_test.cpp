#include <catch2/catch.hpp>
#include <cstdlib>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::vector<std::string> run_words(const std::string& out, std::vector<std::string> more,
                                   const std::string& task = "reach_target") {
  std::vector<std::string> words = {"run", task, "--root", kRoot, "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

std::string hash_of(const std::string& path) { return Catalogue::open(path).content_hash(); }

}  // namespace

TEST_CASE("two workers write what one writes, a second run adds nothing, replay needs no scripts") {
  const Folder folder;
  REQUIRE(say(run_words(folder / "one.db", {"--episodes", "4"})).code == kDone);
  REQUIRE(say(run_words(folder / "two.db", {"--episodes", "4", "--workers", "2"})).code == kDone);
  const std::string hash = hash_of(folder / "one.db");
  CHECK(hash == hash_of(folder / "two.db"));

  const Said again = say(run_words(folder / "one.db", {"--episodes", "4"}));
  CHECK(again.code == kDone);
  CHECK(again.out.find("4 were there already") != std::string::npos);
  CHECK(hash == hash_of(folder / "one.db"));

  // Half now and half later is the same as all at once.
  REQUIRE(say(run_words(folder / "late.db", {"--episodes", "2"})).code == kDone);
  REQUIRE(say(run_words(folder / "late.db", {"--episodes", "4"})).code == kDone);
  CHECK(hash == hash_of(folder / "late.db"));

  const Folder empty;
  const Said replayed = say({"replay", folder / "one.db", "--root", empty.text()});
  CHECK(replayed.code == kDone);
  CHECK(replayed.out.find("4 replayed bit for bit, 0 different") != std::string::npos);

  const Said shown = say({"show", folder / "one.db", "1"});
  CHECK(shown.code == kDone);
  CHECK(shown.out.find("reach_target") != std::string::npos);

  const Said counted = say({"query", folder / "one.db", "SELECT count(*) AS n FROM episodes", "--format", "csv"});
  CHECK(counted.out == "n\n4\n");
  CHECK(say({"query", folder / "one.db", "DELETE FROM episode"}).code == kBadInput);
}

TEST_CASE("a planner of OMPL plans the same in any number of workers, and other ways than ours") {
  const Folder folder;
  const auto run = [&](const std::string& file, std::vector<std::string> more) {
    more.insert(more.end(), {"--episodes", "2"});
    REQUIRE(say(run_words(folder / file, more, "basketball_in_hoop")).code == kDone);
    return say({"query", folder / file, "SELECT sum(action_j1) FROM steps GROUP BY episode", "--format", "csv"}).out;
  };
  const std::string ours = run("own.db", {}), theirs = run("one.db", {"--motion-planner", "ompl:PRM"});
  CHECK(run("two.db", {"--motion-planner", "ompl:PRM", "--workers", "2"}) == theirs);
  CHECK(hash_of(folder / "one.db") == hash_of(folder / "two.db"));
  CHECK(ours != theirs);
  CHECK(say({"replay", folder / "one.db"}).out.find("2 replayed bit for bit, 0 different") != std::string::npos);
  const Said told =
      say({"query", folder / "one.db", "SELECT options LIKE '%ompl:PRM%' AS told FROM episodes", "--format", "csv"});
  CHECK(told.out == "told\n1\n1\n");
  const Said wrong = say(run_words(folder / "no.db", {"--motion-planner", "RRTConnect"}));
  CHECK(wrong.code == kBadInput);
  CHECK(wrong.err.find("did you mean 'ompl:RRTConnect'?") != std::string::npos);
}

TEST_CASE("processors with AVX2 and without write the same catalogue, pictures included") {
  const Folder folder;
  const std::vector<std::string> more = {"--episodes", "1", "--images", "keyframes", "--shadows"};
  REQUIRE(say(run_words(folder / "wide.db", more)).code == kDone);
  ::setenv("STAMPEDE_NO_AVX2", "1", 1);
  const int code = say(run_words(folder / "plain.db", more)).code;
  ::unsetenv("STAMPEDE_NO_AVX2");
  REQUIRE(code == kDone);
  CHECK(hash_of(folder / "wide.db") == hash_of(folder / "plain.db"));
}

TEST_CASE("the shards of a run, merged or in one file, are the undivided run") {
  const Folder folder;
  REQUIRE(say(run_words(folder / "whole.db", {"--episodes", "5"})).code == kDone);
  for (const std::string part : {"2/3", "1/3", "3/3"}) {
    const std::string own = folder / (part.substr(0, 1) + ".db");
    const Said ran = say(run_words(own, {"--episodes", "5", "--shard", part}));
    REQUIRE(ran.code == kDone);
    CHECK(says(ran.out, part == "3/3" ? "1 episodes" : "2 episodes"));
    REQUIRE(say(run_words(folder / "one.db", {"--episodes", "5", "--shard", part})).code == kDone);
  }
  REQUIRE(say({"merge", folder / "merged.db", folder / "1.db", folder / "2.db", folder / "3.db"}).code == kDone);
  CHECK(hash_of(folder / "merged.db") == hash_of(folder / "whole.db"));
  CHECK(hash_of(folder / "one.db") == hash_of(folder / "whole.db"));
  CHECK(hash_of(folder / "1.db") != hash_of(folder / "whole.db"));
  // What is there is not run again; a part without episodes is no failure.
  CHECK(says(say(run_words(folder / "1.db", {"--episodes", "5", "--shard", "1/3"})).out, "2 were there already"));
  CHECK(say(run_words(folder / "none.db", {"--episodes", "1", "--shard", "2/2"})).code == kDone);
}

// All ways in which an episode comes about.
struct KnownRun {
  const char* hash;  // of its catalogue
  std::vector<std::string> words;
};

const std::vector<KnownRun>& known_runs() {
  static const std::vector<KnownRun> runs = {
      {"f230bdb62862f16406c2d5816e14c08c", {"reach_target", "pick_and_lift", "stack_blocks", "push_buttons"}},
      {"4efed68692b5fc22ae79823cb4942397", {"put_item_in_drawer", "close_drawer", "open_jar", "turn_tap"}},
      {"59c2a6f045bfe692d712c680a791461d", {"find_item_in_drawer", "--seed", "3"}},
      {"c57458f5662163edd3efc73340fb8d0d", {"basketball_in_hoop", "put_groceries_in_cupboard", "--seed", "1"}},
      {"a7200403b78460f5f01cc2db61135b5f", {"sort_blocks", "stack_cups", "--seed", "2"}},
      {"76b3645a77df9cc8f55a16e56a1d11bf", {"open_washing_machine", "open_microwave", "--seed", "1"}},
      {"3e401cf6cfe2c5e81a356df8e5e2fb57",
       {"insert_usb_in_computer", "hang_frame_on_hanger", "reach_and_drag", "slide_block_to_target"}},
      {"084cd2cd275a31c04fe0ea4386480925",
       {"stack_blocks", "put_item_in_drawer", "--behaviour", "random_skills", "--skills", "8"}},
      {"f3369bf3cb22ebdbd74d8b0fa8c3d79a",
       {"stack_blocks", "close_box", "--behaviour", "random_applicable", "--skills", "8", "--on-failure", "recover"}},
      {"dafbb4aa1863d9343ab9f06ea852554a",
       {"stack_blocks", "put_shoes_in_box", "--on-failure", "recover", "--seed", "5"}},
      {"37a37132aeffff251b62670c7951f9d2", {"pick_and_lift", "--set", "pick.controller=cartesian_impedance"}},
      {"9bc40c71165f8f7573a6c22ead51f499", {"pick_and_lift", "--controller", "joint_impedance", "--randomise"}},
      {"57499b3fee9af0089b60634ff41486a1", {"put_item_in_drawer", "--set", "motion.stop_at_vias=1"}},
      {"0f117f74cdecd0ae7c48ad35af6ee00b",
       {"put_item_in_drawer", "--where", "(open chest.top_drawer)", "--goal", "(closed chest.top_drawer)"}},
      {"b6812619901a208e06c007653ac8e5d8",
       {"pick_and_lift", "--seed", "4", "--images", "keyframes", "--camera", "front", "--camera", "wrist", "--size",
        "48x48", "--noise", "rgb=0.02,depth=kinect"}},
      {"4bd479143b011c3b6c398f450271bffb", {"reach_target", "--seed", "4", "--channels", "all,margins"}},
      {"6f8e4733b2e5228c83a15123065b5fbd",
       {"stack_blocks", "--policy", "sh wander.sh", "--observe", "joint_positions,object_pose,fact_names", "--reward",
        "dense"}},
  };
  return runs;
}

// Data that this engine made are made again by the next, bit for bit, or a change says that they are not: then the new
// hashes are put here.
TEST_CASE("runs of every kind make the bytes that they are known by") {
  const Folder folder;
  const std::filesystem::path here = std::filesystem::current_path();
  std::filesystem::current_path(STAMPEDE_SOURCE_DIR "/tests/program");  // the command of the policy is of the data
  for (const KnownRun& run : known_runs()) {
    const std::string file = folder / (std::string(run.hash) + ".db");
    std::vector<std::string> words = {"run", "--root", kRoot, "--out", file};
    words.insert(words.end(), run.words.begin(), run.words.end());
    const Said said = say(words);
    INFO(run.words.front() << " " << run.words.back() << "\n" << said.err);
    CHECK((said.code == kDone || said.code == kNo));
    CHECK(hash_of(file) == run.hash);
  }
  std::filesystem::current_path(here);
}

TEST_CASE("the first episode of every task is what all of them are known by") {
  const Folder folder;
  std::vector<std::string> words = {"run", "--root", kRoot, "--out", folder / "all.db", "--seed", "11"};
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::path(kRoot) / "tasks"))
    if (entry.path().extension() == ".lua") words.push_back(entry.path().stem());
  CHECK(say(words).code == kDone);
  CHECK(hash_of(folder / "all.db") == "3192b67d69baa1ee62be3c35b044c93f");
}

}  // namespace stampede::program
