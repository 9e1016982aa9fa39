#include "db/merge.h"

#include <catch2/catch.hpp>

#include "db/catalogue_writer.h"
#include "db/sqlite.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

EpisodeRecord episode_of(int seed) {
  EpisodeRecord episode = sample_episode(seed % 2 ? "lift" : "stack", seed % 3 ? "colour=red" : "colour=blue", seed);
  if (seed % 4 == 0) episode.images = sample_images(episode, {0, 3});
  return episode;
}

void make(const std::filesystem::path& path, const std::vector<int>& seeds) {
  CatalogueWriter writer(path, {kEngine, 1'000'000, {}});
  std::int64_t place = 0;
  for (const int seed : seeds) writer.finished(place++, episode_of(seed));
  writer.finish();
}

std::string hash_of(const std::filesystem::path& path) { return Catalogue::open(path).content_hash(); }

}  // namespace

TEST_CASE("merged parts are what one run would have made") {
  const Folder folder;
  make(folder / "all.db", {1, 2, 3, 4, 5, 6, 7, 8});
  make(folder / "a.db", {1, 4, 7});
  make(folder / "b.db", {2, 5, 8});
  make(folder / "c.db", {3, 6});
  const MergeResult result = merge(folder / "sum.db", {folder / "c.db", folder / "a.db", folder / "b.db"});
  REQUIRE(result.files.size() == 3);
  CHECK((result.files[0].added == 2 && result.files[1].added == 3 && result.files[2].added == 3));
  CHECK(hash_of(folder / "sum.db") == hash_of(folder / "all.db"));
  const Catalogue sum = Catalogue::open(folder / "sum.db"), all = Catalogue::open(folder / "all.db");
  const std::string visible =
      "SELECT task, seed, name, pixels FROM visible JOIN episodes USING (episode, task) ORDER BY 1, 2, "
      "frame, camera, instance";
  CHECK(!sum.query(visible).rows.empty());
  CHECK(sum.query(visible).rows == all.query(visible).rows);
  const std::string asked =
      "SELECT task, seed, ordinal, frame, end_frame, space, numbers, parameters, reward "
      "FROM agent_actions ORDER BY 1, 2, 3";
  CHECK(sum.query(asked).rows.size() == 8 * 6);
  CHECK(sum.query(asked).rows == all.query(asked).rows);
  const sql::Database file((folder / "sum.db").string(), SQLITE_OPEN_READONLY, "sum.db");
  CHECK(file.number("SELECT count(*) FROM pragma_foreign_key_check") == 0);
  CHECK(file.number("SELECT count(*) FROM timing") == 8);
}

TEST_CASE("merging again, and merging what overlaps, adds only what is new") {
  const Folder folder;
  make(folder / "a.db", {1, 2, 3});
  make(folder / "b.db", {2, 3, 4});
  merge(folder / "sum.db", {folder / "a.db"});
  const MergeResult again = merge(folder / "sum.db", {folder / "a.db", folder / "b.db"});
  CHECK((again.files[0].added == 0 && again.files[0].existing == 3));
  CHECK((again.files[1].added == 1 && again.files[1].existing == 2));
  make(folder / "all.db", {1, 2, 3, 4});
  CHECK(hash_of(folder / "sum.db") == hash_of(folder / "all.db"));
}

TEST_CASE("a merge that was killed before its file had a table is made again") {
  const Folder folder;
  make(folder / "one.db", {1, 2});
  const std::filesystem::path into = folder / "into.db";
  {
    const sql::Database database(into.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, into.string());
    database.run("PRAGMA journal_mode = WAL");  // its log goes as it is closed
  }
  REQUIRE(std::filesystem::file_size(into) > 0);
  CHECK(Catalogue::is_new(into));
  CHECK_THROWS_WITH(Catalogue::open(into), Contains("holds nothing by itself"));
  merge(into, {folder / "one.db"});
  CHECK_FALSE(Catalogue::is_new(into));
  CHECK(hash_of(into) == hash_of(folder / "one.db"));
}

TEST_CASE("the same key with other content names both files, and nothing is written") {
  const Folder folder;
  make(folder / "a.db", {1, 2});
  make(folder / "b.db", {2, 3});
  {
    const sql::Database file((folder / "b.db").string(), SQLITE_OPEN_READWRITE, "b.db");
    file.run("UPDATE joint_state SET position_0 = 0.5 WHERE episode = 1 AND frame = 3");
  }
  CHECK_THROWS_WITH(merge(folder / "sum.db", {folder / "a.db", folder / "b.db"}),
                    Contains("a.db") && Contains("b.db") && Contains("seed 2") && Contains("other content") &&
                        Contains("leave one of the two files out"));
  CHECK(!std::filesystem::exists(folder / "sum.db"));
  CHECK_THROWS_WITH(merge(folder / "a.db", {folder / "b.db"}), Contains("a.db") && Contains("b.db") &&
                                                                   Contains("seed 2") && Contains("other content") &&
                                                                   Contains("leave one of the two files out"));
  CHECK(Catalogue::open(folder / "a.db").episodes().size() == 2);
}

TEST_CASE("catalogues that disagree about a variation are kept apart") {
  const Folder folder;
  make(folder / "a.db", {1});
  make(folder / "b.db", {5});  // the same task and variation
  {
    const sql::Database file((folder / "b.db").string(), SQLITE_OPEN_READWRITE, "b.db");
    file.run("UPDATE variation_axis SET value = 'crimson'");
  }
  CHECK_THROWS_WITH(merge(folder / "a.db", {folder / "b.db"}),
                    Contains("disagree about the variation lift colour=red"));
  CHECK(Catalogue::open(folder / "a.db").episodes().size() == 1);
}

TEST_CASE("what cannot be merged is told") {
  const Folder folder;
  make(folder / "a.db", {1});
  CHECK_THROWS_WITH(merge(folder / "a.db", {folder / "a.db"}), Contains("both read and written"));
  CHECK_THROWS_WITH(merge(folder / "b.db", {folder / "none.db"}), Contains("no such file"));
  CHECK(!std::filesystem::exists(folder / "b.db"));
  const std::atomic<bool> stop = true;
  make(folder / "many.db", {2, 3, 4, 5});
  CHECK(merge(folder / "a.db", {folder / "many.db"}, {.stop = &stop}).interrupted);
}

TEST_CASE("episodes that were made differently are put together only where that is asked for") {
  const Folder folder;
  make(folder / "a.db", {1});
  struct Other {
    const char *change, *complaint;
  };
  const Other others[] = {
      {"UPDATE engine_run SET engine_version = '0.0.1'", "made of another release than those of"},
      {"UPDATE engine_run SET numerics = 'f00'", "by another build, or on another class of processor"},
      {"PRAGMA foreign_keys = OFF; UPDATE definition SET hash = 'f00'; UPDATE engine_run_definition SET hash = 'f00'",
       "made of another version of"}};
  for (const Other& other : others) {
    std::filesystem::remove(folder / "b.db");
    make(folder / "b.db", {2});
    {
      const sql::Database file((folder / "b.db").string(), SQLITE_OPEN_READWRITE, "b.db");
      file.run(other.change);
    }
    CHECK_THROWS_WITH(merge(folder / "sum.db", {folder / "a.db", folder / "b.db"}),
                      Contains(other.complaint) && Contains("a.db") && Contains("--mixed"));
    CHECK(!std::filesystem::exists(folder / "sum.db"));
    CHECK_THROWS_WITH(merge(folder / "b.db", {folder / "a.db"}), Contains(other.complaint));
  }
  CHECK(merge(folder / "sum.db", {folder / "a.db", folder / "b.db"}, {.mixed = true}).files.size() == 2);
  CHECK(Catalogue::open(folder / "sum.db").episodes().size() == 2);
  make(folder / "c.db", {3});
  CHECK(merge(folder / "sum.db", {folder / "c.db"}).files[0].added == 1);  // it holds both versions already
}

TEST_CASE("tables of a file's owner are named, and stay where they are") {
  const Folder folder;
  make(folder / "a.db", {1});
  {
    const sql::Database file((folder / "a.db").string(), SQLITE_OPEN_READWRITE, "a.db");
    file.run("CREATE TABLE own_notes (text TEXT); CREATE TABLE own_marks (n INTEGER)");
  }
  CHECK(merge(folder / "sum.db", {folder / "a.db"}).files[0].own_tables ==
        std::vector<std::string>{"own_marks", "own_notes"});
}
