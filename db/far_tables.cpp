#include "db/far_tables.h"

#include <algorithm>
#include <new>
#include <optional>
#include <string>
#include <vector>

#include "db/virtual_table.h"

namespace stampede {
namespace {

enum Asked : int { kAll = 0, kEpisode = 1, kFrame = 2 };  // of the constraints, as bits

struct FarTable {
  const sql::Database* database;
  Table table;
  FindsFar find;
  int frame_column;  // -2: it has none
};

struct FarVtab : sqlite3_vtab {
  const FarTable* far = nullptr;  // which lives as long as the connection
};

// Rows of one episode after the other, each read where it lies.
struct FarRows : sqlite3_vtab_cursor {
  explicit FarRows(const FarTable& far) : sqlite3_vtab_cursor{}, far_(far) {}

  void begin(int asked, std::int64_t episode, std::int64_t frame) {
    asked_ = asked, frame_ = frame;
    over_ = false;
    if (asked & kEpisode) {
      read(episode);
    } else {
      if (!episodes_.handle()) episodes_ = {*far_.database, "SELECT id FROM main.episode ORDER BY id", true};
      episodes_.start();
      next_episode();
    }
    advance();
  }
  void advance() {
    ++row_;
    while (!over_ && !rows_.step()) next_episode();
  }
  bool over() const { return over_; }
  std::int64_t place() const { return row_; }
  void tell(sqlite3_context* context, int column) const {
    if (column == 0) return sqlite3_result_int64(context, episode_);
    sqlite3_result_value(context, sqlite3_column_value(rows_.handle(), column - 1));
  }

 private:
  void next_episode() {
    if ((asked_ & kEpisode) || !episodes_.step()) {
      over_ = true;
      return;
    }
    std::int64_t episode = 0;
    episodes_.read(episode);
    read(episode);
  }
  void read(std::int64_t episode) {
    FarEpisode found = far_.find(episode);
    if (!found.database) {
      if (!(asked_ & kEpisode))
        throw Error("", "episode " + std::to_string(episode) + " is nowhere: the index is damaged");
      over_ = true;
      return;
    }
    if (found.database != open_ || prepared_ != asked_) {
      std::string text =
          "SELECT " + quoted_columns(far_.table.columns) + " FROM " + far_.table.name + " WHERE episode = ?1";
      if (asked_ & kFrame) text += " AND frame = ?2";
      rows_ = {*found.database, text, true};
      open_ = std::move(found.database);
      prepared_ = asked_;
    }
    episode_ = episode;
    if (asked_ & kFrame)
      rows_.start(found.there, frame_);
    else
      rows_.start(found.there);
  }

  const FarTable& far_;
  int asked_ = kAll, prepared_ = -1;
  std::int64_t episode_ = 0, frame_ = 0, row_ = 0;
  bool over_ = true;
  sql::Statement episodes_;
  std::shared_ptr<const sql::Database> open_;
  sql::Statement rows_;  // of `open_`: it goes first
};

const FarTable& far_of(sqlite3_vtab* table) { return *static_cast<const FarVtab*>(table)->far; }
FarRows& rows_of(sqlite3_vtab_cursor* cursor) { return *static_cast<FarRows*>(cursor); }

int connect_far(sqlite3* handle, void* made, int, const char* const*, sqlite3_vtab** table, char**) {
  const auto* const far = static_cast<const FarTable*>(made);
  const std::string text = "CREATE TABLE far (episode, " + quoted_columns(far->table.columns) + ")";
  const int code = sqlite3_declare_vtab(handle, text.c_str());
  if (code != SQLITE_OK) return code;
  sqlite3_vtab_config(handle, SQLITE_VTAB_INNOCUOUS);
  auto vtab = std::make_unique<FarVtab>();
  vtab->far = far;
  *table = vtab.release();
  return SQLITE_OK;
}

int disconnect_far(sqlite3_vtab* table) {
  delete static_cast<FarVtab*>(table);
  return SQLITE_OK;
}

int plan_far(sqlite3_vtab* table, sqlite3_index_info* info) {
  const int frame_column = far_of(table).frame_column;
  std::optional<int> episode, frame;
  for (int i = 0; i < info->nConstraint; ++i) {
    const auto& one = info->aConstraint[i];
    if (!one.usable || one.op != SQLITE_INDEX_CONSTRAINT_EQ) continue;
    if (one.iColumn == 0) episode = i;
    if (one.iColumn == frame_column) frame = i;
  }
  info->idxNum = kAll;
  info->estimatedCost = 1e9;
  info->estimatedRows = 10'000'000;
  if (!episode) return SQLITE_OK;  // a frame of every episode: read as all are
  info->idxNum = kEpisode;
  info->aConstraintUsage[*episode].argvIndex = 1;
  info->estimatedCost = 1e3;
  info->estimatedRows = 1'000;
  if (frame) {
    info->idxNum |= kFrame;
    info->aConstraintUsage[*frame].argvIndex = 2;
    info->estimatedCost = 10;
    info->estimatedRows = 10;
  }
  return SQLITE_OK;
}

int open_far(sqlite3_vtab* table, sqlite3_vtab_cursor** cursor) {
  *cursor = new (std::nothrow) FarRows(far_of(table));
  return *cursor ? SQLITE_OK : SQLITE_NOMEM;
}

int close_far(sqlite3_vtab_cursor* cursor) {
  delete static_cast<FarRows*>(cursor);
  return SQLITE_OK;
}

int filter_far(sqlite3_vtab_cursor* cursor, int asked, const char*, int, sqlite3_value** values) {
  return sql::guarded(cursor->pVtab, [&] {
    const auto number = [&](int bit, int place) {
      return asked & bit ? static_cast<std::int64_t>(sqlite3_value_int64(values[place])) : std::int64_t{0};
    };
    rows_of(cursor).begin(asked, number(kEpisode, 0), number(kFrame, 1));
  });
}

int next_far(sqlite3_vtab_cursor* cursor) {
  return sql::guarded(cursor->pVtab, [&] { rows_of(cursor).advance(); });
}

int over_far(sqlite3_vtab_cursor* cursor) { return rows_of(cursor).over() ? 1 : 0; }

int column_far(sqlite3_vtab_cursor* cursor, sqlite3_context* context, int which) {
  rows_of(cursor).tell(context, which);
  return SQLITE_OK;
}

int row_id_far(sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
  *id = rows_of(cursor).place();
  return SQLITE_OK;
}

void forget_far(void* made) { delete static_cast<FarTable*>(made); }

const sqlite3_module& module_of_far() {
  static const sqlite3_module module = [] {
    sqlite3_module one{};
    one.xCreate = connect_far, one.xDestroy = disconnect_far;  // a temporary table: nothing is made in a file
    one.xConnect = connect_far, one.xDisconnect = disconnect_far, one.xBestIndex = plan_far;
    one.xOpen = open_far, one.xClose = close_far, one.xFilter = filter_far, one.xNext = next_far;
    one.xEof = over_far, one.xColumn = column_far, one.xRowid = row_id_far;
    return one;
  }();
  return module;
}

}  // namespace

void add_far_table(const sql::Database& database, const Table& table, FindsFar find) {
  const auto frame = std::ranges::find(table.columns, "frame");
  const int column = frame == table.columns.end() ? -2 : static_cast<int>(frame - table.columns.begin()) + 1;
  const std::string name = "far_" + table.name;
  sqlite3_create_module_v2(database.handle(), name.c_str(), &module_of_far(),
                           new FarTable{&database, table, std::move(find), column}, forget_far);
  database.show(table.name, name);
}

}  // namespace stampede
