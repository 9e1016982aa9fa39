#include "db/merge.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>

#include "db/catalogue.h"
#include "db/catalogue_impl.h"
#include "db/migrations.h"
#include "db/schema.h"
#include "engine/base/temporary_folder.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kInATransaction = 32;

// A catalogue that episodes come from: of this release, or a migrated copy of it.
class Source {
 public:
  explicit Source(const fs::path& path) : path_(path), readable_(path) {
    std::optional<Catalogue> found = Catalogue::open(path);  // says what is wrong with it
    const auto schema = static_cast<int>(
        sql::Database(path.string(), SQLITE_OPEN_READONLY, path.string()).number("PRAGMA user_version"));
    if (schema == schema_version()) {
      catalogue_ = std::move(found);
      return;
    }
    found.reset();
    folder_ = std::make_unique<TemporaryFolder>();
    readable_ = folder_->path() / "copy.db";
    copy_database(path, readable_);
    Catalogue::write(readable_).close();
    catalogue_ = Catalogue::open(readable_);
  }
  const fs::path& path() const { return path_; }
  const fs::path& readable() const { return readable_; }
  const Catalogue& catalogue() const { return *catalogue_; }

 private:
  fs::path path_, readable_;
  std::unique_ptr<TemporaryFolder> folder_;
  std::optional<Catalogue> catalogue_;
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

// Statements that copy the rows of one episode, bound (their number there, their number here).
std::vector<sql::Statement> row_copiers(const sql::Database& database) {
  std::vector<sql::Statement> copiers;
  std::vector<std::string> tables = current_tables();
  std::stable_partition(tables.begin(), tables.end(), [](const std::string& name) { return name == "episode"; });
  for (const std::string& name : tables) {
    const Table table = describe(database, name);
    if (!table.of_episode) continue;
    const std::string number = name == "episode" ? "id" : "episode", columns = joined(table.columns);
    std::string text = "INSERT INTO main." + name;
    text.append(" (").append(number).append(", ").append(columns).append(") SELECT ?2, ").append(columns);
    text.append(" FROM other.").append(name).append(" WHERE ").append(number).append(" = ?1");
    copiers.emplace_back(database, text);
  }
  return copiers;
}

// What episodes share, by hash or name: scripts, scenes, texts. Splits are the same everywhere.
void copy_shared(const sql::Database& database) {
  sql::Statement differing(database,
                           "SELECT o.task || ' ' || o.variation || ', axis ' || o.axis FROM other.variation_axis o "
                           "JOIN main.variation_axis m USING (task, variation, axis) WHERE m.value <> o.value");
  if (differing.start().step()) {
    std::string which;
    differing.read(which);
    throw CatalogueError(database.path(), "the two catalogues disagree about the variation " + which,
                         "they were made from different tasks of one name: keep them apart");
  }
  for (const std::string& name : current_tables()) {
    const Table table = describe(database, name);
    if (table.of_episode || name == "split") continue;
    const std::string columns = joined(table.columns);
    std::string text = "INSERT INTO main." + name;
    text.append(" (").append(columns).append(") SELECT ").append(columns).append(" FROM other.").append(name);
    database.run(text.append(" WHERE true ON CONFLICT DO NOTHING"));
  }
}

}  // namespace

void Catalogue::copy_episodes(const fs::path& file, const std::vector<std::int64_t>& ids,
                              const std::function<bool(std::int64_t)>& copied) {
  const sql::Database& database = impl_->database;
  if (!impl_->writable) database.fail(SQLITE_READONLY);
  sql::Statement(database, "ATTACH ?1 AS other").run(fs::absolute(file).string());
  try {
    std::vector<sql::Statement> copiers = row_copiers(database);
    for (std::size_t done = 0; done < ids.size();) {
      database.run("BEGIN IMMEDIATE; PRAGMA defer_foreign_keys = ON;");
      if (done == 0) copy_shared(database);
      std::int64_t id = database.number("SELECT coalesce(max(id), 0) FROM main.episode");
      const std::size_t end = std::min(done + kInATransaction, ids.size());
      for (; done < end; ++done) {
        ++id;
        for (sql::Statement& copier : copiers) copier.run(ids[done], id);
      }
      database.run("COMMIT");
      if (!copied(static_cast<std::int64_t>(done))) break;
    }
  } catch (...) {
    roll_back(database);
    sqlite3_exec(database.handle(), "DETACH other", nullptr, nullptr, nullptr);
    throw;
  }
  database.run("DETACH other");
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
    keys.own(before->catalogue(), into);
  }
  MergeResult result;
  std::vector<std::vector<std::int64_t>> fresh;
  for (const Source& source : sources) {
    MergedFile& file = result.files.emplace_back();
    file.path = source.path().string();
    fresh.push_back(keys.add(source.catalogue(), source.path(), file.existing));
  }
  before.reset();
  Catalogue catalogue = Catalogue::write(into);
  for (std::size_t i = 0; i < sources.size() && !result.interrupted; ++i)
    catalogue.copy_episodes(sources[i].readable(), fresh[i], [&](std::int64_t copied) {
      result.files[i].added = copied;
      result.interrupted = stop != nullptr && stop->load();
      return !result.interrupted;
    });
  catalogue.close();
  return result;
}

}  // namespace stampede
