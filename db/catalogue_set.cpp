#include "db/catalogue_set.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <mutex>
#include <set>
#include <utility>

#include "db/catalogue_impl.h"
#include "db/frame_labels.h"
#include "db/functions.h"
#include "db/known_keys.h"
#include "db/lake.h"
#include "db/read_only.h"
#include "db/table_copier.h"
#include "engine/base/stopping.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

// While it lives, each file is as it was at one moment.
class OneMoment {
 public:
  explicit OneMoment(std::vector<const sql::Database*> files) : files_(std::move(files)) {
    for (const sql::Database* file : files_) file->run("BEGIN");
  }
  ~OneMoment() {
    for (const sql::Database* file : files_) roll_back(*file);
  }
  OneMoment(const OneMoment&) = delete;
  OneMoment& operator=(const OneMoment&) = delete;

 private:
  std::vector<const sql::Database*> files_;
};

// The tables whose rows are copied: all, but that pictures stay where they are.
const std::vector<Table>& copied_tables() {
  static const std::vector<Table> tables = [] {
    std::vector<Table> all = current_tables();
    for (Table& table : all)
      if (table.name == "image") std::erase(table.columns, "data");
    return all;
  }();
  return tables;
}

constexpr const char* kWithoutPictures = "ALTER TABLE image DROP COLUMN data;";
constexpr const char* kPicturesElsewhere =
    "CREATE TEMP VIEW image AS SELECT episode, frame, camera, kind, width, height,"
    " stored_picture(episode, frame, camera, kind) AS data FROM main.image;";

}  // namespace

struct CatalogueSet::Impl {
  struct Member {
    explicit Member(const fs::path& file) : path(file), catalogue(Catalogue::open(file)) {}
    fs::path path;
    Catalogue catalogue;
    sql::Statement picture = {};  // from the first that is asked for
    std::int64_t version = -1;    // of what others have committed, as it was last seen
  };

  struct Location {
    Member* member;
    std::int64_t there;
  };

  std::optional<Lake> lake;         // instead of all below
  Lake::Place told;                 // the last that was asked for
  std::deque<Member> members;       // which stay where they are
  std::vector<Location> locations;  // of episode 1, 2 …
  KnownKeys keys;
  sql::Database together;       // made for the first question; only where there are several files
  std::set<std::string> there;  // the tables that are copied
  std::atomic<bool> interrupted = false;
  std::mutex opening;  // `together` comes or goes

  static const sql::Database& database_of(const Member& member) { return member.catalogue.impl_->database; }

  std::string name() const {
    return members.front().path.string() + " and " + std::to_string(members.size() - 1) + " more";
  }

  const Location* find(std::int64_t episode) const {
    const bool known = episode >= 1 && episode <= static_cast<std::int64_t>(locations.size());
    return known ? &locations[static_cast<std::size_t>(episode - 1)] : nullptr;
  }

  void heed_interrupt() const {
    heed_stop();
    if (interrupted) throw Error("query", "interrupted");
  }

  // What was copied is as the files are no more: it is forgotten.
  void see_changes() {
    bool changed = !together;
    for (Member& member : members)
      if (const std::int64_t now = database_of(member).number("PRAGMA data_version");
          std::exchange(member.version, now) != now)
        changed = true;
    if (changed) forget();
  }

  void forget() {
    const std::scoped_lock lock(opening);
    together.close();
    there.clear();
  }

  void number_episodes() {
    KnownKeys known = keys;
    std::vector<Location> all = locations;
    std::int64_t again = 0;
    for (Member& member : members)
      for (const std::int64_t id : known.add(member.catalogue, member.path, again)) all.push_back({&member, id});
    keys = std::move(known);
    locations = std::move(all);
  }

  void begin() {
    number_episodes();
    {
      // An empty name: a database of its own, in memory and then in a file that has no name any more.
      const std::scoped_lock lock(opening);
      together = sql::Database("", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, name());
    }
    together.run("PRAGMA cache_size = -65536;" + schema_script() + indexes_script() + kWithoutPictures);
    sqlite3_create_function_v2(together.handle(), "stored_picture", 4, SQLITE_UTF8 | SQLITE_INNOCUOUS, this,
                               stored_picture, nullptr, nullptr, nullptr);
    together.run(temporary_views_script() + kPicturesElsewhere);
    add_frame_labels(together, [this](std::int64_t episode, const ArrayRequest& request) {
      heed_interrupt();
      const Location& location = locations.at(static_cast<std::size_t>(episode - 1));
      return location.member->catalogue.read_arrays(location.there, request);
    });
    sql::add_origins(together.handle(), [this](std::int64_t episode) -> std::optional<sql::Origin> {
      const Location* location = find(episode);
      if (!location) return std::nullopt;
      return sql::Origin{location->member->path.string(), location->there};
    });
    const auto& tables = copied_tables();
    const auto axes =
        std::find_if(tables.begin(), tables.end(), [](const Table& t) { return t.name == "variation_axis"; });
    for (const Member& member : members) {
      check_variations(database_of(member), together);
      copy_of(*axes, member);
    }
    there.insert(axes->name);
  }

  void copy_of(const Table& table, const Member& member) const {
    TableCopier copier(database_of(member), together, table);
    try {
      if (is_shared(table)) copier.copy_shared();
      for (std::size_t i = 0; table.of_episode && i < locations.size(); ++i) {
        if (locations[i].member != &member) continue;
        heed_interrupt();
        copier.copy_episode(locations[i].there, static_cast<std::int64_t>(i + 1));
      }
    } catch (const CatalogueError& error) {
      if ((sqlite3_errcode(together.handle()) & 0xff) != SQLITE_CONSTRAINT) throw;
      throw CatalogueError(member.path.string(), "a row of " + table.name + " can be none: " + error.message(),
                           "the file was damaged or changed by hand: take a copy of it, or generate it again");
    }
  }

  void copy(std::set<std::string> asked) {
    if (asked.contains("progress") || asked.contains("applicable")) asked.insert("episode");
    std::string statistics;
    together.run("BEGIN");
    for (const Table& table : copied_tables()) {
      if (!asked.contains(table.name) || !there.insert(table.name).second) continue;
      for (const Member& member : members) copy_of(table, member);
      statistics += "ANALYZE main." + table.name + ";";
    }
    together.run("COMMIT; PRAGMA analysis_limit = 1000;" + statistics);
  }

  // Nothing half done is kept.
  template <typename Work>
  void whole_or_none(const Work& work) {
    try {
      work();
    } catch (const CatalogueError& error) {
      forget();
      heed_interrupt();
      if (error.where() != name()) throw;
      throw CatalogueError(name(), "what the question reads of these files cannot be copied aside: " + error.message(),
                           "name a folder with more room in SQLITE_TMPDIR, or ask one file: `stampede merge ALL.db "
                           "FILE...` makes it");
    } catch (...) {
      forget();
      throw;
    }
  }

  // Copies what the question reads; one that is no question leaves what is there.
  void prepare(const std::string& question) {
    whole_or_none([&] {
      see_changes();
      if (!together) begin();
    });
    const std::set<std::string> asked = tables_read_by(together, question);
    whole_or_none([&] { copy(asked); });
  }

  std::vector<const sql::Database*> databases() const {
    std::vector<const sql::Database*> all;
    for (const Member& member : members) all.push_back(&database_of(member));
    return all;
  }

  static void stored_picture(sqlite3_context* context, int, sqlite3_value** key) {
    const auto& impl = *static_cast<const Impl*>(sqlite3_user_data(context));
    const Location* location = impl.find(sqlite3_value_int64(key[0]));
    if (!location) return;
    try {
      sql::Statement& picture = location->member->picture;
      if (!picture.handle())
        picture = {database_of(*location->member),
                   "SELECT data FROM image WHERE episode = ?1 AND frame = ?2 AND camera = ?3 AND kind = ?4", true};
      picture.start(location->there);
      for (const int i : {1, 2, 3}) sqlite3_bind_value(picture.handle(), i + 1, key[i]);
      while (picture.step()) sqlite3_result_value(context, sqlite3_column_value(picture.handle(), 0));
    } catch (const std::exception& error) {
      sqlite3_result_error(context, error.what(), -1);
    }
  }
};

CatalogueSet::CatalogueSet(const std::vector<fs::path>& files) : impl_(std::make_unique<Impl>()) {
  std::error_code ignored;
  if (files.size() == 1 && fs::is_directory(files.front(), ignored)) {
    impl_->lake.emplace(files.front());
    return;
  }
  for (const fs::path& file : files) {
    const auto same = [&](const Impl::Member& member) { return fs::equivalent(member.path, file, ignored); };
    if (std::none_of(impl_->members.begin(), impl_->members.end(), same)) impl_->members.emplace_back(file);
  }
  if (impl_->members.empty()) throw Error("catalogues", "no file is named", "name one or more");
  if (impl_->members.size() == 1) return;
  const OneMoment moment(impl_->databases());
  impl_->prepare("SELECT 1");
}

CatalogueSet::~CatalogueSet() = default;
CatalogueSet::CatalogueSet(CatalogueSet&&) noexcept = default;
CatalogueSet& CatalogueSet::operator=(CatalogueSet&&) noexcept = default;

void CatalogueSet::query(std::string_view question, RowReceiver& receiver, const QueryOptions& options) const {
  Impl& impl = *impl_;
  if (impl.lake) return impl.lake->query(question, receiver, options);
  if (impl.members.size() == 1) return impl.members.front().catalogue.query(question, receiver, options);
  impl.interrupted = false;
  const std::string text = text_of_question(question);
  const OneMoment moment(impl.databases());
  impl.prepare(text);
  read_only_query(impl.together, text, receiver, options);
}

QueryResult CatalogueSet::query(std::string_view question, const QueryOptions& options) const {
  RowKeeper keeper;
  keeper.most_rows = options.most_rows;
  query(question, keeper, {options.parameters, 0});
  return std::move(keeper.result);
}

void CatalogueSet::interrupt() const {
  impl_->interrupted = true;
  if (impl_->lake) impl_->lake->interrupt();
  for (const Impl::Member& member : impl_->members) member.catalogue.interrupt();
  const std::scoped_lock lock(impl_->opening);
  if (impl_->together) sqlite3_interrupt(impl_->together.handle());
}

std::int64_t CatalogueSet::not_indexed() const { return impl_->lake ? impl_->lake->not_indexed() : 0; }

CatalogueSet::Place CatalogueSet::place(std::int64_t episode) const {
  if (impl_->lake) {
    impl_->told = impl_->lake->place(episode);
    return {*impl_->told.catalogue, impl_->told.episode};
  }
  if (impl_->members.size() == 1) return {impl_->members.front().catalogue, episode};
  if (const Impl::Location* location = impl_->find(episode)) return {location->member->catalogue, location->there};
  throw_no_episode(impl_->together, episode);
}

}  // namespace stampede
