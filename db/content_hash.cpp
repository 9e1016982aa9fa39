// One digest of all data, whatever the ids and the order of commits. Tables are found in the schema, so that a new
// one takes part by itself.
#include "db/catalogue_impl.h"
#include "db/schema.h"
#include "engine/base/hash.h"

namespace stampede {
namespace {

// `timing` holds times of the host, `reason` what words there are, `mask_pixels` what follows from the pictures.
std::vector<Table> data_tables() {
  std::vector<Table> tables = current_tables();
  std::erase_if(tables, [](const Table& table) {
    return table.name == "timing" || table.name == "reason" || table.name == "mask_pixels";
  });
  return tables;
}

void hash_value(Hasher& hasher, sqlite3_stmt* row, int column) {
  const int type = sqlite3_column_type(row, column);
  hasher.number(static_cast<std::uint8_t>(type));
  if (type == SQLITE_INTEGER) hasher.number<std::int64_t>(sqlite3_column_int64(row, column));
  if (type == SQLITE_FLOAT) hasher.number(sqlite3_column_double(row, column));
  if (type != SQLITE_TEXT && type != SQLITE_BLOB) return;
  const void* data = sqlite3_column_blob(row, column);
  const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
  hasher.text({static_cast<const char*>(data ? data : ""), size});
}

void hash_rows(Hasher& hasher, const Table& table, sql::Statement& rows) {
  hasher.text(table.name);
  const int columns = static_cast<int>(table.columns.size());
  while (rows.step()) {
    hasher.number(std::uint8_t{1});
    for (int column = 0; column < columns; ++column) hash_value(hasher, rows.handle(), column);
  }
  hasher.number(std::uint8_t{0});
}

// One statement a table, asked once an episode.
class EpisodeHasher {
 public:
  explicit EpisodeHasher(const sql::Database& database) : tables_(data_tables()) {
    std::erase_if(tables_, [](const Table& table) { return !table.of_episode; });
    for (const Table& table : tables_)
      statements_.emplace_back(database, "SELECT " + quoted_columns(table.columns) + " FROM " + table.name + " WHERE " +
                                             (table.name == "episode" ? "id" : "episode") + " = ?1 ORDER BY " +
                                             quoted_columns(table.order));
  }
  std::string digest(std::int64_t id) {
    Hasher hasher;
    for (std::size_t i = 0; i < tables_.size(); ++i) hash_rows(hasher, tables_[i], statements_[i].start(id));
    return hasher.digest();
  }

 private:
  std::vector<Table> tables_;
  std::vector<sql::Statement> statements_;
};

}  // namespace

ContentHashes Catalogue::content_hashes() const {
  const sql::Database& database = impl_->database;
  ContentHashes hashes;
  Hasher hasher;
  for (const Table& table : data_tables()) {
    if (table.of_episode) continue;
    sql::Statement rows(database, "SELECT " + quoted_columns(table.columns) + " FROM " + table.name + " ORDER BY " +
                                      quoted_columns(table.order));
    hash_rows(hasher, table, rows.start());
  }
  EpisodeHasher episodes(database);
  sql::Statement ids(database, "SELECT id FROM episode ORDER BY task, variation, seed, key");
  for (ids.start(); ids.step();) {
    std::int64_t id = 0;
    ids.read(id);
    hasher.text(hashes.episodes[id] = episodes.digest(id));
  }
  hashes.whole = hasher.digest();
  return hashes;
}

std::string Catalogue::episode_hash(std::int64_t id) const { return EpisodeHasher(impl_->database).digest(id); }

}  // namespace stampede
