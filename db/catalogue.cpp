#include "db/catalogue.h"

#include <sys/stat.h>
#include <unistd.h>

#include "db/catalogue_impl.h"
#include "db/embedded_sql.h"
#include "db/episode_writer.h"

namespace stampede {

void roll_back(const sql::Database& database) {
  if (!sqlite3_get_autocommit(database.handle()))
    sqlite3_exec(database.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

namespace {

namespace fs = std::filesystem;

enum class Content { nothing, catalogue };

// Looks before anything is changed. Throws CatalogueError for every file that is not ours to use.
Content inspect(const sql::Database& database) {
  const std::int64_t id = database.number("PRAGMA application_id");
  const std::int64_t version = database.number("PRAGMA user_version");
  const std::int64_t tables = database.number("SELECT count(*) FROM sqlite_master");
  if (id == 0 && version == 0 && tables == 0) return Content::nothing;
  if (id != kApplicationId)
    throw CatalogueError(database.path(), "this database belongs to another application",
                         "name a catalogue, or another file to write to");
  const std::string versions =
      "its schema is " + std::to_string(version) + ", this program knows " + std::to_string(schema_version());
  if (version > schema_version())
    throw CatalogueError(database.path(), "this catalogue was made by a newer version: " + versions,
                         "use that version of stampede, or generate the episodes again with this one");
  if (version < schema_version())
    throw CatalogueError(database.path(), "this catalogue was made by an older version: " + versions,
                         "generate the episodes again with this one");
  return Content::catalogue;
}

std::string schema_script() {
  std::string script = "BEGIN IMMEDIATE;\n";
  for (const SqlFile& file : embedded_schema()) script += file.text;
  script += "PRAGMA application_id = " + std::to_string(kApplicationId) + ";\n";
  script += "PRAGMA user_version = " + std::to_string(schema_version()) + ";\nCOMMIT;\n";
  return script;
}

// All views of the file go; those of this build come.
std::string views_script(const sql::Database& database) {
  std::string script = "BEGIN IMMEDIATE;\n";
  sql::Statement views(database, "SELECT name FROM sqlite_master WHERE type = 'view' ORDER BY name");
  for (views.start(); views.step();) {
    std::string name;
    views.read(name);
    script += "DROP VIEW \"" + name + "\";\n";
  }
  for (const SqlFile& file : embedded_views()) script += file.text;
  return script + "COMMIT;\n";
}

// The same views for a file that may not be written: temporary ones win over those of the file.
std::string temporary_views_script() {
  std::string script = "PRAGMA temp_store = MEMORY;\nBEGIN;\n";
  for (const SqlFile& file : embedded_views()) {
    const std::string head = "CREATE VIEW ";
    script += "CREATE TEMP VIEW " + file.text.substr(head.size());
  }
  return script + "COMMIT;\n";
}

// Runs a script that is one transaction; a failure leaves nothing of it.
void transact(const sql::Database& database, const std::string& script) {
  try {
    database.run(script);
  } catch (...) {
    roll_back(database);
    throw;
  }
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

void check_path(const fs::path& path, bool writing) {
  std::error_code ignored;
  if (path == ":memory:")
    throw CatalogueError(path.string(), "a catalogue is a file, and is never kept in memory",
                         "name a file, such as demos.db");
  if (fs::is_directory(path, ignored))
    throw CatalogueError(path.string(), "this is a folder", "name a file, such as demos.db");
  if (!writing && !fs::exists(path, ignored))
    throw CatalogueError(path.string(), "there is no such file", "name a catalogue that `stampede run --out` has made");
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  if (writing && !fs::is_directory(folder, ignored))
    throw CatalogueError(path.string(), "the folder " + folder.string() + " does not exist", "make it first");
}

// A file in WAL mode wants to write beside itself even to be read. Where that is refused and there is no log, the
// file holds everything and nobody can change it.
sql::Database open_to_read(const fs::path& path) {
  const std::string shown = path.string();
  const int flags = SQLITE_OPEN_READONLY | SQLITE_OPEN_URI;
  sql::Database database(uri_of(path), flags, shown);
  const int code = sqlite3_exec(database.handle(), "SELECT count(*) FROM sqlite_master", nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) return database;
  const int kind = code & 0xff;
  if (kind != SQLITE_CANTOPEN && kind != SQLITE_READONLY) database.fail(code);
  if (::access(shown.c_str(), R_OK) != 0)
    throw CatalogueError(shown, "this file may not be read", "change its permissions, or copy it");
  if (has_log(path))
    throw CatalogueError(shown, "a run that was killed left pages in " + shown + "-wal, and this folder is read-only",
                         "copy the file together with its -wal to a folder that you may write in");
  return sql::Database(uri_of(path) + "?immutable=1", flags, shown);
}

}  // namespace

int schema_version() {
  return std::stoi(embedded_schema().back().name);  // 005_images
}

Catalogue::Impl::Impl() = default;
Catalogue::Impl::~Impl() = default;

Catalogue::Catalogue(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;

Catalogue Catalogue::open(const fs::path& path) {
  check_path(path, false);
  auto impl = std::make_unique<Impl>();
  impl->database = open_to_read(path);
  if (inspect(impl->database) == Content::nothing)
    throw CatalogueError(path.string(), "this file is empty: no run has written to it",
                         "run some tasks first: `stampede run TASK --out " + path.string() + "`");
  impl->database.run(temporary_views_script());
  return Catalogue(std::move(impl));
}

Catalogue Catalogue::write(const fs::path& path) {
  check_path(path, true);
  auto impl = std::make_unique<Impl>();
  sql::Database& database = impl->database;
  database = sql::Database(fs::absolute(path).string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, path.string());
  const Content content = inspect(database);
  if (sqlite3_db_readonly(database.handle(), "main")) database.fail(SQLITE_READONLY);
  database.run("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL; PRAGMA cache_size = -65536;");
  if (content == Content::nothing) transact(database, schema_script());
  transact(database, views_script(database));
  database.run("PRAGMA foreign_keys = ON");
  impl->writable = true;
  return Catalogue(std::move(impl));
}

Catalogue::~Catalogue() {
  try {
    close();
  } catch (...) {  // the log stays beside the file; the next to open it carries on
  }
}

void Catalogue::close() {
  if (!impl_ || !impl_->database) return;
  const std::unique_ptr<Impl> impl = std::move(impl_);  // closed whatever happens below
  impl->writer.reset();
  if (!impl->writable) return;
  sqlite3_busy_timeout(impl->database.handle(), 0);  // a reader keeps the file in WAL mode: that is no fault
  sqlite3_exec(impl->database.handle(), "PRAGMA optimize", nullptr, nullptr, nullptr);
  const int code =
      sqlite3_wal_checkpoint_v2(impl->database.handle(), nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) return;
  if (code != SQLITE_OK) impl->database.fail(code);
  sqlite3_exec(impl->database.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
}

std::int64_t Catalogue::add(const EpisodeRecord& episode, const EngineInfo& engine) {
  check_record(episode);
  const sql::Database& database = impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  if (!impl_->writer) impl_->writer = std::make_unique<EpisodeWriter>(database);
  try {
    database.run("BEGIN IMMEDIATE");
    if (find(episode.key))
      throw CatalogueError(database.path(), "an episode with the key " + episode.key + " is already there",
                           "its task, variation, seed and options are the same: nothing needs to be added");
    const std::int64_t id = database.number("SELECT coalesce(max(id), 0) + 1 FROM episode");
    impl_->writer->write(id, episode, engine);
    database.run("COMMIT");
    return id;
  } catch (...) {
    roll_back(database);
    throw;
  }
}

std::optional<std::int64_t> Catalogue::find(std::string_view key) const {
  sql::Statement statement(impl_->database, "SELECT id FROM episode WHERE key = ?1");
  if (!statement.start(key).step()) return std::nullopt;
  std::int64_t id = 0;
  statement.read(id);
  return id;
}

std::vector<EpisodeSummary> Catalogue::episodes() const {
  std::vector<EpisodeSummary> list;
  sql::Statement statement(impl_->database,
                           "SELECT id, key, task, coalesce(variation, ''), coalesce(seed, 0), outcome, reason, frames, "
                           "duration_s FROM episode ORDER BY id");
  for (statement.start(); statement.step();) {
    EpisodeSummary& e = list.emplace_back();
    std::string outcome, reason;
    statement.read(e.id, e.key, e.task, e.variation, e.seed, outcome, reason, e.frames, e.duration_s);
    e.outcome = outcome == "success" ? Outcome::success : Outcome::failure;
    e.reason = reason_from(reason).value_or(Reason::none);
  }
  return list;
}

}  // namespace stampede
