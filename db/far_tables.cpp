#include "db/far_tables.h"

#include <algorithm>
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

  int declare(sqlite3* handle) const {
    const std::string text = "CREATE TABLE far (episode, " + quoted_columns(table.columns) + ")";
    const int code = sqlite3_declare_vtab(handle, text.c_str());
    if (code == SQLITE_OK) sqlite3_vtab_config(handle, SQLITE_VTAB_INNOCUOUS);
    return code;
  }
  void plan(sqlite3_index_info& info) const {
    std::optional<int> episode, frame;
    for (int i = 0; i < info.nConstraint; ++i) {
      const auto& one = info.aConstraint[i];
      if (!one.usable || one.op != SQLITE_INDEX_CONSTRAINT_EQ) continue;
      if (one.iColumn == 0) episode = i;
      if (one.iColumn == frame_column) frame = i;
    }
    info.idxNum = kAll;
    info.estimatedCost = 1e9;
    info.estimatedRows = 10'000'000;
    if (!episode) return;  // a frame of every episode: read as all are
    info.idxNum = kEpisode;
    info.aConstraintUsage[*episode].argvIndex = 1;
    info.estimatedCost = 1e3;
    info.estimatedRows = 1'000;
    if (!frame) return;
    info.idxNum |= kFrame;
    info.aConstraintUsage[*frame].argvIndex = 2;
    info.estimatedCost = 10;
    info.estimatedRows = 10;
  }
};

// Rows of one episode after the other, each read where it lies.
class FarRows {
 public:
  explicit FarRows(const FarTable& far) : far_(far) {}

  void begin(int asked, sqlite3_value** values) {
    asked_ = asked, frame_ = asked & kFrame ? sqlite3_value_int64(values[1]) : 0;
    over_ = false;
    if (asked & kEpisode) {
      read(sqlite3_value_int64(values[0]));
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

}  // namespace

void add_far_table(const sql::Database& database, const Table& table, FindsFar find) {
  const auto frame = std::ranges::find(table.columns, "frame");
  const int column = frame == table.columns.end() ? -2 : static_cast<int>(frame - table.columns.begin()) + 1;
  const std::string name = "far_" + table.name;
  sql::Module<FarTable, FarRows, sql::Shown::as_table>::add(database.handle(), name.c_str(),
                                                            new FarTable{&database, table, std::move(find), column});
  database.show(table.name, name);
}

}  // namespace stampede
