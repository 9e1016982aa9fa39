#include "db/catalogue.h"

#include "db/catalogue_impl.h"
#include "db/episode_reader.h"
#include "db/episode_writer.h"

namespace stampede {

void roll_back(const sql::Database& database) {
  if (!sqlite3_get_autocommit(database.handle()))
    sqlite3_exec(database.handle(), "ROLLBACK", nullptr, nullptr, nullptr);
}

int schema_version() { return 8; }  // raised with every change of a table; see db/README.md

Catalogue::Impl::Impl() = default;
Catalogue::Impl::~Impl() = default;

Catalogue::Catalogue(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Catalogue::Catalogue(Catalogue&&) noexcept = default;
Catalogue& Catalogue::operator=(Catalogue&&) noexcept = default;

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
  // What the planner of questions knows about sizes; a sample of each index is enough.
  if (sqlite3_total_changes(impl->database.handle()) > 0)
    sqlite3_exec(impl->database.handle(), "PRAGMA analysis_limit = 1000; ANALYZE", nullptr, nullptr, nullptr);
  const int code =
      sqlite3_wal_checkpoint_v2(impl->database.handle(), nullptr, SQLITE_CHECKPOINT_TRUNCATE, nullptr, nullptr);
  if (code == SQLITE_BUSY || code == SQLITE_LOCKED) return;
  if (code != SQLITE_OK) impl->database.fail(code);
  sqlite3_exec(impl->database.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
}

std::int64_t Catalogue::add(const EpisodeRecord& episode, const EngineInfo& engine) {
  if (const auto id = add_if_new(episode, engine)) return *id;
  throw CatalogueError(impl_->database.path(), "an episode with the key " + episode.made.key + " is already there",
                       "its task, variation, seed and options are the same: nothing needs to be added");
}

std::optional<std::int64_t> Catalogue::add_if_new(const EpisodeRecord& episode, const EngineInfo& engine) {
  return add_if_new(episode, engine, {});
}

std::optional<std::int64_t> Catalogue::add_if_new(const EpisodeRecord& episode, const EngineInfo& engine,
                                                  const std::function<std::string()>& key) {
  check_record(episode);
  const sql::Database& database = impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  if (!impl_->writer) impl_->writer = std::make_unique<EpisodeWriter>(database);
  try {
    database.run("BEGIN IMMEDIATE");
    bool there = find(episode.made.key).has_value();
    const std::int64_t id = database.number("SELECT coalesce(max(id), 0) + 1 FROM episode");
    if (!there) impl_->writer->write(id, episode, engine);
    if (!there && key) {
      const std::string final_key = key();
      there = find(final_key).has_value();
      if (!there) sql::Statement(database, "UPDATE episode SET key = ?2 WHERE id = ?1").run(id, final_key);
    }
    database.run(there ? "ROLLBACK" : "COMMIT");
    return there ? std::nullopt : std::optional(id);
  } catch (...) {
    roll_back(database);
    throw;
  }
}

void Catalogue::set_labels(std::int64_t id, const EpisodeRecord& labelled) {
  const sql::Database& database = impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  check_record(labelled);
  if (!impl_->writer) impl_->writer = std::make_unique<EpisodeWriter>(database);
  try {
    database.run("BEGIN IMMEDIATE");
    impl_->writer->set_labels(id, labelled);
    database.run("COMMIT");
  } catch (...) {
    roll_back(database);
    throw;
  }
}

std::vector<std::string> Catalogue::keys_after(std::int64_t& last_id) const {
  sql::Statement statement(impl_->database, "SELECT id, key FROM episode WHERE id > ?1 ORDER BY id");
  std::vector<std::string> keys;
  for (statement.start(last_id); statement.step();) statement.read(last_id, keys.emplace_back());
  return keys;
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
                           "SELECT id, key, task, coalesce(variation, ''), coalesce(seed, 0), source = 'real', "
                           "engine_run, outcome, reason, frames, duration_s FROM episode ORDER BY id");
  for (statement.start(); statement.step();) {
    EpisodeSummary& e = list.emplace_back();
    std::string outcome, reason;
    statement.read(e.id, e.key, e.task, e.variation, e.seed, e.real, e.run, outcome, reason, e.frames, e.duration_s);
    e.outcome = known_word(impl_->database, "outcome", outcome, outcome_from(outcome));
    e.reason = known_word(impl_->database, "reason", reason, reason_from(reason));
  }
  return list;
}

}  // namespace stampede
