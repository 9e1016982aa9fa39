// `lock`, `make`, `verify`: the same catalogue anywhere, and what is told where it is not.
#include "scripting/session/lock.h"

#include <catch2/catch.hpp>

#include "db/catalogue.h"
#include "db/sqlite.h"
#include "say.h"

namespace stampede::program {
namespace {

struct Shelf {
  Folder folder;
  std::string demos = folder / "demos.db", lock = folder / "demos.lock", again = folder / "again.db";

  Said run(std::vector<std::string> words) const {
    words.insert(words.begin(), "run");
    words.insert(words.end(), {"--root", kRoot, "--out", demos, "--workers", "1"});
    return say(words);
  }
  void write_lock() const {
    const Said said = say({"lock", demos});
    REQUIRE(said.err.empty());
    REQUIRE(said.code == kDone);
    put(folder, "demos.lock", said.out);
  }
  Said make(std::vector<std::string> words = {}) const {
    words.insert(words.begin(), {"make", lock, "--root", kRoot});
    if (std::ranges::find(words, "--out") == words.end()) words.insert(words.end(), {"--out", again});
    return say(words);
  }
  Said verify(const std::string& file) const { return say({"verify", lock, file}); }
  // The lock with one text instead of another.
  void change_lock(const std::string& from, const std::string& to) const {
    std::string text = file_text(lock);
    const std::size_t at = text.find(from);
    REQUIRE(at != std::string::npos);
    put(folder, "demos.lock", text.replace(at, from.size(), to));
  }
};

std::string hash_of(const std::string& file) { return Catalogue::open(file).content_hash(); }

// As another program could.
void change(const std::string& file, const std::string& statement) {
  sql::Database database(file, SQLITE_OPEN_READWRITE, file);
  database.run(statement);
}

}  // namespace

TEST_CASE("what a lock names is made again bit for bit, whatever the runs were asked for") {
  const Shelf shelf;
  const std::vector<std::vector<std::string>> runs = {
      {"reach_target", "pick_and_lift", "--episodes", "5"},
      {"pick_and_lift", "--set", "pick.height=0.1", "--set", "motion.stop_at_vias=1", "--seed", "40"},
      {"put_item_in_drawer", "--where", "(open chest.top_drawer)", "--goal", "(closed chest.top_drawer)"},
      {"reach_target", "--images", "keyframes", "--size", "16x16", "--kinds", "rgb,depth", "--noise", "rgb=0.02"},
      {"reach_target", "--behaviour", "random_applicable", "--skills", "2", "--on-failure", "recover", "--split",
       "test"},
      {"reach_target", "--randomise", "--channels", "all,margins", "--noise", "torque=0.1"},
      {"reach_target", "--motion-planner", "ompl:RRTConnect", "--controller", "joint_impedance", "--seed", "7"}};
  for (const auto& words : runs) REQUIRE(shelf.run(words).code != kUsage);
  shelf.write_lock();
  CHECK(lock_from_file(shelf.lock).episodes() == 16);
  const Said made = shelf.make();
  CHECK(made.code == kDone);
  CHECK(says(made.out, "as locked: 16 episodes"));
  CHECK(hash_of(shelf.again) == hash_of(shelf.demos));
  CHECK(say({"lock", shelf.again}).out == file_text(shelf.lock));

  const std::string parts = shelf.folder / "parts.db";
  std::vector<std::string> merge = {"merge", parts};
  for (const std::string part : {"1", "2", "3"}) {
    merge.push_back(shelf.folder / ("part" + part + ".db"));
    CHECK(shelf.make({"--shard", part + "/3", "--out", merge.back()}).code == kDone);
  }
  REQUIRE(say(merge).code == kDone);
  CHECK(shelf.verify(parts).code == kDone);
  CHECK(shelf.verify(merge.back()).code == kNo);
  const Said once_more = shelf.make();
  CHECK(says(once_more.out, "0 episodes made, 16 were there already"));
}

TEST_CASE("a plan is made by parts on many machines, and says what is missing") {
  const Shelf shelf;
  std::vector<std::string> run = {"reach_target", "pick_and_lift", "--episodes", "4", "--set", "pick.height=0.1"};
  REQUIRE(shelf.run(run).code == kDone);
  run.emplace_back("--plan");
  const Said plan = shelf.run(run);
  REQUIRE(plan.code == kDone);
  put(shelf.folder, "demos.lock", plan.out);
  CHECK(lock_from_file(shelf.lock).is_plan());
  const std::vector<DefinitionRecord> planned = lock_from_file(shelf.lock).scripts;
  for (const StoredRun& made : Catalogue::open(shelf.demos).runs())
    for (const DefinitionRecord& used : made.definitions) {
      INFO(used.path);
      CHECK(std::ranges::any_of(planned, [&](const DefinitionRecord& one) {
        return std::tie(one.kind, one.name, one.path, one.hash) == std::tie(used.kind, used.name, used.path, used.hash);
      }));
    }
  CHECK(shelf.verify(shelf.demos).out == "complete: 8 episodes\n");
  const std::string a = shelf.folder / "a.db", b = shelf.folder / "b.db";
  REQUIRE(shelf.make({"--out", a, "--shard", "1/3"}).code == kDone);
  REQUIRE(shelf.make({"--out", b, "--shard", "2/3"}).code == kDone);
  const Said some = say({"verify", shelf.lock, a, b});
  CHECK(some.code == kNo);
  CHECK(says(some.out, "incomplete: 6 of 8 episodes are there\n2 episodes are missing:"));
  REQUIRE(shelf.make({"--out", a, "--shard", "3/3"}).code == kDone);
  CHECK(say({"verify", shelf.lock, a, b}).code == kDone);
  CHECK(shelf.make().out == shelf.again + ": 8 episodes made\ncomplete: 8 episodes\n");
  CHECK(hash_of(shelf.again) == hash_of(shelf.demos));
  const std::vector<std::pair<std::vector<std::string>, std::string>> slips = {
      {{"--policy", "true"}, "what a policy does cannot be planned"},
      {{"--planner", "true {domain} {problem} {plan}"}, "another program cannot be planned"},
      {{"--shard", "1/2"}, "a plan is of the whole run"},
      {{"--add-camera", "mine=at:1,0,1.5;look:0.2,0,0.75"}, "it has no room for cameras"}};
  for (const auto& [words, complaint] : slips) {
    std::vector<std::string> asked = {"reach_target", "--plan"};
    asked.insert(asked.end(), words.begin(), words.end());
    const Said said = shelf.run(asked);
    CHECK(said.code == kUsage);
    CHECK(says(said.err, complaint));
  }
}

TEST_CASE("a lock is verified by the parts of a catalogue") {
  const Shelf shelf;
  REQUIRE(shelf.run({"reach_target", "--episodes", "4"}).code == kDone);
  shelf.write_lock();
  const std::string a = shelf.folder / "a.db", b = shelf.folder / "b.db";
  REQUIRE(shelf.make({"--out", a, "--shard", "1/2"}).code == kDone);
  REQUIRE(shelf.make({"--out", b, "--shard", "2/2"}).code == kDone);
  CHECK(say({"verify", shelf.lock, a, b}).code == kDone);
  CHECK(say({"verify", shelf.lock, b}).code == kNo);
  change(b, "UPDATE segment SET end_step = end_step + 1 WHERE episode = 1 AND ordinal = 0");
  CHECK(says(say({"verify", shelf.lock, a, b}).out, "1 episodes have other content"));
}

TEST_CASE("the scripts of a lock are made of, not those that have their places now") {
  const Shelf shelf;
  const std::string task = file_text(std::string(kRoot) + "/tasks/reach_target.lua");
  put(shelf.folder, "mine/tasks/reach_mine.lua", task);
  const std::string mine = shelf.folder / "mine";
  REQUIRE(shelf.run({"reach_mine", "--episodes", "3", "--path", mine}).code == kDone);
  shelf.write_lock();
  put(shelf.folder, "mine/tasks/reach_mine.lua", task + "\n-- another\n");
  CHECK(shelf.make({"--path", mine}).code == kDone);
  CHECK(hash_of(shelf.again) == hash_of(shelf.demos));
  const std::string other = shelf.folder / "other.db";
  REQUIRE(say({"run", "reach_mine", "--episodes", "3", "--root", kRoot, "--path", mine, "--out", other}).code == kDone);
  const Said said = shelf.verify(other);
  CHECK(said.code == kNo);
  CHECK(says(said.out, "0 of 3 episodes are the same"));
  CHECK(says(said.out, "other scripts than were locked: tasks/reach_mine.lua"));
  // The task alone, in a place where the folder is not.
  CHECK(shelf.make({"--out", shelf.folder / "elsewhere.db"}).code == kDone);
}

TEST_CASE("what differs from a lock is told by episode") {
  const Shelf shelf;
  REQUIRE(shelf.run({"reach_target", "--variation", "colour=red", "--episodes", "4"}).code == kDone);
  shelf.write_lock();
  CHECK(shelf.verify(shelf.demos).code == kDone);
  REQUIRE(shelf.run({"reach_target", "--variation", "colour=red", "--seed", "9"}).code == kDone);
  const Said further = shelf.verify(shelf.demos);
  CHECK(further.code == kNo);
  CHECK(says(further.out, "4 of 4 episodes are the same"));
  CHECK(says(further.out, "1 episodes were not locked:\n    reach_target colour=red: seed 9"));

  REQUIRE(shelf.make().code == kDone);
  change(shelf.again, "UPDATE segment SET end_step = end_step + 1 WHERE episode = 2 AND ordinal = 0");
  const Said changed = shelf.verify(shelf.again);
  CHECK(changed.code == kNo);
  CHECK(says(changed.out, "4 episodes have other content:\n    reach_target colour=red: seeds 0, 1 … 3, 4 episodes"));

  const std::string part = shelf.folder / "part.db";
  REQUIRE(shelf.make({"--out", part, "--shard", "1/2"}).code == kDone);
  const Said missing = say({"verify", shelf.lock, part, "--json"});
  CHECK(missing.code == kNo);
  CHECK(says(missing.out, "\"missing\": ["));
  CHECK(says(missing.out, "\"first_seed\": 1,"));
  CHECK(says(missing.out, "\"stride\": 2,"));
}

TEST_CASE("a catalogue that no run makes again is not locked") {
  const Shelf shelf;
  REQUIRE(shelf.run({"reach_target"}).code == kDone);
  const std::string drawn = shelf.folder / "drawn.db";
  std::filesystem::copy_file(shelf.demos, drawn);
  REQUIRE(say({"render", drawn, "--into", drawn, "--frames", "keyframes", "--size", "16x16"}).code == kDone);
  const Said later = say({"lock", drawn});
  CHECK(later.code == kBadInput);
  CHECK(says(later.err, "episode 1 (reach_target, seed 0): its pictures were drawn later, not by the run"));

  shelf.run({"reach_target", "--policy", std::string("sh ") + kRoot + "/tests/program/wander.sh"});
  const Said acted = say({"lock", shelf.demos});
  CHECK(acted.code == kBadInput);
  CHECK(acted.out.empty());
  CHECK(says(acted.err, "episode 2 (reach_target, seed 0): an agent acted in it"));

  const Said planner = [&] {
    const std::string file = shelf.folder / "planner.db";
    say({"run", "reach_target", "--root", kRoot, "--out", file, "--planner", "false {domain} {problem} {plan}"});
    return say({"lock", file});
  }();
  CHECK(planner.code == kBadInput);
  CHECK(says(planner.err, "of the option 'planner' the catalogue keeps too little to use it again"));
}

TEST_CASE("a lock that this program cannot keep is refused before work starts") {
  struct Slip {
    std::string from, to, complaint;
  };
  const std::vector<Slip> slips = {
      {"\"release\": \"", "\"release\": \"9", "it was locked with release 9"},
      {"\"numerics\": \"", "\"numerics\": \"f", "on another class of processor"},
      {"\"stampede_lock\": 1", "\"stampede_lock\": 2", "a lock of another form"},
      {"\"stampede_lock\": 1", "\"lock\": 1", "it is no lock"},
      {"\"tasks/reach_target.lua\"", "\"../tasks/reach_target.lua\"", "is no path of a script"},
      {"\"tasks/reach_target.lua\"", "\"/tasks/reach_target.lua\"", "is no path of a script"},
      {"[\"task\", \"reach_target\"", "[\"chore\", \"reach_target\"", "no kind of script 'chore'"},
      {"\"sources\": \"", "\"sources\": \"AAAA", "the text of its scripts is damaged"},
      {"\"episodes\": 2,", "\"episodes\": 3,", "another number of episodes than it lists"},
      {"\"split\": \"train\"", "\"split\": \"test\"", "the test split has seeds from 1000000 up"},
      {"\"on_failure\": \"undo\"", "\"on_failure\": \"pray\"", "of the option 'on_failure'"},
      {"\"options\": {", "\"options\": { \"controller\": \"joint\",", "there is no controller 'joint'"},
      {"\"options\": {", "\"options\": { \"motion_planner\": \"PRM\",", "there is no motion planner 'PRM'"},
      {"[\"reach_target\", \"", "[\"reach_target\", \"no", "has no variation 'no"},
      {"\"hash\": ", "\"ha\": ", "there is no field 'ha'"}};
  const Shelf shelf;
  REQUIRE(shelf.run({"reach_target", "--episodes", "2"}).code == kDone);
  shelf.write_lock();
  const std::string sound = file_text(shelf.lock);
  for (const Slip& slip : slips) {
    INFO(slip.from);
    put(shelf.folder, "demos.lock", sound);
    shelf.change_lock(slip.from, slip.to);
    const Said said = shelf.make();
    CHECK(said.code == kBadInput);
    INFO(said.err);
    CHECK(says(said.err, slip.complaint));
    CHECK(!std::filesystem::exists(shelf.again));
  }
  put(shelf.folder, "demos.lock", sound);
  shelf.change_lock("\"numerics\": \"", "\"numerics\": \"f");
  const Said anyway = shelf.make({"--anyway"});
  CHECK(anyway.code == kDone);
  CHECK(says(anyway.err, "on another class of processor"));
  put(shelf.folder, "demos.lock", sound.substr(0, sound.size() / 2));
  CHECK(says(shelf.verify(shelf.demos).err, "this JSON ends too early"));
}

}  // namespace stampede::program
