// Several catalogues asked as one: the answers of a file that has it all, and files that stay as they were.
#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "db/catalogue_set.h"
#include "db/catalogue_writer.h"
#include "db/embedded_sql.h"
#include "db/schema.h"
#include "db/table_text.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

void make_shard(const fs::path& path, const std::vector<int>& seeds) {
  CatalogueWriter writer(path, {kEngine, 1'000'000, {}});
  std::int64_t place = 0;
  for (const int seed : seeds) {
    EpisodeRecord episode = sample_episode(seed % 2 ? "lift" : "stack", seed % 3 ? "colour=red" : "colour=blue", seed);
    if (seed % 4 == 0) episode.images = sample_images(episode, {0, 3});
    writer.finished(place++, episode);
  }
  writer.finish();
}

// Three shards, and what one run would have made.
struct Shards {
  Folder folder;
  std::vector<fs::path> files = {folder / "a.db", folder / "b.db", folder / "c.db"};
  Shards() {
    make_shard(folder / "all.db", {1, 2, 3, 4, 5, 6, 7, 8});
    make_shard(files[0], {1, 2, 3});
    make_shard(files[1], {4, 5, 6});
    make_shard(files[2], {7, 8});
  }
  Catalogue all() const { return Catalogue::open(folder / "all.db"); }
};

std::vector<std::string> sorted_lines(const QueryResult& answer) {
  std::istringstream text(to_csv(answer));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  std::sort(lines.begin(), lines.end());
  return lines;
}

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("every view and every named query of shards answers as the undivided file does") {
  const Shards shards;
  const Catalogue all = shards.all();
  const CatalogueSet set(shards.files);
  for (const SqlFile& view : embedded_views()) {
    INFO(view.name);
    const std::string question = "SELECT * FROM " + view.name;
    CHECK(set.query("SELECT count(*) FROM " + view.name).rows == all.query("SELECT count(*) FROM " + view.name).rows);
    CHECK(set.query(question).columns == all.query(question).columns);
    CHECK(sorted_lines(set.query(question)) == sorted_lines(all.query(question)));
  }
  for (const NamedQuery& query : named_queries()) {
    INFO(query.name);
    CHECK(to_csv(set.query(query.name)) == to_csv(all.query(query.name)));
  }
  for (const std::string table : {"progress", "applicable"})
    CHECK(sorted_lines(set.query("SELECT * FROM " + table)) == sorted_lines(all.query("SELECT * FROM " + table)));
  // A set that is asked one thing only has nothing that was copied for another.
  for (const SqlFile& view : embedded_views()) {
    INFO(view.name);
    const std::string question = "SELECT count(*), EXISTS (SELECT 1 FROM " + view.name + ") FROM " + view.name;
    CHECK(CatalogueSet(shards.files).query(question).rows == all.query(question).rows);
  }
  for (const Table& table : current_tables()) {
    if (!table.of_episode) continue;
    INFO(table.name);
    const std::string question = "SELECT count(*) FROM " + table.name;
    CHECK(CatalogueSet(shards.files).query(question).rows == all.query(question).rows);
  }
}

TEST_CASE("pictures of shards are read where they lie") {
  const Shards shards;
  const std::string question =
      "SELECT task, seed, frame, camera, kind, bytes, data, encoding FROM images ORDER BY 1, 2, 3, 4, 5";
  const QueryResult answer = CatalogueSet(shards.files).query(question);
  CHECK(!answer.rows.empty());
  CHECK(answer.rows == shards.all().query(question).rows);
}

TEST_CASE("a row tells which file it is from, and by which number") {
  const Shards shards;
  const CatalogueSet set(shards.files);
  const QueryResult rows = set.query(
      "SELECT episode, file_of(episode) AS file, number_in_file(episode) AS number, seed FROM episodes ORDER BY 1");
  REQUIRE(rows.size() == 8);
  CHECK((rows.integer(0, "episode") == 1 && rows.text(0, "file") == shards.files[0].string()));
  CHECK((rows.integer(4, "episode") == 5 && rows.text(4, "file") == shards.files[1].string()));
  CHECK((rows.integer(4, "number") == 2 && rows.integer(4, "seed") == 5));
  CHECK(set.query("SELECT DISTINCT file_of(episode) FROM facts").size() == 3);
  CHECK(set.query("SELECT file_of(99), number_in_file(0), file_of(NULL), file_of('x')").rows ==
        std::vector<std::vector<SqlValue>>(1, std::vector<SqlValue>(4)));
  const CatalogueSet::Place place = set.place(5);
  CHECK((place.episode == 2 && place.catalogue.read_episode(place.episode).seed == 5));
  CHECK_THROWS_WITH(set.place(9), Contains("there is no episode 9") && Contains("a.db and 2 more"));
  const Catalogue one = shards.all();
  const QueryResult own = one.query("SELECT file_of(3) AS file, number_in_file(3) AS number");
  CHECK((own.text(0, "file") == (shards.folder / "all.db").string() && own.integer(0, "number") == 3));
}

TEST_CASE("an episode that two files have is counted once, and so is a file that is named twice") {
  const Folder folder;
  make_shard(folder / "a.db", {1, 2, 3});
  make_shard(folder / "b.db", {2, 3, 4});
  fs::create_symlink(folder / "a.db", folder / "link.db");
  const CatalogueSet set({folder / "a.db", folder / "link.db", folder / "b.db", folder / "a.db"});
  CHECK(to_csv(set.query("SELECT episode, seed, number_in_file(episode) AS number FROM episodes")) ==
        "episode,seed,number\n1,1,1\n2,2,2\n3,3,3\n4,4,3\n");
  CHECK(CatalogueSet({folder / "b.db", folder / "b.db"}).query("SELECT count(*) FROM episodes").rows[0][0] ==
        SqlValue{std::int64_t{3}});
}

TEST_CASE("files that contradict each other are refused by both names") {
  const Folder folder;
  make_shard(folder / "a.db", {1, 2});
  make_shard(folder / "b.db", {2, 3});
  change(folder / "b.db", "UPDATE joint_state SET position_0 = 0.5 WHERE episode = 1 AND frame = 3");
  CHECK_THROWS_AS(CatalogueSet({folder / "a.db", folder / "b.db"}), CatalogueError);
  CHECK_THROWS_WITH(CatalogueSet({folder / "a.db", folder / "b.db"}),
                    Contains("a.db") && Contains("b.db") && Contains("seed 2") && Contains("other content"));
  make_shard(folder / "c.db", {5});
  change(folder / "c.db", "UPDATE variation_axis SET value = 'crimson'");
  CHECK_THROWS_WITH(CatalogueSet({folder / "a.db", folder / "c.db"}),
                    Contains("c.db: it and") && Contains("a.db") && Contains("disagree about the variation"));
}

TEST_CASE("files that cannot serve are told by their names") {
  const Folder folder;
  make_shard(folder / "a.db", {1});
  CHECK_THROWS_WITH(CatalogueSet({folder / "a.db", folder / "none.db"}), Contains("none.db: there is no such file"));
  std::ofstream(folder / "letter.db") << std::string(4096, 'x');
  CHECK_THROWS_WITH(CatalogueSet({folder / "a.db", folder / "letter.db"}),
                    Contains("letter.db: this file is not a database"));
  CHECK_THROWS_WITH(CatalogueSet(std::vector<fs::path>()), Contains("no file is named"));
  make_shard(folder / "b.db", {2});
  const CatalogueSet set({folder / "a.db", folder / "b.db"});
  CHECK_THROWS_WITH(set.query("DELETE FROM episode"), Contains("a query only reads"));
  CHECK_THROWS_WITH(set.query("SELECT colour FROM segments"), Contains("segments has episode task"));
  CHECK_THROWS_WITH(set.query("no_such_query"), Contains("success_by_task"));
  CHECK_THROWS_WITH(set.query("ATTACH '" + (folder / "a.db").string() + "' AS x"), Contains("a query only reads"));
  CHECK(set.query("SELECT count(*) FROM episodes").rows[0][0] == SqlValue{std::int64_t{2}});  // as if nothing had been
}

TEST_CASE("a row that no catalogue can hold is told with its file") {
  const Folder folder;
  make_shard(folder / "a.db", {1});
  make_shard(folder / "b.db", {2});
  change(folder / "b.db", "PRAGMA ignore_check_constraints = ON; UPDATE segment SET kind = 'dance'");
  const CatalogueSet set({folder / "a.db", folder / "b.db"});
  CHECK_THROWS_WITH(set.query("SELECT count(*) FROM segments"),
                    Contains("b.db: a row of segment can be none") && Contains("damaged or changed by hand"));
  CHECK(set.query("SELECT count(*) FROM objects").rows.size() == 1);
}

TEST_CASE("files of earlier releases are asked beside those of this one, and none is touched") {
  for (const fs::path& stored : stored_releases()) {
    INFO(stored);
    const Folder folder;
    make_shard(folder / "new.db", {1, 4});
    unpack(stored, folder / "old.db");
    const std::string before = bytes_of(folder / "old.db") + bytes_of(folder / "new.db");
    {
      const CatalogueSet set({folder / "old.db", folder / "new.db"});
      const Catalogue old = Catalogue::open(folder / "old.db"), current = Catalogue::open(folder / "new.db");
      for (const SqlFile& view : embedded_views()) {
        INFO(view.name);
        const std::string question = "SELECT count(*) AS n FROM " + view.name;
        CHECK(set.query(question).integer(0, "n") ==
              old.query(question).integer(0, "n") + current.query(question).integer(0, "n"));
      }
      for (const NamedQuery& query : named_queries()) {
        INFO(query.name);
        CHECK_NOTHROW(set.query(query.name));
      }
    }
    CHECK(bytes_of(folder / "old.db") + bytes_of(folder / "new.db") == before);
    CHECK(names_in(folder.path()) == std::vector<std::string>{"new.db", "old.db"});
  }
}

TEST_CASE("a set sees what others add to its files, by numbers after all others") {
  const Folder folder;
  make_shard(folder / "a.db", {1});
  make_shard(folder / "b.db", {2});
  const CatalogueSet set({folder / "a.db", folder / "b.db"});
  const std::string question =
      "SELECT episode, seed, (SELECT count(*) FROM facts f WHERE f.episode = e.episode) > 0 AS facts FROM episodes e";
  CHECK(to_csv(set.query(question)) == "episode,seed,facts\n1,1,1\n2,2,1\n");
  Catalogue::write(folder / "a.db").add(sample_episode("lift", "colour=red", 7), kEngine);
  CHECK(to_csv(set.query(question)) == "episode,seed,facts\n1,1,1\n2,2,1\n3,7,1\n");
  CHECK(set.place(3).episode == 2);
}

TEST_CASE("a set that is interrupted ends, and answers again") {
  const Shards shards;
  const CatalogueSet set(shards.files);
  struct Interrupts : RowReceiver {
    explicit Interrupts(const CatalogueSet& all) : set(all) {}
    void columns(const std::vector<std::string>&) override {}
    bool row(const std::vector<SqlValue>&) override { return set.interrupt(), true; }
    const CatalogueSet& set;
  } receiver(set);
  CHECK_THROWS_WITH(set.query("SELECT * FROM joints a, joints b", receiver), Contains("interrupted"));
  CHECK_THROWS_WITH(set.query("SELECT * FROM progress", receiver), Contains("interrupted"));
  CHECK(set.query("SELECT count(*) FROM episodes").rows[0][0] == SqlValue{std::int64_t{8}});
}
