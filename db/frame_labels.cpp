#include "db/frame_labels.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "db/episode_reader.h"
#include "db/virtual_table.h"

namespace stampede {
namespace {

enum class Kind { progress, applicable };

// A table of that kind: its columns begin alike.
struct Labels {
  const sql::Database* database;
  Kind kind;
  ReadsArrays arrays;

  int declare(sqlite3* handle) const {
    return sqlite3_declare_vtab(
        handle, kind == Kind::progress
                    ? "CREATE TABLE progress (episode INTEGER, task TEXT, frame INTEGER, time_s REAL, progress REAL)"
                    : "CREATE TABLE applicable (episode INTEGER, task TEXT, frame INTEGER, time_s REAL, skill TEXT, "
                      "arguments TEXT)");
  }
  // One episode where it is named, else all of them.
  void plan(sqlite3_index_info& info) const {
    info.estimatedCost = 1e9;
    info.estimatedRows = 1'000'000;
    for (int i = 0; i < info.nConstraint; ++i) {
      const auto& one = info.aConstraint[i];
      if (!one.usable || one.iColumn != 0 || one.op != SQLITE_INDEX_CONSTRAINT_EQ) continue;
      info.aConstraintUsage[i].argvIndex = 1;
      info.idxNum = 1;
      info.estimatedCost = 1e4;
      info.estimatedRows = 1'000;
      break;
    }
  }
};

// The rows of one episode after the other.
class LabelRows {
 public:
  explicit LabelRows(const Labels& made) : made_(made) {}

  void begin(int named, sqlite3_value** values) {
    episodes_.clear();
    sql::Statement rows(*made_.database, named ? "SELECT id FROM main.episode WHERE id = ?1 AND frames > 0"
                                               : "SELECT id FROM main.episode WHERE ?1 = 0 AND frames > 0 ORDER BY id");
    for (rows.start(named ? static_cast<std::int64_t>(sqlite3_value_int64(values[0])) : std::int64_t{0}); rows.step();)
      rows.read(episodes_.emplace_back());
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
  const Labels& made_;
  std::vector<std::int64_t> episodes_;
  std::size_t next_ = 0;
  std::optional<EpisodeArrays> arrays_;  // of the episode that is told; nothing: all have been
  std::int64_t row_ = -1, width_ = 1;    // row: frame by frame, and skill by skill
};

}  // namespace

void add_frame_labels(const sql::Database& database, ReadsArrays arrays) {
  for (const auto& [name, kind] : {std::pair{"progress", Kind::progress}, std::pair{"applicable", Kind::applicable}})
    sql::Module<Labels, LabelRows, sql::Shown::by_name>::add(database.handle(), name,
                                                             new Labels{&database, kind, arrays});
}

void add_frame_labels(const sql::Database& database) {
  add_frame_labels(database, [&database](std::int64_t episode, const ArrayRequest& request) {
    return read_arrays(database, episode, request);
  });
}

}  // namespace stampede
