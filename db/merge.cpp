#include "db/merge.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>

#include "db/catalogue.h"
#include "db/catalogue_impl.h"
#include "db/count_visible.h"
#include "db/known_keys.h"
#include "db/table_copier.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kInATransaction = 32;

struct Source {
  explicit Source(const fs::path& file) : path(file), catalogue(Catalogue::open(file)) {}
  fs::path path;
  Catalogue catalogue;
};

std::vector<TableCopier> episode_copiers(const sql::Database& from, const sql::Database& to) {
  std::vector<Table> tables = current_tables();
  std::erase_if(tables, [](const Table& table) { return !table.of_episode; });
  std::stable_partition(tables.begin(), tables.end(), [](const Table& table) { return table.name == "episode"; });
  std::vector<TableCopier> copiers;
  for (const Table& table : tables) copiers.emplace_back(from, to, table);
  return copiers;
}

void copy_shared(const sql::Database& from, const sql::Database& to) {
  check_variations(from, to);
  for (const Table& table : current_tables())
    if (is_shared(table)) TableCopier(from, to, table).copy_shared();
}

// What the episodes of files were made with: each may hold several versions, two must not differ.
class Making {
 public:
  // Throws CatalogueError where this file and one before were made differently.
  void add(const Catalogue& catalogue, const std::string& file) {
    std::map<std::string, std::set<std::string>> scripts;
    std::set<std::string> releases, numerics;
    for (const StoredRun& run : catalogue.runs()) {
      releases.insert(run.engine.version);
      numerics.insert(run.engine.numerics);
      for (const DefinitionRecord& script : run.definitions) scripts[script.path].insert(script.hash);
    }
    if (!releases.empty()) {
      check(file, "", releases, "of another release");
      check(file, "\n", numerics, "by another build, or on another class of processor,");
    }
    for (const auto& [path, hashes] : scripts) check(file, path, hashes, "of another version of " + path);
  }

 private:
  void check(const std::string& file, const std::string& what, const std::set<std::string>& own,
             const std::string& how) {
    const auto& [other, known] = made_.try_emplace(what, file, own).first->second;
    if (std::ranges::includes(known, own) || std::ranges::includes(own, known)) return;
    throw CatalogueError(file, "its episodes were made " + how + " than those of " + other,
                         "make those of one of the two again, or say --mixed");
  }
  std::map<std::string, std::pair<std::string, std::set<std::string>>> made_;  // by what: first file, versions
};

std::vector<std::string> own_tables(const Catalogue& catalogue) {
  const QueryResult tables =
      catalogue.query("SELECT name FROM pragma_table_list WHERE schema = 'main' AND name GLOB 'own_*' ORDER BY 1");
  std::vector<std::string> names;
  for (std::size_t i = 0; i < tables.rows.size(); ++i) names.push_back(tables.text(i, "name"));
  return names;
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

MergeResult merge(const fs::path& into, const std::vector<fs::path>& from, const MergeOptions& options) {
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
  Making making;
  if (!Catalogue::is_new(into)) {
    before.emplace(into);
    keys.own(before->catalogue, into);
    if (!options.mixed) making.add(before->catalogue, into.string());
  }
  MergeResult result;
  std::vector<std::vector<std::int64_t>> fresh;
  for (const Source& source : sources) {
    MergedFile& file = result.files.emplace_back();
    file.path = source.path.string();
    file.own_tables = own_tables(source.catalogue);
    if (!options.mixed) making.add(source.catalogue, file.path);
    fresh.push_back(keys.add(source.catalogue, source.path, file.existing));
  }
  before.reset();
  Catalogue catalogue = Catalogue::write(into);
  for (std::size_t i = 0; i < sources.size() && !result.interrupted; ++i)
    catalogue.copy_episodes(sources[i].path, fresh[i], [&](std::int64_t copied) {
      result.files[i].added = copied;
      result.interrupted = options.stop != nullptr && options.stop->load();
      return !result.interrupted;
    });
  catalogue.close();
  return result;
}

}  // namespace stampede
