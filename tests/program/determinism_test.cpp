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

}  // namespace stampede::program
