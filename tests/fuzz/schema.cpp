#include "tests/fuzz/schema.h"

#include <sqlite3.h>

#include <array>
#include <fstream>
#include <memory>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "db/embedded_sql.h"
#include "db/merge.h"
#include "db/plain_file.h"
#include "tests/db/sample_episode.h"

namespace stampede::fuzz {
namespace fs = std::filesystem;
namespace {

// What attacks are made of.
constexpr std::array kPieces{"\"",
                             "'",
                             "--",
                             "/*",
                             "*/",
                             ";",
                             "`",
                             "[",
                             "]",
                             "(",
                             ")",
                             ",",
                             "\n",
                             "\"--\" INTEGER, ",
                             "\"\"",
                             "; COMMIT; ATTACH 'canary.db' AS p; DELETE FROM p.frame; DETACH p; BEGIN; ",
                             "; ATTACH 'pwned.db' AS q; CREATE TABLE q.t (a); --",
                             " AS (load_extension('x'))",
                             " GENERATED ALWAYS AS (abs(1))",
                             " CHECK (load_extension('x'))",
                             " DEFAULT (random())",
                             " AS SELECT * FROM frame",
                             "CREATE TRIGGER t AFTER INSERT ON frame BEGIN DELETE FROM frame; END",
                             "CREATE TEMP TRIGGER t AFTER INSERT ON frame BEGIN DELETE FROM frame; END",
                             "CREATE VIRTUAL TABLE own_v USING fts5(a)",
                             "CREATE VIEW episodes AS SELECT * FROM pragma_table_info('frame')",
                             "CREATE TABLE own_x (a, b)",
                             "CREATE INDEX own_i ON own_x (a)",
                             "own_",
                             "sqlite_",
                             "WITHOUT ROWID",
                             "STRICT",
                             "NOT NULL",
                             "\"NOT\" NULL"};
constexpr std::array kColumns{"type", "name", "tbl_name", "sql", "rootpage"};
constexpr std::array kKinds{"table", "index", "view", "trigger"};

struct Stock {
  std::vector<std::string> catalogues;  // bytes, of each release
  std::string canary;
};

const Stock& stock(const fs::path& folder) {
  static const Stock made = [&] {
    Stock stock;
    const fs::path file = folder / "made.db";
    const auto take = [&](std::string& bytes) {
      bytes = test::bytes_of(file);
      fs::remove(file);
    };
    for (const fs::path& stored : test::stored_releases()) {
      test::unpack(stored, file);
      take(stock.catalogues.emplace_back());
    }
    for (const int seed : {1, 2}) {
      EpisodeRecord episode = test::sample_episode("lift", "colour=red", seed);
      episode.images = test::sample_images(episode, {0, 2}, {"rgb", "depth"}, 60);
      Catalogue::write(file).add(episode, test::kEngine);
      take(seed == 1 ? stock.catalogues.emplace_back() : stock.canary);
    }
    return stock;
  }();
  return made;
}

class Changes {
 public:
  explicit Changes(std::string_view bytes) : rest_(bytes) {}
  bool empty() const { return rest_.empty(); }
  std::size_t number(std::size_t below) {
    std::size_t value = 0;
    for (int i = 0; i < 2 && !rest_.empty(); ++i, rest_.remove_prefix(1))
      value = value * 256 + static_cast<unsigned char>(rest_.front());
    return value % below;
  }
  std::string text() {
    std::string text;
    for (std::size_t pieces = 1 + number(3); pieces > 0; --pieces) {
      const std::size_t piece = number(kPieces.size() + 4);
      if (piece < kPieces.size()) {
        text += kPieces[piece];
      } else {
        const std::string_view taken = rest_.substr(0, number(8));
        text += taken;
        rest_.remove_prefix(taken.size());
      }
    }
    return text;
  }

 private:
  std::string_view rest_;
};

class RawDatabase {
 public:
  explicit RawDatabase(const fs::path& file) {
    sqlite3_open(file.c_str(), &handle_);
    sqlite3_limit(handle_, SQLITE_LIMIT_ATTACHED, 0);  // who makes it must not do what is looked for
    run("PRAGMA journal_mode = MEMORY; PRAGMA synchronous = OFF; PRAGMA writable_schema = ON; BEGIN");
  }
  ~RawDatabase() { sqlite3_close(handle_); }
  RawDatabase(const RawDatabase&) = delete;
  RawDatabase& operator=(const RawDatabase&) = delete;
  void run(const std::string& sql, const std::vector<std::string>& values = {}) {
    if (values.empty()) return void(sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr));
    sqlite3_stmt* statement = nullptr;
    sqlite3_prepare_v2(handle_, sql.c_str(), -1, &statement, nullptr);
    int place = 0;
    for (const std::string& value : values)
      sqlite3_bind_text(statement, ++place, value.data(), static_cast<int>(value.size()), SQLITE_STATIC);
    sqlite3_step(statement);  // what SQLite itself refuses stays as it was
    sqlite3_finalize(statement);
  }

 private:
  sqlite3* handle_ = nullptr;
};

void change_schema(RawDatabase& database, Changes& front) {
  const std::string row = " WHERE rowid = " + std::to_string(1 + front.number(110));
  const std::string column = kColumns[front.number(kColumns.size())];
  switch (front.number(6)) {
    case 0:  // into what is there
      return database.run(
          "UPDATE sqlite_master SET sql = substr(sql, 1, CAST(?1 AS INTEGER)) || ?2 || substr(sql, "
          "CAST(?1 AS INTEGER) + 1)" +
              row,
          {std::to_string(front.number(600)), front.text()});
    case 1:  // in the place of something
      return database.run("UPDATE sqlite_master SET " + column + " = ?1" + row, {front.text()});
    case 2:
      return database.run("UPDATE sqlite_master SET rootpage = " + std::to_string(front.number(300)) + row);
    case 3:  // something new
      return database.run(
          "INSERT INTO sqlite_master (type, name, tbl_name, rootpage, sql) VALUES (?1, ?2, ?2, CAST(?3 AS INTEGER), "
          "?4)",
          {kKinds[front.number(kKinds.size())], front.text(), std::to_string(front.number(40)), front.text()});
    case 4:
      return database.run("DELETE FROM sqlite_master" + row);
    default:  // as somebody could without writing into it by hand
      return database.run(front.text());
  }
}

template <typename Work>
void tolerated(const Work& work) {
  try {
    work();
  } catch (const Error&) {
  }
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename());
  return names;
}

// An eighth of the views and one way of reading the episodes: which, says `asked`.
void read(const fs::path& file, std::size_t asked) {
  const Catalogue catalogue = Catalogue::open(file);
  std::size_t number = asked;
  for (const SqlFile& view : embedded_views())
    if (number++ % 8 == 0) tolerated([&] { (void)catalogue.query("SELECT * FROM " + view.name, {{}, 2}); });
  tolerated([&] { (void)catalogue.query("SELECT * FROM main.episodes", {{}, 2}); });
  for (const EpisodeSummary& episode : catalogue.episodes())
    tolerated([&] {
      if (asked / 8 % 3 == 0) (void)catalogue.read_episode(episode.id);
      if (asked / 8 % 3 == 1) (void)catalogue.read_arrays(episode.id);
      if (asked / 8 % 3 == 2) (void)catalogue.images(episode.id);
    });
}

}  // namespace

void use_altered_schema(const fs::path& folder, std::string_view changes) {
  const Stock& all = stock(folder);
  const fs::path file = folder / "altered.db", canary = folder / "canary.db", sum = folder / "sum.db";
  for (const std::string& name : names_in(folder)) fs::remove_all(folder / name);
  std::ofstream(canary, std::ios::binary) << all.canary;
  Changes front(changes);
  std::ofstream(file, std::ios::binary) << all.catalogues[front.number(all.catalogues.size())];
  const bool writes = front.number(16) == 0;
  const std::size_t asked = front.number(24);
  {
    RawDatabase database(file);
    while (!front.empty()) change_schema(database, front);
    database.run("COMMIT");
  }
  fs::current_path(folder);  // where SQL that names a file would make it
  const auto is_as_it_was = [&](const std::set<std::string>& expected) {
    for (const std::string& name : names_in(folder))
      if (!expected.contains(name)) throw std::logic_error("the file " + name + " was made");
    if (test::bytes_of(canary) != all.canary) throw std::logic_error("the catalogue beside it was changed");
  };
  const std::string before = test::bytes_of(file);
  tolerated([&] { read(file, asked); });
  tolerated([&] { (void)PlainFile::open(file); });
  is_as_it_was({"altered.db", "canary.db"});
  if (test::bytes_of(file) != before) throw std::logic_error("reading changed the file");
  if (!writes) return;
  tolerated([&] { merge(sum, {file}); });
  is_as_it_was({"altered.db", "canary.db", "sum.db"});
  tolerated([&] { Catalogue::write(file).close(); });
  tolerated([&] { merge(file, {canary}); });
  // SQLite keeps the log of a file that is too damaged to be written.
  is_as_it_was({"altered.db", "altered.db-shm", "altered.db-wal", "canary.db", "sum.db"});
}

}  // namespace stampede::fuzz
