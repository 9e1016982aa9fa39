// What each release wrote, a catalogue, its lock and an evaluation, is read by every later one: tests/db/data/VERSION.
#include <catch2/catch.hpp>

#include "say.h"
#include "tests/db/sample_episode.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> folders_of_releases() {
  std::vector<fs::path> folders;
  for (const auto& entry : fs::directory_iterator(STAMPEDE_SOURCE_DIR "/tests/db/data"))
    if (entry.is_directory()) folders.push_back(entry.path());
  return folders;
}

}  // namespace

TEST_CASE("what each release wrote is read") {
  REQUIRE_FALSE(folders_of_releases().empty());
  for (const fs::path& stored : folders_of_releases()) {
    const std::string version = stored.filename();
    CAPTURE(version);
    const Folder folder;
    const std::string demos = folder / "demos.db", evaluation = folder / "evaluation.db", lock = stored / "demos.lock";
    test::unpack(stored / "demos.db.gz", demos);
    test::unpack(stored / "evaluation.db.gz", evaluation);

    const Said same = say({"verify", lock, demos});
    CHECK(same.code == kDone);
    CHECK(says(same.out, "as locked: 1 episodes"));
    CHECK(say({"verify", lock, evaluation}).code != kDone);
    const Said made_by = say({"query", demos, "SELECT DISTINCT engine_version FROM episodes", "--format", "csv"});
    CHECK(made_by.out == "engine_version\n" + version + "\n");
    const Said rate = say({"query", evaluation, "success_by_perturbation", "--format", "csv"});
    CHECK(rate.code == kDone);
    CHECK(says(rate.out, "reach_target,test,planner,none,1,1,1"));
    // The release that says this version makes the same bits; any other says whose the lock is before it makes any.
    const Said again = say({"make", lock, "--out", folder / "again.db"});
    CHECK((again.code == kDone || says(again.err, "it was locked with release " + version) ||
           says(again.err, "on another class of processor")));
  }
}

}  // namespace stampede::program
