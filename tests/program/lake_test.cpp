// `index` and `query DIR`: many catalogues below a folder, asked as one.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>

#include "db/reference.h"
#include "db/sqlite.h"
#include "say.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// A run in two shards, and the same merged.
struct RunInLake {
  Folder folder;
  std::string lake = folder / "lake", a = folder / "lake/a/part1.db", b = folder / "lake/b/part 2.db",
              merged = folder / "merged.db", index = folder / "lake/index.lake";
  RunInLake() {
    fs::create_directories(fs::path(a).parent_path());
    fs::create_directories(fs::path(b).parent_path());
    for (const auto& [file, part] : {std::pair(a, "1/2"), std::pair(b, "2/2")})
      REQUIRE(
          say({"run", "reach_target", "push_buttons", "--episodes", "3", "--images", "keyframes", "--size", "16x16",
               "--kinds", "rgb,instance", "--channels", "all,margins", "--root", kRoot, "--shard", part, "--out", file})
              .code == kDone);
    REQUIRE(say({"merge", merged, a, b}).code == kDone);
  }
  nlohmann::json make_index() const {
    const Said said = say({"index", lake, "--json"});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return nlohmann::json::parse(said.out);
  }
};

Said answer_of_lake(const std::string& of, const std::string& question) {
  return say({"query", of, question, "--format", "csv"});
}

std::vector<std::string> sorted_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  std::ranges::sort(lines);
  return lines;
}

}  // namespace

TEST_CASE("a folder answers every view and ready question as the merged file does, and its files stay as they are") {
  const RunInLake run;
  const std::string before = file_text(run.a) + file_text(run.b);
  const nlohmann::json made = run.make_index();
  CHECK(made["files"] == 2);
  CHECK(made["episodes"] == 6);
  int rows = 0;
  for (const ViewReference& view : view_reference()) {
    INFO(view.name);
    const std::string question = "SELECT * FROM " + view.name;
    const std::string said = answer_of_lake(run.lake, question).out;
    CHECK(sorted_lines(said) == sorted_lines(answer_of_lake(run.merged, question).out));
    rows += static_cast<int>(sorted_lines(said).size()) - 1;
  }
  CHECK(rows > 10'000);
  for (const NamedQuery& query : named_queries()) {
    INFO(query.name);
    CHECK(sorted_lines(answer_of_lake(run.lake, query.name).out) ==
          sorted_lines(answer_of_lake(run.merged, query.name).out));
  }
  for (const std::string question :
       {"SELECT * FROM progress ORDER BY episode, frame", "SELECT * FROM frames WHERE episode = 5 AND frame = 7",
        "SELECT count(*) FROM frames WHERE episode = 99", "SELECT count(*) FROM frames WHERE episode IS NULL",
        "SELECT count(*) FROM steps WHERE episode = '3'", "SELECT sum(length(data)) FROM images",
        "SELECT f.episode, g.frame FROM frames f JOIN frames g ON g.episode = f.episode + 1 AND g.frame = f.frame + 1 "
        "ORDER BY 1, 2",
        "SELECT episode, count(*) FROM poses GROUP BY 1 ORDER BY 1"}) {
    INFO(question);
    const Said said = answer_of_lake(run.lake, question);
    CHECK(said.err == "");
    CHECK(said.out == answer_of_lake(run.merged, question).out);
  }
  CHECK(answer_of_lake(run.lake, "SELECT DISTINCT file_of(episode) AS file FROM steps ORDER BY 1").out ==
        "file\n" + run.a + "\n" + run.b + "\n");
  CHECK(answer_of_lake(run.lake, "SELECT max(number_in_file(episode)) AS n FROM episodes").out == "n\n3\n");
  CHECK(answer_of_lake(run.lake, "DELETE FROM episode").code == kBadInput);
  CHECK(file_text(run.a) + file_text(run.b) == before);
}

TEST_CASE("files of an indexed folder come, go and change without a rebuild, and an old index is told of") {
  const RunInLake run;
  run.make_index();
  const auto count = [&] { return answer_of_lake(run.lake, "SELECT count(*) AS n FROM episodes").out; };
  CHECK(run.make_index()["added"] == 0);

  const std::string third = run.folder / "lake/part3.db";
  REQUIRE(say({"run", "close_drawer", "--episodes", "1", "--root", kRoot, "--out", third}).code != kUsage);
  const Said unknown = answer_of_lake(run.lake, "SELECT count(*) AS n FROM episodes");
  CHECK(unknown.out == "n\n6\n");
  CHECK(says(unknown.err, "1 catalogues below " + run.lake + " are not in its index: `stampede index"));
  CHECK(run.make_index()["added"] == 1);
  CHECK(count() == "n\n7\n");
  CHECK(
      sorted_lines(answer_of_lake(run.lake, "SELECT DISTINCT name FROM definitions WHERE kind = 'task'").out).size() ==
      4);

  REQUIRE(say({"run", "close_drawer", "--episodes", "2", "--root", kRoot, "--out", third}).code != kUsage);
  const Said changed = answer_of_lake(run.lake, "SELECT 1");
  CHECK(changed.code == kCatalogue);
  CHECK(says(changed.err, third + ": it has changed since it was indexed"));
  CHECK(says(changed.err, "stampede index"));
  const nlohmann::json again = run.make_index();
  CHECK((again["added"] == 1 && again["removed"] == 1 && again["episodes"] == 8));

  fs::remove(third);
  CHECK(says(answer_of_lake(run.lake, "SELECT 1").err, third + ": it was indexed, and is gone"));
  CHECK(run.make_index()["removed"] == 1);
  CHECK(count() == "n\n6\n");
  CHECK(
      sorted_lines(answer_of_lake(run.lake, "SELECT DISTINCT name FROM definitions WHERE kind = 'task'").out).size() ==
      3);
  CHECK(sorted_lines(answer_of_lake(run.lake, "SELECT * FROM coverage").out) ==
        sorted_lines(answer_of_lake(run.merged, "SELECT * FROM coverage").out));

  fs::copy_file(run.merged, third);
  const nlohmann::json twice = run.make_index();
  CHECK((twice["twice"] == 6 && twice["files"] == 3 && twice["episodes"] == 6));
}

TEST_CASE("a folder that cannot be asked is told of with its cure") {
  const RunInLake run;
  CHECK(says(answer_of_lake(run.lake, "SELECT 1").err, "`stampede index " + run.lake + "` makes it"));
  CHECK(says(say({"index", run.folder / "nowhere"}).err, "there is no such folder"));
  fs::create_directory(run.folder / "empty");
  CHECK(says(say({"index", run.folder / "empty"}).err, "there is no catalogue below it"));
  put(run.folder, "lake/notes.db", "not a database");
  const Said made = say({"index", run.lake});
  CHECK(made.code == kDone);
  CHECK(says(made.err, "no catalogues, left out: notes.db"));
  CHECK(says(say({"query", run.lake, run.merged, "SELECT 1"}).err, "this is a folder"));

  SECTION("an index of somebody else names no file that we open") {
    {
      sql::Database index(run.index, SQLITE_OPEN_READWRITE, run.index);
      index.run("UPDATE own_lake_file SET path = '../merged.db' WHERE id = 1");
    }
    CHECK(says(answer_of_lake(run.lake, "SELECT count(*) FROM frames").err, "is gone"));
  }
  SECTION("nor is another catalogue an index") {
    fs::remove(run.index);
    fs::copy_file(run.merged, run.index);
    CHECK(says(answer_of_lake(run.lake, "SELECT 1").err, "it is no index"));
    const std::string before = file_text(run.index);
    const Said said = say({"index", run.lake});
    CHECK(said.code == kCatalogue);
    CHECK(says(said.err, "this is a catalogue, and no index"));
    CHECK(file_text(run.index) == before);
  }
  SECTION("nor is one written that has another name, through a link or without") {
    const std::string before = file_text(run.merged);
    for (const bool hard : {false, true}) {
      fs::remove(run.index);
      hard ? fs::create_hard_link(run.merged, run.index) : fs::create_symlink(run.merged, run.index);
      const Said said = say({"index", run.lake});
      CHECK(said.code == kCatalogue);
      CHECK(says(said.err, hard ? "another name" : "this is a link"));
      CHECK(file_text(run.merged) == before);
      CHECK_FALSE(fs::exists(run.merged + "-wal"));
    }
  }
  SECTION("nor one whose episodes are of no file") {
    {
      sql::Database index(run.index, SQLITE_OPEN_READWRITE, run.index);
      index.run("UPDATE own_lake_episode SET file = 77");
    }
    CHECK(says(answer_of_lake(run.lake, "SELECT count(*) FROM frames").err, "it is damaged"));
    CHECK(says(answer_of_lake(run.lake, "SELECT count(*) FROM frames").err, "remove it"));
    CHECK(answer_of_lake(run.lake, "SELECT file_of(episode) FROM episodes").code != kBug);
  }
  SECTION("nor is one that has lost where an episode is") {
    {
      sql::Database index(run.index, SQLITE_OPEN_READWRITE, run.index);
      index.run("DELETE FROM own_lake_episode WHERE episode = 2");
    }
    CHECK(says(answer_of_lake(run.lake, "SELECT count(*) FROM frames").err,
               "episode 2 is nowhere: the index is damaged"));
    CHECK(answer_of_lake(run.lake, "SELECT count(*) > 0 AS n FROM frames WHERE episode = 3").out == "n\n1\n");
  }
  SECTION("two files that say different things of one episode are named") {
    const std::string other = run.folder / "lake/z.db";
    fs::copy_file(run.a, other);
    {
      sql::Database file(other, SQLITE_OPEN_READWRITE, other);
      file.run("UPDATE episode SET detail = 'another' WHERE id = 1");
    }
    const Said said = say({"index", run.lake});
    CHECK(said.code == kCatalogue);
    CHECK((says(said.err, other) && says(said.err, run.a) && says(said.err, "with other content")));
    CHECK(answer_of_lake(run.lake, "SELECT count(*) AS n FROM episodes").out == "n\n6\n");
  }
}

}  // namespace stampede::program
