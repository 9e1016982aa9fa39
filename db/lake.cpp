#include "db/lake.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "db/catalogue_impl.h"
#include "db/far_tables.h"
#include "db/frame_labels.h"
#include "db/functions.h"
#include "db/known_keys.h"
#include "db/read_only.h"
#include "db/table_copier.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

constexpr const char* kIndex = "index.lake";
constexpr std::size_t kMostOpen = 64;  // catalogues at a time

// What there is for every frame, or is as large: it stays where it is.
const std::set<std::string>& far_tables() {
  static const std::set<std::string> names = {"frame",       "joint_state", "hand_state", "object_state",
                                              "camera_pose", "action",      "command",    "sample",
                                              "image",       "mask_pixels", "image_time"};
  return names;
}

// Documents that no view shows; `replay` and `render` read them in the episode's own file.
bool stays_away(const Table& table) { return table.name == "scene" || table.name == "asset"; }

std::vector<Table> tables_of_index() {
  std::vector<Table> tables = current_tables();
  std::erase_if(tables, [](const Table& one) { return far_tables().contains(one.name) || stays_away(one); });
  std::ranges::stable_partition(tables, [](const Table& one) { return one.name == "episode"; });
  return tables;
}

// A catalogue as it lies on the disk; other numbers, other content.
struct Seen {
  std::int64_t size = 0, changed_ns = 0, log_size = 0;
  friend bool operator==(const Seen&, const Seen&) = default;
};

std::optional<Seen> seen(const fs::path& path) {
  struct stat file {
  }, log{};
  if (::stat(path.c_str(), &file) != 0) return std::nullopt;
  Seen now{file.st_size, file.st_mtim.tv_sec * std::int64_t{1'000'000'000} + file.st_mtim.tv_nsec, 0};
  if (::stat((path.string() + "-wal").c_str(), &log) == 0) now.log_size = log.st_size;
  return now;
}

bool is_ours(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<unsigned char, 72> header{};
  if (!file.read(reinterpret_cast<char*>(header.data()), header.size())) return false;
  std::int64_t id = 0;
  for (std::size_t i = 68; i < 72; ++i) id = id << 8 | header[i];
  return id == kApplicationId;
}

struct Files {
  std::map<std::string, fs::path> catalogues;  // by their path in the folder
  std::vector<std::string> others;             // *.db of other programs, or empty
};

Files files_below(const fs::path& folder) {
  std::error_code error;
  if (!fs::is_directory(folder, error))
    throw CatalogueError(folder.string(), "there is no such folder", "name the folder that the catalogues lie in");
  Files files;
  for (fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
       at != end; at.increment(error)) {
    if (at->path().extension() != ".db" || !at->is_regular_file(error)) continue;
    const std::string inside = at->path().lexically_relative(folder).generic_string();
    if (is_ours(at->path()))
      files.catalogues.emplace(inside, at->path());
    else
      files.others.push_back(inside);
  }
  if (error) throw CatalogueError(folder.string(), error.message(), "make the folder readable");
  std::ranges::sort(files.others);
  return files;
}

std::int64_t own_tables_in(const sql::Database& database) {
  return database.number("SELECT count(*) FROM main.sqlite_master WHERE type = 'table' AND name GLOB 'own_lake_*'");
}

constexpr const char* kOwnTables =
    "CREATE TABLE IF NOT EXISTS own_lake_file (id INTEGER PRIMARY KEY, path TEXT NOT NULL UNIQUE, size INTEGER NOT "
    "NULL,"
    " changed_ns INTEGER NOT NULL, log_size INTEGER NOT NULL);"
    "CREATE TABLE IF NOT EXISTS own_lake_episode (episode INTEGER PRIMARY KEY, file INTEGER NOT NULL,"
    " there INTEGER NOT NULL);"
    "CREATE INDEX IF NOT EXISTS own_lake_of_file ON own_lake_episode (file);";

// Nothing is written through another name of it.
void check_names(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_symlink(path, ignored))
    throw CatalogueError(path.string(), "this is a link, and nothing is written through it", "remove it");
  if (fs::exists(path, ignored) && fs::hard_link_count(path, ignored) > 1)
    throw CatalogueError(path.string(), "this file has another name too, which would be written to",
                         "remove the name " + path.string());
}

struct Listed {
  std::int64_t id = 0;
  Seen seen;
};

std::map<std::string, Listed> listed_in(const sql::Database& database) {
  std::map<std::string, Listed> files;
  sql::Statement row(database, "SELECT path, id, size, changed_ns, log_size FROM main.own_lake_file");
  for (row.start(); row.step();) {
    std::string path;
    Listed file;
    row.read(path, file.id, file.seen.size, file.seen.changed_ns, file.seen.log_size);
    files.emplace(std::move(path), file);
  }
  return files;
}

// Writes into an index.
class Indexer {
 public:
  Indexer(const fs::path& folder, const sql::Database& database) : folder_(folder), database_(database) {}

  void remove(std::int64_t file) const {
    const std::string of_file =
        " IN (SELECT episode FROM main.own_lake_episode WHERE file = " + std::to_string(file) + ");";
    std::string text;
    for (const Table& table : tables_of_index())
      if (table.of_episode)
        text += "DELETE FROM main." + table.name + " WHERE " + (table.name == "episode" ? "id" : "episode") + of_file;
    const std::string one = std::to_string(file) + ";";
    database_.run(text + "DELETE FROM main.own_lake_episode WHERE file = " + one +
                  "DELETE FROM main.own_lake_file WHERE id = " + one);
  }

  // What only episodes shared that are gone.
  void forget_unused() const {
    database_.run(
        "DELETE FROM main.engine_run WHERE hash NOT IN (SELECT engine_run FROM main.episode);"
        "DELETE FROM main.engine_run_definition WHERE engine_run NOT IN (SELECT hash FROM main.engine_run);"
        "DELETE FROM main.predicate WHERE engine_run NOT IN (SELECT hash FROM main.engine_run);"
        "DELETE FROM main.definition WHERE (kind, name, hash) NOT IN"
        " (SELECT kind, name, hash FROM main.engine_run_definition);"
        "DELETE FROM main.variation_axis WHERE (task, variation) NOT IN"
        " (SELECT task, variation FROM main.episode WHERE variation IS NOT NULL);"
        "DELETE FROM main.variation WHERE (task, variation) NOT IN"
        " (SELECT task, variation FROM main.episode WHERE variation IS NOT NULL);");
  }

  // The episodes that another file has already.
  std::int64_t add(const std::string& inside, const fs::path& path, const Seen& now, const Catalogue& catalogue,
                   const sql::Database& from) const {
    check_variations(from, database_);
    sql::Statement(database_,
                   "INSERT INTO main.own_lake_file (path, size, changed_ns, log_size) VALUES (?1, ?2, ?3, ?4)")
        .run(inside, now.size, now.changed_ns, now.log_size);
    const std::int64_t file = sqlite3_last_insert_rowid(database_.handle());
    std::vector<TableCopier> copiers;
    for (const Table& table : tables_of_index()) {
      if (is_shared(table)) TableCopier(from, database_, table).copy_shared();
      if (table.of_episode) copiers.emplace_back(from, database_, table);
    }
    sql::Statement known(database_, "SELECT id FROM main.episode WHERE key = ?1");
    sql::Statement place(database_, "INSERT INTO main.own_lake_episode VALUES (?1, ?2, ?3)");
    std::int64_t twice = 0, id = database_.number("SELECT coalesce(max(id), 0) FROM main.episode");
    for (const EpisodeSummary& episode : catalogue.episodes()) {
      if (known.start(episode.key).step()) {
        std::int64_t other = 0;
        known.read(other);
        require_same(path, catalogue, episode, other);
        ++twice;
        continue;
      }
      ++id;
      for (TableCopier& copier : copiers) copier.copy_episode(episode.id, id);
      place.run(id, file, episode.id);
    }
    return twice;
  }

 private:
  void require_same(const fs::path& path, const Catalogue& catalogue, const EpisodeSummary& episode,
                    std::int64_t known) const {
    sql::Statement where(
        database_,
        "SELECT f.path, e.there FROM main.own_lake_episode e JOIN main.own_lake_file f ON f.id = e.file"
        " WHERE e.episode = ?1");
    std::string other;
    std::int64_t there = 0;
    if (where.start(known).step()) where.read(other, there);
    const fs::path file = folder_ / other;
    if (file == path || Catalogue::open(file).episode_hash(there) == catalogue.episode_hash(episode.id)) return;
    refuse_other_content(path.string(), episode, file.string(), there);
  }

  const fs::path& folder_;
  const sql::Database& database_;
};

}  // namespace

LakeChange Lake::index(const fs::path& folder, const std::atomic<bool>* stop) {
  const Files files = files_below(folder);
  if (files.catalogues.empty())
    throw CatalogueError(folder.string(), "there is no catalogue below it",
                         "stampede run TASK --out " + (folder / "part1.db").string());
  const fs::path index_file = folder / kIndex;
  check_names(index_file);
  if (!Catalogue::is_new(index_file) && own_tables_in(Catalogue::open(index_file).impl_->database) < 2)
    throw CatalogueError(index_file.string(), "this is a catalogue, and no index",
                         "give it another name, or move it away");
  Catalogue index = Catalogue::write(index_file);
  const sql::Database& database = index.impl_->database;
  database.run("PRAGMA foreign_keys = OFF;");
  database.run(std::string("BEGIN IMMEDIATE;") + kOwnTables + "COMMIT;");
  const Indexer indexer(folder, database);
  LakeChange change;
  change.left_out = files.others;
  const auto transaction = [&](const auto& work) {
    database.run("BEGIN IMMEDIATE");
    try {
      work();
      database.run("COMMIT");
    } catch (...) {
      roll_back(database);
      throw;
    }
  };
  std::map<std::string, Listed> listed = listed_in(database);
  transaction([&] {
    for (auto at = listed.begin(); at != listed.end();) {
      const auto file = files.catalogues.find(at->first);
      if (file != files.catalogues.end() && seen(file->second) == at->second.seen) {
        ++at;
        continue;
      }
      indexer.remove(at->second.id);
      ++change.removed;
      at = listed.erase(at);
    }
    if (change.removed > 0) indexer.forget_unused();
  });
  for (const auto& [inside, path] : files.catalogues) {
    if (listed.contains(inside)) continue;
    change.interrupted = stop != nullptr && stop->load();
    if (change.interrupted) break;
    const Seen now = seen(path).value_or(Seen());
    const Catalogue catalogue = Catalogue::open(path);
    transaction([&, &inside = inside, &path = path] {
      change.twice += indexer.add(inside, path, now, catalogue, catalogue.impl_->database);
    });
    ++change.added;
  }
  if (change.added + change.removed > 0) database.run("PRAGMA analysis_limit = 1000; ANALYZE;");
  change.files = database.number("SELECT count(*) FROM main.own_lake_file");
  change.episodes = database.number("SELECT count(*) FROM main.episode");
  index.close();
  return change;
}

struct Lake::Impl {
  struct Member {
    Catalogue catalogue;
    static const sql::Database& database_of(const Member& member) { return member.catalogue.impl_->database; }
  };
  using Open = std::pair<std::int64_t, std::shared_ptr<const Member>>;

  explicit Impl(const fs::path& path) : folder(path), index(Catalogue::open(path / kIndex)) {}

  const sql::Database& database() const { return index.impl_->database; }

  [[noreturn]] void refuse(const std::string& place, const std::string& what) const {
    throw CatalogueError(place, what, "`stampede index " + folder.string() + "` brings the index up to date");
  }

  void look_at_files() {
    const Files files = files_below(folder);
    const std::map<std::string, Listed> listed = listed_in(database());
    for (const auto& [inside, file] : listed) {
      const auto there = files.catalogues.find(inside);  // no path is taken from the index
      if (there == files.catalogues.end()) refuse((folder / inside).string(), "it was indexed, and is gone");
      if (seen(there->second) != file.seen) refuse(there->second.string(), "it has changed since it was indexed");
      paths[file.id] = there->second;
    }
    unknown = static_cast<std::int64_t>(files.catalogues.size()) - static_cast<std::int64_t>(listed.size());
  }

  // The last that were asked stay open.
  std::shared_ptr<const Member> member(std::int64_t file) {
    const auto found = std::ranges::find(open, file, &Open::first);
    if (found != open.end()) {
      open.splice(open.begin(), open, found);
      return open.front().second;
    }
    const auto path = paths.find(file);
    if (path == paths.end())
      throw CatalogueError((folder / kIndex).string(), "it is damaged: an episode of no file",
                           "remove it; `stampede index " + folder.string() + "` makes another");
    open.emplace_front(file, std::make_shared<const Member>(Member{Catalogue::open(path->second)}));
    if (open.size() > kMostOpen) open.pop_back();
    return open.front().second;
  }

  struct Location {
    std::int64_t file = 0, there = 0;
  };
  std::optional<Location> location(std::int64_t episode) {
    if (!where.handle()) where = {database(), "SELECT file, there FROM main.own_lake_episode WHERE episode = ?1", true};
    Location found;
    if (!where.start(episode).step()) return std::nullopt;
    where.read(found.file, found.there);
    where.start(std::int64_t{0});  // nothing is left open
    return found;
  }

  void prepare() {
    look_at_files();
    for (const Table& table : current_tables())
      if (far_tables().contains(table.name))
        add_far_table(database(), table, [this](std::int64_t episode) -> FarEpisode {
          const std::optional<Location> found = location(episode);
          if (!found) return {};
          const std::shared_ptr<const Member> from = member(found->file);
          return {{from, &Member::database_of(*from)}, found->there};
        });
    add_frame_labels(database(), [this](std::int64_t episode, const ArrayRequest& request) {
      const Location found = location(episode).value_or(Location());
      return member(found.file)->catalogue.read_arrays(found.there, request);
    });
    sql::add_origins(database().handle(), [this](std::int64_t episode) -> std::optional<sql::Origin> {
      const std::optional<Location> found = location(episode);
      const auto path = found ? paths.find(found->file) : paths.end();
      if (path == paths.end()) return std::nullopt;
      return sql::Origin{path->second.string(), found->there};
    });
  }

  fs::path folder;
  Catalogue index;
  std::map<std::int64_t, fs::path> paths;
  std::int64_t unknown = 0;
  std::list<Open> open;  // the latest first
  sql::Statement where;
};

Lake::Lake(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder / kIndex, ignored))
    throw CatalogueError(folder.string(), "this is a folder, and has no index of the catalogues below it",
                         "`stampede index " + folder.string() + "` makes it; or name files");
  impl_ = std::make_unique<Impl>(folder);
  if (own_tables_in(impl_->database()) < 2) impl_->refuse((folder / kIndex).string(), "it is no index");
  impl_->prepare();
}

Lake::~Lake() = default;
Lake::Lake(Lake&&) noexcept = default;
Lake& Lake::operator=(Lake&&) noexcept = default;

std::int64_t Lake::not_indexed() const { return impl_->unknown; }

void Lake::query(std::string_view question, RowReceiver& receiver, const QueryOptions& options) const {
  read_only_query(impl_->database(), text_of_question(question), receiver, options);
}

void Lake::interrupt() const { impl_->index.interrupt(); }

Lake::Place Lake::place(std::int64_t episode) const {
  const std::optional<Impl::Location> found = impl_->location(episode);
  if (!found) throw_no_episode(impl_->database(), episode);
  const std::shared_ptr<const Impl::Member> from = impl_->member(found->file);
  return {{from, &from->catalogue}, found->there};
}

}  // namespace stampede
