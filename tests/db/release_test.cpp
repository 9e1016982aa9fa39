// Catalogues of earlier releases: opened to read and to write, questioned, replayed, migrated, and what is no release.
#include <sqlite3.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <csignal>
#include <fstream>
#include <functional>

#include "db/embedded_sql.h"
#include "db/merge.h"
#include "db/migrations.h"
#include "db/schema.h"
#include "engine/episode/runner.h"
#include "engine/render/png.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

std::int64_t number(const fs::path& path, const std::string& sql) {
  const sql::Database database(path.string(), SQLITE_OPEN_READONLY, path.string());
  return database.number(sql);
}

// In a process of its own; its wait status.
int in_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    try {
      work();
    } catch (const std::exception&) {
      ::_exit(1);
    }
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

// The process dies when SQLite begins the statement that drops the first old table.
int die_at_drop(sqlite3* handle, char**, const void*) {
  return sqlite3_trace_v2(
      handle, SQLITE_TRACE_STMT,
      [](unsigned, void*, void*, void* text) {
        if (std::string_view(static_cast<const char*>(text)).starts_with("DROP TABLE segment")) ::raise(SIGKILL);
        return 0;
      },
      nullptr);
}

}  // namespace

TEST_CASE("a table that changes has a new schema version") {
  // When this fails: raise schema_version() in catalogue.cpp, write db/migrations/NNN_to_NNN.sql, add a catalogue of
  // the old release to tests/db/data, and put both here.
  CHECK(schema_version() == 8);
  CHECK(current_tables_hash() == "0efe7aef2a1b73d4284ca1e9f0292bf7");
}

TEST_CASE("there is one migration from each earlier release to the next") {
  REQUIRE(embedded_migrations().size() == earlier_releases().size());
  for (std::size_t i = 0; i < earlier_releases().size(); ++i) {
    const int schema = earlier_releases()[i];
    std::array<char, 20> name{};
    std::snprintf(name.data(), name.size(), "%03d_to_%03d", schema, schema + 1);
    CHECK(embedded_migrations()[i].name == name.data());
  }
  CHECK(earlier_releases().back() + 1 == schema_version());
  CHECK(stored_releases().size() == earlier_releases().size());
}

TEST_CASE("catalogues of earlier releases are read as they are, and the file is not touched") {
  for (const fs::path& stored : stored_releases()) {
    INFO(stored);
    const Folder folder;
    unpack(stored, folder / "old.db");
    const std::string before = bytes_of(folder / "old.db");
    const Catalogue old = Catalogue::open(folder / "old.db");
    REQUIRE(!old.episodes().empty());
    for (const EpisodeSummary& episode : old.episodes()) CHECK(!old.read_episode(episode.id).frames.empty());
    if (stored.filename() != "schema7.db.gz")  // nothing was undone in it
      CHECK(std::get<std::int64_t>(old.query("SELECT count(*) FROM tries WHERE undone").rows[0][0]) > 0);
    CHECK_THROWS_WITH(old.query("SELECT colour FROM segments"), Contains("segments has episode task"));
    CHECK(bytes_of(folder / "old.db") == before);
    CHECK(files_in(folder.path()) == std::vector<std::string>{"old.db"});
  }
}

TEST_CASE("a catalogue of an earlier release that is opened to write becomes one of this release") {
  for (const fs::path& stored : stored_releases()) {
    INFO(stored);
    const Folder folder;
    unpack(stored, folder / "old.db");
    const Catalogue old = Catalogue::open(folder / "old.db");
    fs::copy(folder / "old.db", folder / "new.db");
    Catalogue::write(folder / "new.db").close();
    CHECK(files_in(folder.path()) == std::vector<std::string>{"new.db", "old.db"});  // the copy is gone
    CHECK(number(folder / "new.db", "PRAGMA user_version") == schema_version());
    CHECK(number(folder / "new.db", "SELECT count(*) FROM pragma_foreign_key_check") == 0);
    CHECK(Catalogue::open(folder / "new.db").content_hash() == old.content_hash());
    Catalogue::write(folder / "new.db").add(sample_episode("lift", "colour=red", 1), kEngine);
    Catalogue both = Catalogue::open(folder / "new.db");
    CHECK(both.episodes().size() == old.episodes().size() + 1);
    CHECK(number(folder / "new.db", "SELECT count(*) FROM pragma_integrity_check WHERE integrity_check <> 'ok'") == 0);
  }
}

TEST_CASE("views and named queries answer the same of an earlier release before it is migrated and after") {
  for (const fs::path& stored : stored_releases()) {
    INFO(stored);
    const Folder folder;
    unpack(stored, folder / "old.db");
    fs::copy(folder / "old.db", folder / "new.db");
    Catalogue::write(folder / "new.db").close();
    const Catalogue old = Catalogue::open(folder / "old.db"), now = Catalogue::open(folder / "new.db");
    for (const SqlFile& view : embedded_views()) {
      if (view.name == "visible") continue;  // counted from pictures when a catalogue is migrated
      INFO(view.name);
      std::string question = "SELECT * FROM " + view.name + " ORDER BY 1";
      for (std::size_t i = 2; i <= now.query("SELECT * FROM " + view.name, {{}, 1}).columns.size(); ++i)
        question += ", " + std::to_string(i);
      const QueryResult answer = now.query(question);
      CHECK(old.query(question).rows == answer.rows);
    }
    for (const NamedQuery& query : named_queries()) {
      INFO(query.name);
      CHECK(old.query(query.name).rows == now.query(query.name).rows);
    }
    for (const char* view : {"actions", "frames", "joints", "masks", "sensors", "steps", "transitions"})
      CHECK(now.query(std::string("SELECT * FROM ") + view, {{}, 5}).rows.size() == 5);
    if (stored.filename() == "schema5.db.gz")  // release 5 did not write them
      for (const char* view : {"preconditions", "agent_actions"})
        CHECK(now.query(std::string("SELECT * FROM ") + view).rows.empty());
    CHECK(now.query("SELECT * FROM segment_effect WHERE NOT undone AND held IS NULL").rows.empty());
    CHECK(now.query("SELECT * FROM command WHERE robot <> 0").rows.empty());
  }
}

TEST_CASE("catalogues of earlier releases are merged with those of this one") {
  const Folder folder;
  unpack(stored_releases().front(), folder / "old.db");
  const std::string before = bytes_of(folder / "old.db");
  merge(folder / "old_alone.db", {folder / "old.db"});
  CHECK(Catalogue::open(folder / "old_alone.db").content_hash() == Catalogue::open(folder / "old.db").content_hash());
  Catalogue::write(folder / "new.db").add(sample_episode("lift", "colour=red", 1), kEngine);
  const MergeResult result =
      merge(folder / "both.db", {folder / "old.db", folder / "new.db", folder / "old_alone.db"}, {.mixed = true});
  CHECK(result.files[0].added == static_cast<std::int64_t>(Catalogue::open(folder / "old.db").episodes().size()));
  CHECK((result.files[1].added == 1 && result.files[2].added == 0));
  CHECK(bytes_of(folder / "old.db") == before);
}

TEST_CASE("episodes of earlier releases are read whole, migrated or not, and replayed") {
  for (const fs::path& stored : stored_releases()) {
    INFO(stored);
    const Folder folder;
    unpack(stored, folder / "old.db");
    fs::copy(folder / "old.db", folder / "new.db");
    Catalogue::write(folder / "new.db").close();
    const Catalogue old = Catalogue::open(folder / "old.db"), now = Catalogue::open(folder / "new.db");
    for (const EpisodeSummary& episode : old.episodes()) {
      const EpisodeRecord record = old.read_episode(episode.id), migrated = now.read_episode(episode.id);
      CHECK(record.frames.size() > 10);
      CHECK(!record.labels.segments.empty());
      CHECK(record.commands.size() == migrated.commands.size());
      CHECK(record.labels.attempts.size() == migrated.labels.attempts.size());
      // An engine that moves things otherwise than the one of that release names the first frame that differs.
      CHECK(replay_episode(record) == replay_episode(migrated));
    }
  }
}

TEST_CASE("what instance masks show is counted while a catalogue is migrated") {
  const Folder folder;
  unpack(stored_releases().front(), folder / "a.db");
  Catalogue::write(folder / "a.db").close();
  const Catalogue catalogue = Catalogue::open(folder / "a.db");
  const auto shown = catalogue.query(
      "SELECT v.episode, v.frame, c.name, v.instance, v.pixels FROM mask_pixels v JOIN camera c ON c.episode = "
      "v.episode "
      "AND c.ordinal = v.camera LIMIT 50");
  REQUIRE(shown.rows.size() == 50);
  for (const auto& row : shown.rows) {
    Picture picture;
    const auto png = catalogue.read_image(std::get<std::int64_t>(row[0]), std::get<std::int64_t>(row[1]),
                                          std::get<std::string>(row[2]), "instance");
    from_png(png, PictureKind::instance, picture);
    CHECK(std::count(picture.instance.begin(), picture.instance.end(), std::get<std::int64_t>(row[3])) ==
          std::get<std::int64_t>(row[4]));
  }
}

TEST_CASE("a migration that is killed or fails leaves the old catalogue usable") {
  const Folder folder;
  unpack(stored_releases().front(), folder / "a.db");
  std::ofstream(folder / "a.db.schema5") << "a user's own copy";
  const std::string hash = Catalogue::open(folder / "a.db").content_hash();
  const int killed = in_child([&] {
    sqlite3_auto_extension(reinterpret_cast<void (*)()>(die_at_drop));
    Catalogue::write(folder / "a.db");
  });
  REQUIRE(WIFSIGNALED(killed));
  const std::vector<std::string> left = files_in(folder.path());
  REQUIRE((left.size() >= 2 && left.back().starts_with("a.db.stampede-")));
  const fs::path copy = folder / left.back() / "unfinished";  // whole
  CHECK(number(copy, "PRAGMA user_version") == 5);
  CHECK(!fs::exists(copy.string() + "-wal"));  // one file, also after it was read
  CHECK(number(folder / "a.db", "PRAGMA user_version") == 5);
  CHECK(Catalogue::open(folder / "a.db").content_hash() == hash);
  const int full = in_child([&] {
    ::signal(SIGXFSZ, SIG_IGN);
    const auto size = static_cast<rlim_t>(fs::file_size(folder / "a.db")) / 2;  // no room for the copy
    const rlimit limit{size, size};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    Catalogue::write(folder / "a.db");
  });
  CHECK((WIFEXITED(full) && WEXITSTATUS(full) == 1));  // the disk was full: an error
  CHECK(number(folder / "a.db", "PRAGMA user_version") == 5);
  CHECK(Catalogue::open(folder / "a.db").content_hash() == hash);
  Catalogue::write(folder / "a.db").close();
  CHECK(Catalogue::open(folder / "a.db").content_hash() == hash);
  CHECK(files_in(folder.path()) == std::vector<std::string>{"a.db", "a.db.schema5"});
  CHECK(bytes_of(folder / "a.db.schema5") == "a user's own copy");
}

TEST_CASE("tables of no release are refused with a cure, and nothing is changed") {
  const Folder folder;
  const auto refuse = [&](const std::string& name, const std::string& complaint, const std::string& cure) {
    const std::string before = bytes_of(folder / name);
    CHECK_THROWS_WITH(Catalogue::open(folder / name), Contains(complaint) && Contains(cure));
    CHECK_THROWS_WITH(Catalogue::write(folder / name), Contains(complaint) && Contains(cure));
    CHECK(bytes_of(folder / name) == before);
  };
  unpack(stored_releases().front(), folder / "between.db");
  change(folder / "between.db", "ALTER TABLE verdict ADD COLUMN since TEXT");
  refuse("between.db", "those of no release: it says schema 5", "read it with the build that made it (0.1.0)");
  Catalogue::write(folder / "current.db").close();
  change(folder / "current.db", "ALTER TABLE frame ADD COLUMN mood TEXT");
  refuse("current.db", "those of no release: it says schema 8", "generate the episodes again");
  Catalogue::write(folder / "future.db").close();
  change(folder / "future.db", "PRAGMA user_version = 9");
  refuse("future.db", "made by a newer version: its schema is 9", "use that version of stampede");
  Catalogue::write(folder / "ancient.db").close();
  change(folder / "ancient.db", "PRAGMA user_version = 4");
  refuse("ancient.db", "made by an older version: its schema is 4", "generate the episodes again");
}

TEST_CASE("tables and indexes of a user's own do not make a catalogue a stranger") {
  const Folder folder;
  Catalogue::write(folder / "a.db").add(sample_episode("lift", "colour=red", 1), kEngine);
  const std::string hash = Catalogue::open(folder / "a.db").content_hash();
  change(folder / "a.db", "CREATE TABLE own_scores (episode, score); CREATE INDEX own_index ON own_scores (score)");
  CHECK(Catalogue::open(folder / "a.db").content_hash() == hash);
  CHECK(Catalogue::open(folder / "a.db").query("SELECT * FROM own_scores").rows.empty());
  CHECK_NOTHROW(Catalogue::write(folder / "a.db"));
}

TEST_CASE("a catalogue without changes is opened to write without writing") {
  const Folder folder;
  Catalogue::write(folder / "a.db").close();
  const std::int64_t version = number(folder / "a.db", "PRAGMA schema_version");
  Catalogue::write(folder / "a.db").close();
  CHECK(number(folder / "a.db", "PRAGMA schema_version") == version);
  change(folder / "a.db", "DROP VIEW frames; DROP INDEX fact_by_text");
  Catalogue::write(folder / "a.db").close();
  CHECK(number(folder / "a.db", "SELECT count(*) FROM sqlite_master WHERE name IN ('frames', 'fact_by_text')") == 2);
}
