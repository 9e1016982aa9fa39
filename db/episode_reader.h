// Reads one stored episode, table by table. Inside this room only.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "db/catalogue_impl.h"

namespace stampede {

// What a word in a column stands for. Throws CatalogueError for one that this release does not know: a later one may.
template <typename Value>
Value known_word(const sql::Database& database, const char* column, const std::string& word,
                 std::optional<Value> value) {
  if (value) return *value;
  throw CatalogueError(database.path(), std::string(column) + " '" + word + "' is not one that this release knows",
                       "read it with the release that wrote it, or a later one");
}

inline std::optional<Outcome> outcome_from(const std::string& text) {
  if (text == "success") return Outcome::success;
  if (text == "failure") return Outcome::failure;
  return std::nullopt;
}

// What a real recording does not know is NULL in the file.
inline double known_or_nan(const sql::Statement& row, int column) {
  if (sqlite3_column_type(row.handle(), column) == SQLITE_NULL) return std::numeric_limits<double>::quiet_NaN();
  return sqlite3_column_double(row.handle(), column);
}

inline constexpr const char* kPoseColumns = "x, y, z, qx, qy, qz, qw";

struct ActionChannel {
  std::string space;
  std::size_t component = 0;
};

class EpisodeReader {
 public:
  EpisodeReader(const sql::Database& database, std::int64_t id) : database_(database), id_(id) {}
  EpisodeRecord read() {
    read_episode();
    read_run();
    read_objects();
    read_names();
    read_masks();
    read_cameras();
    read_channels();
    read_frames();
    read_actions();
    read_agent_actions();
    read_commands();
    read_segments();
    read_facts();
    read_passages();
    read_language();
    read_streams();
    return std::move(record_);
  }

 protected:  // read_arrays.cpp reads some of it
  // Rows of this episode, in the order of their key.
  template <typename Row>
  void each(const std::string& columns, const std::string& table, const std::string& order, const Row& row) {
    sql::Statement rows(database_, "SELECT " + columns + " FROM " + table + " WHERE episode = ?1 ORDER BY " + order);
    for (rows.start(id_); rows.step();) row(rows);
  }
  template <typename Item>
  Item& at(std::vector<Item>& list, std::int64_t index, const std::string& table) {
    if (index < 0 || index >= static_cast<std::int64_t>(list.size())) damaged(table);
    return list[static_cast<std::size_t>(index)];
  }

  [[noreturn]] void damaged(const std::string& table) const {  // a row of it names what is not there
    throw CatalogueError(database_.path(),
                         "a row of " + table + " of episode " + std::to_string(id_) + " names what is not there",
                         "the file is damaged: generate it again");
  }

  // The places of a row's part among all.
  std::span<double> part_in(std::span<double> all, std::size_t part, std::size_t a_row, const char* table) const {
    const std::size_t first = part * a_row;
    if (part >= all.size() || first >= all.size()) damaged(table);
    return all.subspan(first, std::min(a_row, all.size() - first));
  }
  // From `column` on: each value must be there, but where NULL is `allowed`.
  void take_values(const sql::Statement& row, int column, std::span<double> places, const char* table,
                   sql::UnknownValues unknown = sql::UnknownValues::refused) const;
  // Of a row of action whose values begin at column 2: channel(which, value) for each that it has.
  template <typename Channel>
  void each_channel(const sql::Statement& row, std::size_t part, const std::vector<ActionChannel>& channels,
                    const Channel& channel) const {
    if (part > channels.size() / kChannelsARow) damaged("action");
    for (std::size_t i = 0; i < kChannelsARow; ++i) {
      const int column = 2 + static_cast<int>(i);
      if (sqlite3_column_type(row.handle(), column) == SQLITE_NULL) continue;
      if (part * kChannelsARow + i >= channels.size()) damaged("action");
      channel(channels[part * kChannelsARow + i], sqlite3_column_double(row.handle(), column));
    }
  }

  void read_episode();
  void read_run();
  void read_objects();
  void read_names();
  void read_masks();
  void read_cameras();
  void read_channels();
  void read_frames();
  void read_poses();
  template <typename Place>
  void read_track(const std::string& thing, const std::string& table, std::size_t things, const Place& place);
  void read_actions();
  std::vector<ActionChannel> read_action_channels();
  void read_agent_actions();
  void read_commands();
  void read_segments();
  void read_segment_details();
  void read_facts();
  void read_passages();
  void read_language();
  void read_documents();
  void read_streams();
  SegmentRecord& owner(bool undone, std::int64_t ordinal);

  const sql::Database& database_;
  std::int64_t id_;
  EpisodeRecord record_;
  std::string run_;
  std::map<std::int64_t, std::size_t> segment_at_;  // ordinal -> index in record_.labels.segments
};

StoredRun read_stored_run(const sql::Database& database, const std::string& hash);

// See Catalogue::read_arrays.
EpisodeArrays read_arrays(const sql::Database& database, std::int64_t id, const ArrayRequest& request);

}  // namespace stampede
