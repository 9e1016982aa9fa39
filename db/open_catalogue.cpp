// Opening a catalogue: whose file it is, of which release, and what must be done before it serves.
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <fstream>
#include <optional>
#include <thread>

#include "db/catalogue.h"
#include "db/catalogue_impl.h"
#include "db/declared.h"
#include "db/episode_writer.h"
#include "db/frame_labels.h"
#include "db/functions.h"
#include "db/migrations.h"
#include "db/schema.h"
#include "engine/base/reason.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAgain = "generate the episodes again with this one";

struct Content {
  int schema = 0;  // 0: nothing is in the file
  bool empty() const { return schema == 0; }
  bool older() const { return schema != 0 && schema != schema_version(); }
};

// Looks before anything is changed. Throws CatalogueError for every file that is not ours to use. Call it within a
// transaction: another run may be making the tables.
Content inspect(const sql::Database& database) {
  const std::int64_t id = database.number("PRAGMA application_id");
  const std::int64_t version = database.number("PRAGMA user_version");
  const std::int64_t tables = database.number("SELECT count(*) FROM sqlite_master");
  if (id == 0 && version == 0 && tables == 0) return {};
  if (id != kApplicationId)
    throw CatalogueError(database.path(), "this database belongs to another application",
                         "name a catalogue, or another file to write to");
  const std::string versions =
      "its schema is " + std::to_string(version) + ", this program knows " + std::to_string(schema_version());
  if (version > schema_version())
    throw CatalogueError(database.path(), "this catalogue was made by a newer version: " + versions,
                         std::string("use that version of stampede, or ") + kAgain);
  const int oldest = earlier_releases().front();
  if (version < oldest)
    throw CatalogueError(database.path(),
                         "this catalogue was made by an older version: " + versions + " and those from " +
                             std::to_string(oldest) + " up",
                         kAgain);
  check_declarations(database, "main", static_cast<int>(version));
  return {static_cast<int>(version)};
}

std::string uri_of(const fs::path& path) {
  std::string uri = "file:";
  for (const char c : fs::absolute(path).string()) {
    if (c == '?' || c == '#' || c == '%') {
      uri += c == '?' ? "%3f" : c == '#' ? "%23" : "%25";
    } else {
      uri += c;
    }
  }
  return uri;
}

bool has_log(const fs::path& path) {  // pages that are not in the file itself yet
  struct stat status {};
  return ::stat((path.string() + "-wal").c_str(), &status) == 0 && status.st_size > 0;
}

// It was not closed: what was written last is in a log beside it, or in nothing.
bool expects_log(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, 20> header{};
  return file.read(header.data(), header.size()) && header[18] == 2;
}

[[noreturn]] void refuse_empty(const fs::path& path) {
  const std::string file = path.string();
  if (expects_log(path))
    throw CatalogueError(
        file,
        "this file holds nothing by itself: what a run wrote that was killed, or still runs, is in " + file +
            "-wal, which is not beside it",
        "move or copy both files together, or copy where both lie: `stampede merge copy.db " + file + "`");
  throw CatalogueError(file, "this file is empty: no run has written to it",
                       "run some tasks first: `stampede run TASK --out " + file + "`; if it was moved, its " + file +
                           "-wal belongs beside it");
}

void check_path(const fs::path& path, bool writing) {
  std::error_code ignored;
  if (path == ":memory:")
    throw CatalogueError(path.string(), "a catalogue is a file, and is never kept in memory",
                         "name a file, such as demos.db");
  if (fs::is_directory(path, ignored))
    throw CatalogueError(path.string(), "this is a folder", "name a file, such as demos.db");
  if (!writing && !fs::exists(path, ignored))
    throw CatalogueError(path.string(), "there is no such file", "name a catalogue that `stampede run --out` has made");
  if (fs::exists(path, ignored) && !fs::is_regular_file(path, ignored))  // a pipe would be waited for without end
    throw CatalogueError(path.string(), "this is a pipe or a device, and no file", "name a file, such as demos.db");
  sql::check_journal(path.string());
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (writing && !fs::is_directory(folder, ignored))
    throw CatalogueError(path.string(), "the folder " + folder.string() + " does not exist", "make it first");
}

// What a killed writer left half done.
void undo(const fs::path& path) {
  const std::string shown = path.string();
  sql::Database database(uri_of(path) + "?mode=rw", SQLITE_OPEN_READWRITE | SQLITE_OPEN_URI, shown);
  const int code = sqlite3_exec(database.handle(), "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) return;
  const int kind = code & 0xff;
  if (kind != SQLITE_CANTOPEN && kind != SQLITE_READONLY) database.fail(code);
  throw CatalogueError(shown, "an import that was killed is half in it, and it may not be written to",
                       "copy the file together with its -journal to a folder that you may write in");
}

struct ReadFile {
  sql::Database database;
  std::string uri;
};

constexpr int kReading = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;

// A file in WAL mode wants to write beside itself even to be read. Where that is refused and there is no log, the
// file holds everything and nobody can change it.
ReadFile open_to_read(const fs::path& path) {
  const std::string shown = path.string(), uri = uri_of(path) + "?mode=ro";
  sql::Database database(uri, kReading, shown);
  const int code = sqlite3_exec(database.handle(), "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) return {std::move(database), uri};
  if (code == SQLITE_READONLY_ROLLBACK) {
    undo(path);
    return open_to_read(path);
  }
  const int kind = code & 0xff;
  if (kind != SQLITE_CANTOPEN && kind != SQLITE_READONLY) database.fail(code);
  if (::access(shown.c_str(), R_OK) != 0)
    throw CatalogueError(shown, "this file may not be read", "change its permissions, or copy it");
  if (has_log(path))
    throw CatalogueError(shown, "a run that was killed left pages in " + shown + "-wal, and this folder is read-only",
                         "copy the file together with its -wal to a folder that you may write in");
  const std::string immutable = uri_of(path) + "?immutable=1";
  return {sql::Database(immutable, kReading, shown), immutable};
}

// Two runs may open the same new file at once: SQLite does not wait while the mode changes.
void use_log(const sql::Database& database) {
  for (int tries = 0;; ++tries) {
    const int code = sqlite3_exec(database.handle(), "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
    if (code == SQLITE_OK) break;
    if (((code & 0xff) != SQLITE_BUSY && (code & 0xff) != SQLITE_LOCKED) || tries == 200) database.fail(code);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  // Checkpoints are for others to read quickly, and copy what has changed often only once when they are rare.
  database.run("PRAGMA synchronous = NORMAL; PRAGMA cache_size = -65536; PRAGMA wal_autocheckpoint = 4000;");
}

// Not while others have the file open: then it keeps its log.
void use_undo_file(const sql::Database& database) {
  sqlite3_busy_timeout(database.handle(), 0);
  const int code = sqlite3_exec(database.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  sqlite3_busy_timeout(database.handle(), sql::kBusyTimeoutMs);
  if (code == SQLITE_OK)
    database.run("PRAGMA synchronous = FULL");
  else if ((code & 0xff) != SQLITE_BUSY && (code & 0xff) != SQLITE_LOCKED)
    database.fail(code);
}

void add_reasons(const sql::Database& database) {
  sql::Statement reason(database, "INSERT INTO reason (name) VALUES (?1) ON CONFLICT DO NOTHING");
  for (const Reason one : all_reasons()) reason.run(to_string(one));
}

Content inspect_alone(const sql::Database& database) {
  database.run("BEGIN");
  const Content content = inspect(database);
  database.run("COMMIT");
  return content;
}

// One transaction makes what is missing: tables, the migration of an older file, views and indexes. Another run may
// have done it meanwhile, so all is asked again inside.
void make_ready(const sql::Database& database, const fs::path& path) {
  std::optional<KeptCopy> copy;
  try {
    database.run("BEGIN IMMEDIATE");
    const Content content = inspect(database);
    if (content.older()) copy.emplace(path);
    const bool stale = content.empty() || content.older() || !has_current_views(database);
    if (content.empty()) database.run(schema_script());
    if (content.older()) {
      database.run(drop_views_script());
      migrate(database, content.schema, schema_version());
    }
    add_reasons(database);
    if (stale) database.run(views_script());
    database.run("COMMIT");
  } catch (...) {
    roll_back(database);
    throw;
  }
}

// One file: every episode is its own, by its own number.
void add_own_origin(const sql::Database& database) {
  sql::add_origins(database.handle(), [file = database.path()](std::int64_t episode) -> std::optional<sql::Origin> {
    return sql::Origin{file, episode};
  });
}

}  // namespace

Catalogue Catalogue::open(const fs::path& path) {
  check_path(path, false);
  auto impl = std::make_unique<Impl>();
  ReadFile file = open_to_read(path);
  const Content content = inspect_alone(file.database);
  if (content.empty()) refuse_empty(path);
  if (content.older()) {
    impl->uncounted = content.schema == 5;
    file.database.close();
    file.database = migrated_to_read(file.uri, kReading, path.string(), content.schema);
  }
  impl->database = std::move(file.database);
  impl->database.run("PRAGMA cache_size = -65536");  // 64 MiB: joins come back to the same pages
  impl->database.run(temporary_views_script());
  add_frame_labels(impl->database);
  add_own_origin(impl->database);
  return Catalogue(std::move(impl));
}

bool Catalogue::is_new(const fs::path& path) {
  std::error_code ignored;
  if (!fs::exists(path, ignored) || (fs::is_regular_file(path, ignored) && fs::file_size(path, ignored) == 0))
    return true;
  check_path(path, false);
  return inspect_alone(open_to_read(path).database).empty();
}

Catalogue Catalogue::write(const fs::path& path, Journal journal) {
  check_path(path, true);
  auto impl = std::make_unique<Impl>();
  sql::Database& database = impl->database;
  database = sql::Database(fs::absolute(path).string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, path.string());
  inspect_alone(database);
  if (sqlite3_db_readonly(database.handle(), "main")) database.fail(SQLITE_READONLY);
  use_log(database);
  make_ready(database, path);
  if (journal == Journal::in_place) use_undo_file(database);
  database.run("PRAGMA foreign_keys = ON");
  database.run(temporary_views_script());
  add_frame_labels(database);
  add_own_origin(database);
  impl->writable = true;
  return Catalogue(std::move(impl));
}

}  // namespace stampede
