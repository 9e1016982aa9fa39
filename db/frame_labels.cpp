#include "db/frame_labels.h"

#include <cmath>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "db/episode_reader.h"
#include "db/virtual_table.h"

namespace stampede {
namespace {

enum class Kind { progress, applicable };

struct Made {
  const sql::Database* database;
  Kind kind;
  ReadsArrays arrays;
};

// A table of that kind: its columns begin alike.
struct Labels : sqlite3_vtab {
  const Made* made = nullptr;  // which lives as long as the connection
};

// The rows of one episode after the other.
struct LabelRows : sqlite3_vtab_cursor {
  explicit LabelRows(const Made& made) : sqlite3_vtab_cursor{}, made_(made) {}

  void begin(std::vector<std::int64_t> episodes) {
    episodes_ = std::move(episodes);
    next_ = 0;
    arrays_.reset();
    row_ = -1;
    advance();
  }
  void advance() {
    for (;;) {
      if (!arrays_) {
        if (next_ == episodes_.size()) return;
        arrays_ = made_.arrays(episodes_[next_], {{made_.kind == Kind::progress ? "progress" : "applicable"}});
        width_ = made_.kind == Kind::progress ? 1 : static_cast<std::int64_t>(arrays_->skills.size());
        row_ = -1;
      }
      for (++row_; row_ < arrays_->frames * width_; ++row_)
        if (made_.kind == Kind::progress || arrays_->column("applicable").booleans()[static_cast<std::size_t>(row_)])
          return;
      arrays_.reset();
      ++next_;
    }
  }
  bool over() const { return !arrays_; }
  std::int64_t place() const { return row_; }
  void tell(sqlite3_context* context, int column) const {
    const std::int64_t frame = row_ / width_;
    const auto text = [&](const std::string& words) {
      sqlite3_result_text64(context, words.data(), words.size(), SQLITE_TRANSIENT, SQLITE_UTF8);
    };
    switch (column) {
      case 0:
        return sqlite3_result_int64(context, episodes_[next_]);
      case 1:
        return text(arrays_->task);
      case 2:
        return sqlite3_result_int64(context, frame);
      case 3:
        return sqlite3_result_double(context, static_cast<double>(frame) / arrays_->frame_hz);
      default:
        break;
    }
    if (made_.kind == Kind::progress) {
      const double share = arrays_->column("progress").reals()[static_cast<std::size_t>(frame)];
      return std::isnan(share) ? sqlite3_result_null(context) : sqlite3_result_double(context, share);
    }
    const StateFact& skill = arrays_->skills[static_cast<std::size_t>(row_ % width_)];
    if (column == 4) return text(skill.predicate);
    text(to_json_list(skill.arguments));
  }

 private:
  const Made& made_;
  std::vector<std::int64_t> episodes_;
  std::size_t next_ = 0;
  std::optional<EpisodeArrays> arrays_;  // of the episode that is told; nothing: all have been
  std::int64_t row_ = -1, width_ = 1;    // row: frame by frame, and skill by skill
};

int connect(sqlite3* handle, void* made, int, const char* const*, sqlite3_vtab** table, char**) {
  const auto* const table_made = static_cast<const Made*>(made);
  const int code = sqlite3_declare_vtab(
      handle, table_made->kind == Kind::progress
                  ? "CREATE TABLE progress (episode INTEGER, task TEXT, frame INTEGER, time_s REAL, progress REAL)"
                  : "CREATE TABLE applicable (episode INTEGER, task TEXT, frame INTEGER, time_s REAL, skill TEXT, "
                    "arguments TEXT)");
  if (code != SQLITE_OK) return code;
  auto labels = std::make_unique<Labels>();
  labels->made = table_made;
  *table = labels.release();
  return SQLITE_OK;
}

int disconnect(sqlite3_vtab* table) {
  delete static_cast<Labels*>(table);
  return SQLITE_OK;
}

// One episode where it is named, else all of them.
int plan(sqlite3_vtab*, sqlite3_index_info* info) {
  info->estimatedCost = 1e9;
  info->estimatedRows = 1'000'000;
  for (int i = 0; i < info->nConstraint; ++i) {
    const auto& one = info->aConstraint[i];
    if (!one.usable || one.iColumn != 0 || one.op != SQLITE_INDEX_CONSTRAINT_EQ) continue;
    info->aConstraintUsage[i].argvIndex = 1;
    info->idxNum = 1;
    info->estimatedCost = 1e4;
    info->estimatedRows = 1'000;
    break;
  }
  return SQLITE_OK;
}

int open(sqlite3_vtab* table, sqlite3_vtab_cursor** cursor) {
  const auto& labels = *static_cast<const Labels*>(table);
  *cursor = new (std::nothrow) LabelRows(*labels.made);
  return *cursor ? SQLITE_OK : SQLITE_NOMEM;
}

int close(sqlite3_vtab_cursor* cursor) {
  delete static_cast<LabelRows*>(cursor);
  return SQLITE_OK;
}

int filter(sqlite3_vtab_cursor* cursor, int named, const char*, int, sqlite3_value** values) {
  const auto& labels = *static_cast<const Labels*>(cursor->pVtab);
  return sql::guarded(cursor->pVtab, [&] {
    std::vector<std::int64_t> episodes;
    sql::Statement rows(*labels.made->database,
                        named ? "SELECT id FROM main.episode WHERE id = ?1 AND frames > 0"
                              : "SELECT id FROM main.episode WHERE ?1 = 0 AND frames > 0 ORDER BY id");
    for (rows.start(named ? static_cast<std::int64_t>(sqlite3_value_int64(values[0])) : std::int64_t{0});
         rows.step();) {
      std::int64_t id = 0;
      rows.read(id);
      episodes.push_back(id);
    }
    static_cast<LabelRows*>(cursor)->begin(std::move(episodes));
  });
}

int next(sqlite3_vtab_cursor* cursor) {
  return sql::guarded(cursor->pVtab, [&] { static_cast<LabelRows*>(cursor)->advance(); });
}

int over(sqlite3_vtab_cursor* cursor) { return static_cast<const LabelRows*>(cursor)->over() ? 1 : 0; }

int column(sqlite3_vtab_cursor* cursor, sqlite3_context* context, int which) {
  return sql::guarded(cursor->pVtab, [&] { static_cast<const LabelRows*>(cursor)->tell(context, which); });
}

int row_id(sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
  *id = static_cast<const LabelRows*>(cursor)->place();
  return SQLITE_OK;
}

void forget(void* made) { delete static_cast<Made*>(made); }

const sqlite3_module& module_of_labels() {
  static const sqlite3_module module = [] {
    sqlite3_module one{};  // without xCreate: there is nothing to be made in a file
    one.xConnect = connect, one.xDisconnect = disconnect, one.xBestIndex = plan;
    one.xOpen = open, one.xClose = close, one.xFilter = filter, one.xNext = next;
    one.xEof = over, one.xColumn = column, one.xRowid = row_id;
    return one;
  }();
  return module;
}

}  // namespace

void add_frame_labels(const sql::Database& database, ReadsArrays arrays) {
  for (const auto& [name, kind] : {std::pair{"progress", Kind::progress}, std::pair{"applicable", Kind::applicable}})
    sqlite3_create_module_v2(database.handle(), name, &module_of_labels(), new Made{&database, kind, arrays}, forget);
}

void add_frame_labels(const sql::Database& database) {
  add_frame_labels(database, [&database](std::int64_t episode, const ArrayRequest& request) {
    return read_arrays(database, episode, request);
  });
}

}  // namespace stampede
