// Catalogues that nobody vouches for: what stands in their schema is compared, and never run.
#include "db/declared.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "db/embedded_sql.h"
#include "db/merge.h"
#include "db/migrations.h"
#include "db/plain_file.h"
#include "db/schema.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;
using Catch::Matchers::Contains;

namespace {

namespace fs = std::filesystem;

// A catalogue of each release, this one's last, and what lies beside them, which none of them may touch.
struct Shelf {
  Folder folder;
  std::vector<fs::path> catalogues;
  Shelf() {
    for (const fs::path& stored : stored_releases())
      unpack(stored, catalogues.emplace_back(folder / stored.stem().string()));
    Catalogue::write(catalogues.emplace_back(folder / "current.db"))
        .add(sample_episode("lift", "colour=red", 1), kEngine);
    Catalogue::write(folder / "canary.db").add(sample_episode("lift", "colour=red", 2), kEngine);
    canary = bytes_of(folder / "canary.db");
  }
  std::string canary;

  std::string canary_path() const { return (folder / "canary.db").string(); }
  void check_untouched() const {
    CHECK(bytes_of(folder / "canary.db") == canary);
    CHECK(!fs::exists(folder / "pwned"));
  }
  // Every way in refuses it with this complaint, and leaves it as it is.
  void check_refused(const fs::path& file, const std::string& complaint) const {
    INFO(file << ": " << complaint);
    const std::string before = bytes_of(file);
    CHECK_THROWS_WITH(Catalogue::open(file), Contains(complaint) && Contains("nothing in it was run"));
    CHECK_THROWS_WITH(Catalogue::write(file), Contains(complaint));
    CHECK_THROWS_WITH(merge(folder / "sum.db", {file}), Contains(complaint));
    CHECK_THROWS_WITH(merge(file, {folder / "canary.db"}), Contains(complaint));
    CHECK(!fs::exists(folder / "sum.db"));
    CHECK(bytes_of(file) == before);
    check_untouched();
  }
};

void set_declaration(const fs::path& file, const std::string& name, const std::string& sql) {
  change(file, "PRAGMA writable_schema = ON; UPDATE sqlite_master SET sql = " + sql + " WHERE name = '" + name + "'");
}

}  // namespace

TEST_CASE("declarations are compared word by word, as SQLite reads them") {
  CHECK(tokens_of("CREATE TABLE \"a\"(b  TEXT) -- c\n/* d */ STRICT") == "CREATE TABLE a ( b TEXT ) STRICT");
  CHECK(tokens_of("\"--\" INTEGER, a") == "\"--\" INTEGER , a");
  CHECK(tokens_of("[/*] b `c d` \"e\"\"f\"") == "\"/*\" b \"c d\" \"e\"\"f\"");
  CHECK(tokens_of("x'ff' 'a -- b''c' 'd") == "x'ff' 'a -- b''c' 'd");
  CHECK(tokens_of("INTEGER \"NOT\" NULL") == "INTEGER \"NOT\" NULL");  // a type of two words, and no constraint
  CHECK(tokens_of("CREATE TABLE \"action\" (\"key\")") == "CREATE TABLE action ( \"key\" )");
  CHECK(tokens_of("a /* b") == "a / * b");
  CHECK(tokens_of(std::string_view("a\0b", 3)) != tokens_of("a"));
}

TEST_CASE("migrations lead from what release 5 declared to what this one declares") {
  const sql::Database memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, ":memory:");
  for (const SqlFile& first : embedded_releases()) memory.run(first.text);
  migrate(memory, earlier_releases().front(), schema_version());
  memory.run(indexes_script());
  CHECK_NOTHROW(check_declarations(memory, "main", schema_version()));
}

TEST_CASE("SQL behind a name that looks like a comment is not run") {
  const Shelf shelf;
  for (const fs::path& file : shelf.catalogues) {
    const std::string attack =
        " INTEGER, ' || substr(sql, 21, instr(sql, 'PRIMARY KEY') - 21) || 'PRIMARY KEY (episode, "
        "ordinal)) STRICT, WITHOUT ROWID; COMMIT; ATTACH ''" +
        shelf.canary_path() + "'' AS p; DELETE FROM p.frame; DETACH p; BEGIN; /*' || char(10) || substr(sql, 21)";
    set_declaration(file, "joint", "'CREATE TABLE joint (\"--\"" + attack);
    CHECK_THROWS_AS(Catalogue::open(file), CatalogueError);
    CHECK_THROWS_AS(Catalogue::write(file), CatalogueError);
    CHECK_THROWS_AS(merge(shelf.folder / "sum.db", {file}), CatalogueError);
    shelf.check_untouched();
  }
}

TEST_CASE("names of foreign views, triggers, tables and indexes are no SQL, and refused") {
  const std::string name = "ZZ\"; COMMIT; ATTACH 'CANARY' AS p; DELETE FROM p.frame; DETACH p; BEGIN; --";
  const auto refuse = [&](const std::string& begin, const std::string& end, const std::string& complaint) {
    const Shelf shelf;
    std::string quoted = sql::quoted_name(name);
    quoted.replace(quoted.find("CANARY"), 6, shelf.canary_path());
    for (const fs::path& file : shelf.catalogues) {
      change(file, begin + " " + quoted + " " + end);
      shelf.check_refused(file, complaint);
    }
  };
  refuse("CREATE VIEW", "AS SELECT 1", "it holds the view 'ZZ\"; COMMIT");
  refuse("CREATE TRIGGER", "AFTER INSERT ON frame BEGIN DELETE FROM frame; END", "it holds the trigger 'ZZ\"; COMMIT");
  refuse("CREATE TABLE", "(a)", "has the table 'ZZ\"; COMMIT");
  refuse("CREATE INDEX", "ON frame (step)", "it holds the index 'ZZ\"; COMMIT");
}

TEST_CASE("a user's own tables are plain") {
  const Shelf shelf;
  const fs::path sound = shelf.catalogues.back(), file = shelf.folder / "a.db";
  const auto with = [&](const std::string& sql) {
    fs::copy_file(sound, file, fs::copy_options::overwrite_existing);
    change(file, sql);
  };
  for (const char* sql :
       {"CREATE TABLE own_x (a INTEGER PRIMARY KEY AUTOINCREMENT, b TEXT DEFAULT 'x' UNIQUE, c CHECK (c IN (0, 1)))",
        "CREATE TABLE \"own_ odd \"\" name\" (a, \"GENERATED\"); CREATE UNIQUE INDEX i on \"own_ odd \"\" name\" (a)",
        "CREATE TABLE own_x AS SELECT * FROM episode",
        "CREATE TABLE own_x (a INTEGER REFERENCES episode (id)) STRICT; ANALYZE"}) {
    INFO(sql);
    with(sql);
    CHECK_NOTHROW(Catalogue::open(file));
    CHECK_NOTHROW(Catalogue::write(file).add(sample_episode("lift", "colour=red", 3), kEngine));
  }
  with("CREATE TABLE own_x (a, b AS (abs(a)))");
  shelf.check_refused(file, "the table 'own_x', which computes what it shows");
  with("CREATE TABLE own_x (a, b GENERATED ALWAYS AS (abs(a)) STORED)");
  shelf.check_refused(file, "the table 'own_x', which computes what it shows");
  with("CREATE VIRTUAL TABLE own_x USING fts5(a)");
  shelf.check_refused(file, "the table 'own_x', which computes what it shows");
  with("CREATE TABLE own_x (a); CREATE TRIGGER own_t AFTER INSERT ON own_x BEGIN DELETE FROM frame; END");
  shelf.check_refused(file, "it holds the trigger 'own_t'");
  with("CREATE VIEW own_x AS SELECT 1");
  shelf.check_refused(file, "it holds the view 'own_x'");
}

TEST_CASE("tables and indexes of ours that say other things are refused") {
  const Shelf shelf;
  const fs::path sound = shelf.catalogues.back(), file = shelf.folder / "a.db";
  const auto with = [&](const std::string& name, const std::string& sql) {
    fs::copy_file(sound, file, fs::copy_options::overwrite_existing);
    set_declaration(file, name, sql);
  };
  with("frame", "replace(sql, 'INTEGER NOT NULL', 'INTEGER \"NOT\" NULL')");
  CHECK_THROWS_AS(Catalogue::open(file), CatalogueError);
  with("mask", "replace(sql, 'semantic > 0', 'semantic > abs(0)')");
  shelf.check_refused(file, "declares the table 'mask' otherwise");
  with("frame", "replace(sql, 'STRICT, WITHOUT ROWID', 'WITHOUT ROWID')");
  shelf.check_refused(file, "declares the table 'frame' otherwise");
  with("fact_hidden", "replace(sql, 'observed = 0', 'abs(observed) = 0')");
  shelf.check_refused(file, "it holds the index 'fact_hidden'");
  fs::copy_file(sound, file, fs::copy_options::overwrite_existing);
  change(file, "DROP TABLE keyframe");
  shelf.check_refused(file, "lacks the table 'keyframe'");
  fs::copy_file(sound, file, fs::copy_options::overwrite_existing);
  change(file,
         "PRAGMA writable_schema = ON; UPDATE sqlite_master SET rootpage = (SELECT rootpage FROM sqlite_master "
         "WHERE name = 'frame') WHERE name = 'keyframe'");
  CHECK_THROWS_AS(Catalogue::open(file), CatalogueError);
}

TEST_CASE("a view of our name that says other things is not asked, and made anew when the file is written") {
  const Shelf shelf;
  for (const fs::path& file : shelf.catalogues) {
    INFO(file);
    const std::string honest = Catalogue::open(file).query("SELECT min(task) FROM episodes").text(0, "min(task)");
    change(file, "DROP VIEW episodes; CREATE VIEW episodes AS SELECT 'lie' AS task, * FROM json_each('[1]')");
    {
      const Catalogue catalogue = Catalogue::open(file);
      CHECK(catalogue.query("SELECT min(task) FROM episodes").text(0, "min(task)") == honest);
      for (const char* schema : {"main", "file"})
        CHECK_THROWS_AS(catalogue.query(std::string("SELECT * FROM ") + schema + ".episodes"), Error);
    }
    Catalogue::write(file).close();
    CHECK(Catalogue::open(file).query("SELECT min(task) FROM episodes").text(0, "min(task)") == honest);
    set_declaration(file, "episodes", "'CREATE TABLE episodes (task)'");
    CHECK_THROWS_AS(Catalogue::open(file), CatalogueError);
  }
}

TEST_CASE("nothing that is asked of a catalogue reaches beyond it") {
  const Shelf shelf;
  const Catalogue catalogue = Catalogue::open(shelf.catalogues.back());
  for (const std::string& text : std::vector<std::string>{
           "ATTACH '" + shelf.canary_path() + "' AS p", "PRAGMA writable_schema = ON", "PRAGMA trusted_schema = ON",
           "PRAGMA temp_store_directory = '/'", "CREATE TEMP TRIGGER t AFTER INSERT ON frame BEGIN SELECT 1; END",
           "CREATE TEMP VIEW v AS SELECT 1", "DETACH main", "INSERT INTO sqlite_temp_master VALUES (1, 1, 1, 1, 1)"}) {
    INFO(text);
    CHECK_THROWS_AS(catalogue.query(text), Error);
  }
  CHECK(catalogue.query("SELECT * FROM pragma_table_info('episodes')").size() > 10);
  CHECK(catalogue.query("PRAGMA table_info(episodes)").size() > 10);
  shelf.check_untouched();
}

TEST_CASE("a journal that names another file is not played back") {
  const Shelf shelf;
  const fs::path file = shelf.catalogues.back();
  std::string journal("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7\xff\xff\xff\xff", 12);
  journal.resize(512);
  const std::string other = shelf.canary_path();
  journal += other + std::string(8, '\0') + std::string("\xd9\xd5\x05\xf9\x20\xa1\x63\xd7", 8);
  std::ofstream(file.string() + "-journal", std::ios::binary) << journal;
  CHECK_THROWS_WITH(Catalogue::open(file), Contains("names another file, which would be deleted"));
  CHECK_THROWS_WITH(Catalogue::write(file), Contains("names another file"));
  CHECK_THROWS_WITH(PlainFile::open(file), Contains("names another file"));
  CHECK_THROWS_WITH(merge(shelf.folder / "sum.db", {file}), Contains("names another file"));
  shelf.check_untouched();
}

TEST_CASE("data sets are plain tables, and others are refused") {
  const Folder folder;
  PlainFileWriter writer(folder / "given.db");
  writer.table("facts", {"episode", "value", "key \"x\""});
  writer.row({std::int64_t{1}, std::string("a"), 2.0});
  writer.finish();
  CHECK(PlainFile::open(folder / "given.db").query("SELECT * FROM facts").size() == 1);
  for (const char* sql :
       {"CREATE VIEW v AS SELECT 1", "CREATE TABLE t (a, b AS (abs(a)))", "CREATE TABLE t (a CHECK (a > 0))",
        "CREATE VIRTUAL TABLE t USING fts5(a)", "CREATE INDEX i ON facts (abs(value))",
        "CREATE TRIGGER t AFTER INSERT ON facts BEGIN SELECT 1; END"}) {
    INFO(sql);
    fs::copy_file(folder / "given.db", folder / "a.db", fs::copy_options::overwrite_existing);
    change(folder / "a.db", sql);
    CHECK_THROWS_WITH(PlainFile::open(folder / "a.db"), Contains("a data set has plain tables only"));
  }
}
