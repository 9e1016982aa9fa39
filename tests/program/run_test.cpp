#include <catch2/catch.hpp>

#include "scripting/session/episode_job.h"
#include "scripting/session/roots.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

constexpr const char* kRoot = STAMPEDE_SOURCE_DIR;

}  // namespace

TEST_CASE("episode i has seed S+i, and the first V episodes meet each of V variations once") {
  const auto library = Library::load(make_roots(kRoot, {}));
  const auto count = static_cast<std::int64_t>(task_info(*library, "reach_target").variation_texts.size());
  const std::vector<EpisodeJob> jobs = plan_jobs(*library, {{"reach_target"}, count, 50, ""});
  std::set<std::string> variations;
  std::set<std::int64_t> seeds;
  for (const EpisodeJob& job : jobs) {
    variations.insert(job.variation);
    seeds.insert(job.seed);
  }
  CHECK(std::is_sorted(jobs.begin(), jobs.end()));
  CHECK(static_cast<std::int64_t>(variations.size()) == count);
  CHECK(*seeds.begin() == 50);
  CHECK(*seeds.rbegin() == 50 + count - 1);
  for (const EpisodeJob& job : plan_jobs(*library, {{"reach_target"}, 5, 0, "colour=red"})) {
    CHECK(job.variation.find("colour=red") != std::string::npos);
  }
  CHECK_THROWS_AS(plan_jobs(*library, {{"reach_targett"}, 1, 0, ""}), Error);
  CHECK_THROWS_AS(plan_jobs(*library, {{"reach_target"}, 1, 0, "colour=rde"}), Error);
}

TEST_CASE("a key tells apart seed, variation, options and definitions, and nothing else") {
  const std::vector<DefinitionRecord> files = {{"task", "a", "a.lua", "", "h1"}, {"skill", "b", "b.lua", "", "h2"}};
  const std::vector<DefinitionRecord> reversed = {files[1], files[0]};
  const std::string key = episode_key(files, {"a", "v", 1}, {});
  CHECK(key == episode_key(reversed, {"a", "v", 1}, {}));
  CHECK(key != episode_key(files, {"a", "v", 2}, {}));
  CHECK(key != episode_key(files, {"a", "w", 1}, {}));
  RunOptions stop;
  stop.on_failure = OnFailure::stop;
  CHECK(key != episode_key(files, {"a", "v", 1}, stop));
  std::vector<DefinitionRecord> edited = files;
  edited[1].hash = "h3";
  CHECK(key != episode_key(edited, {"a", "v", 1}, {}));
}

TEST_CASE("a file that `new` writes passes `check`, and a misspelt field ends with 3") {
  const Folder mine;
  for (const char* kind : {"task", "skill", "predicate", "object"}) {
    const Said made = say({"new", kind, std::string("my_") + kind, "--root", kRoot, "--path", mine.text()});
    INFO(made.err);
    REQUIRE(made.code == kDone);
  }
  const Said sound = say({"check", "--root", kRoot, "--path", mine.text()});
  INFO(sound.out);
  CHECK(sound.code == kDone);
  CHECK(say({"new", "task", "my_task", "--root", kRoot, "--path", mine.text()}).code == kUsage);

  std::ofstream(mine / "tasks/my_task.lua") << "-- Wrong.\nreturn task {\n  object = {},\n}\n";
  const Said wrong = say({"check", "my_task", "--root", kRoot, "--path", mine.text()});
  CHECK(wrong.code == kBadInput);
  CHECK(wrong.out.find("did you mean 'objects'?") != std::string::npos);
}

TEST_CASE("new keeps what editors read in an own folder current, and leaves their settings alone") {
  const Folder mine;
  const auto make = [&](const char* name) {
    return say({"new", "predicate", name, "--root", kRoot, "--path", mine.text()}).code;
  };
  REQUIRE(make("tilted") == kDone);
  CHECK(says(file_text(mine / ".luarc.json"), ".stampede"));
  std::ofstream(mine / ".luarc.json") << "{}";
  REQUIRE(make("upright") == kDone);
  CHECK(file_text(mine / ".luarc.json") == "{}");
  const std::string names = file_text(mine / ".stampede/names.lua");
  for (const char* name : {"field tilted fun(", "field upright fun(", "field inside fun("}) CHECK(says(names, name));
  const auto check = [&] { return say({"doc", "--check", "--root", kRoot, "--path", mine.text()}).code; };
  CHECK(check() == kDone);
  std::filesystem::remove(mine / "worlds/predicates/tilted.lua");
  CHECK(check() == kNo);
  const Said elsewhere = say({"doc", "--root", mine.text()});
  CHECK(elsewhere.code == kUsage);
  CHECK(says(elsewhere.err, "--path"));
}

}  // namespace stampede::program
