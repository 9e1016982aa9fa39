#include "db/merge.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "db/catalogue.h"
#include "db/catalogue_impl.h"
#include "db/count_visible.h"
#include "db/schema.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kInATransaction = 32;

struct Source {
  explicit Source(const fs::path& file) : path(file), catalogue(Catalogue::open(file)) {}
  fs::path path;
  Catalogue catalogue;
};

std::string named(const EpisodeSummary& episode) {
  std::string text = episode.task;
  if (!episode.variation.empty()) text.append(" ").append(episode.variation);
  return text + " seed " + std::to_string(episode.seed) + " (key " + episode.key.substr(0, 8) + "…)";
}

// Who has a key: the first file that does.
struct Owner {
  const Catalogue* catalogue = nullptr;
  std::string path;
  std::int64_t id = 0;
};

// What each file adds, and whether all agree.
class KnownKeys {
 public:
  void own(const Catalogue& catalogue, const fs::path& path) {
    for (const EpisodeSummary& episode : catalogue.episodes())
      owners_.emplace(episode.key, Owner{&catalogue, path.string(), episode.id});
  }
  // The ids of what nobody has yet.
  std::vector<std::int64_t> add(const Catalogue& catalogue, const fs::path& path, std::int64_t& existing) {
    std::vector<std::int64_t> fresh;
    for (const EpisodeSummary& episode : catalogue.episodes()) {
      const auto [owner, is_new] = owners_.emplace(episode.key, Owner{&catalogue, path.string(), episode.id});
      if (is_new) {
        fresh.push_back(episode.id);
        continue;
      }
      const Owner& other = owner->second;
      if (other.catalogue->episode_hash(other.id) != catalogue.episode_hash(episode.id))
        throw CatalogueError(path.string(),
                             "episode " + std::to_string(episode.id) + ", " + named(episode) + ", is in " + other.path +
                                 " too (episode " + std::to_string(other.id) + "), with other content",
                             "they were made by different builds, or one has pictures that the other lacks: leave one "
                             "of the two files out, or make the episode again");
      ++existing;
    }
    return fresh;
  }

 private:
  std::map<std::string, Owner> owners_;
};

// Copies rows of a table between two files, value by value: neither sees the other.
class TableCopier {
 public:
  TableCopier(const sql::Database& from, const sql::Database& to, const Table& table) {
    const std::string columns = joined(table.columns);
    std::string read = "SELECT " + columns + " FROM " + table.name, write = "INSERT INTO main." + table.name + " (";
    if (table.of_episode) {
      const std::string number = table.name == "episode" ? "id" : "episode";
      read.append(" WHERE ").append(number).append(" = ?1");
      write.append(number).append(", ");
    }
    write.append(columns).append(") VALUES (").append(table.of_episode ? "?1" : "?");
    for (std::size_t i = table.of_episode ? 0 : 1; i < table.columns.size(); ++i) write += ", ?";
    rows_ = sql::Statement(from, read, true);
    write_ = sql::Statement(to, write.append(table.of_episode ? ")" : ") ON CONFLICT DO NOTHING"), true);
    columns_ = static_cast<int>(table.columns.size());
  }
  void copy_episode(std::int64_t there, std::int64_t here) {
    for (rows_.start(there); rows_.step();) put(write_.start(here), 1);
  }
  void copy_shared() {
    for (rows_.start(); rows_.step();) put(write_.start(), 0);
  }

 private:
  void put(sql::Statement& row, int first) {
    for (int i = 0; i < columns_; ++i)
      sqlite3_bind_value(row.handle(), first + i + 1, sqlite3_column_value(rows_.handle(), i));
    while (row.step()) {
    }
  }

  sql::Statement rows_, write_;
  int columns_ = 0;
};

std::vector<TableCopier> episode_copiers(const sql::Database& from, const sql::Database& to) {
  std::vector<Table> tables = current_tables();
  std::erase_if(tables, [](const Table& table) { return !table.of_episode; });
  std::stable_partition(tables.begin(), tables.end(), [](const Table& table) { return table.name == "episode"; });
  std::vector<TableCopier> copiers;
  for (const Table& table : tables) copiers.emplace_back(from, to, table);
  return copiers;
}

void check_variations(const sql::Database& from, const sql::Database& to) {
  sql::Statement theirs(from, "SELECT task, variation, axis, value FROM variation_axis");
  sql::Statement ours(
      to, "SELECT 1 FROM main.variation_axis WHERE task = ?1 AND variation = ?2 AND axis = ?3 AND value <> ?4");
  for (theirs.start(); theirs.step();) {
    std::string task, variation, axis, value;
    theirs.read(task, variation, axis, value);
    if (ours.start(task, variation, axis, value).step())
      throw CatalogueError(
          to.path(),
          "the two catalogues disagree about the variation " + sql::shown(task + " " + variation + ", axis " + axis),
          "they were made from different tasks of one name: keep them apart");
  }
}

// What episodes share, by hash or name: scripts, scenes, texts. Splits are the same everywhere.
void copy_shared(const sql::Database& from, const sql::Database& to) {
  check_variations(from, to);
  for (const Table& table : current_tables())
    if (!table.of_episode && table.name != "split") TableCopier(from, to, table).copy_shared();
}

}  // namespace

void Catalogue::copy_episodes(const fs::path& file, const std::vector<std::int64_t>& ids,
                              const std::function<bool(std::int64_t)>& copied) {
  const Catalogue other = Catalogue::open(file);
  const sql::Database &database = impl_->database, &from = other.impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  std::vector<TableCopier> copiers = episode_copiers(from, database);
  try {
    from.run("BEGIN");  // all of it as it is now
    for (std::size_t done = 0; done < ids.size();) {
      database.run("BEGIN IMMEDIATE; PRAGMA defer_foreign_keys = ON;");
      if (done == 0) copy_shared(from, database);
      std::int64_t id = database.number("SELECT coalesce(max(id), 0) FROM main.episode");
      const std::size_t end = std::min(done + kInATransaction, ids.size());
      for (; done < end; ++done) {
        ++id;
        for (TableCopier& copier : copiers) copier.copy_episode(ids[done], id);
        if (other.impl_->uncounted) count_stored_masks(database, id);
      }
      database.run("COMMIT");
      if (!copied(static_cast<std::int64_t>(done))) break;
    }
    from.run("COMMIT");
  } catch (...) {
    roll_back(database);
    roll_back(from);
    throw;
  }
}

MergeResult merge(const fs::path& into, const std::vector<fs::path>& from, const std::atomic<bool>* stop) {
  std::error_code ignored;
  std::vector<Source> sources;
  for (const fs::path& path : from) {
    if (fs::equivalent(into, path, ignored))
      throw CatalogueError(path.string(), "this file is both read and written", "name another file to write to");
    sources.emplace_back(path);
  }
  // The keys and, where two have the same, the content of all files are known before anything is written.
  KnownKeys keys;
  std::optional<Source> before;
  if (fs::exists(into, ignored) && fs::file_size(into, ignored) > 0) {
    before.emplace(into);
    keys.own(before->catalogue, into);
  }
  MergeResult result;
  std::vector<std::vector<std::int64_t>> fresh;
  for (const Source& source : sources) {
    MergedFile& file = result.files.emplace_back();
    file.path = source.path.string();
    fresh.push_back(keys.add(source.catalogue, source.path, file.existing));
  }
  before.reset();
  Catalogue catalogue = Catalogue::write(into);
  for (std::size_t i = 0; i < sources.size() && !result.interrupted; ++i)
    catalogue.copy_episodes(sources[i].path, fresh[i], [&](std::int64_t copied) {
      result.files[i].added = copied;
      result.interrupted = stop != nullptr && stop->load();
      return !result.interrupted;
    });
  catalogue.close();
  return result;
}

}  // namespace stampede
