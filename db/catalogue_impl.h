// What the sources of Catalogue share.
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "db/catalogue.h"
#include "db/sqlite.h"
#include "engine/record/observation.h"

namespace stampede {

class EpisodeWriter;

struct Catalogue::Impl {
  Impl();
  ~Impl();
  sql::Database database;
  bool writable = false;
  bool uncounted = false;                 // pixels of masks: of a release that did not, read as it is
  std::unique_ptr<EpisodeWriter> writer;  // made at the first add(); its statements must go before the database
};

void roll_back(const sql::Database& database);  // what has begun, if anything has
[[noreturn]] void throw_no_episode(const sql::Database& database, std::int64_t id);

// Lists of texts as JSON in a column.
std::string to_json_list(const std::vector<std::string>& texts);
std::vector<std::string> from_json_list(const sql::Database& database, const std::string& json);

// Lists of numbers likewise, in as many digits as bring every bit back. Nothing: the text is no such list.
std::string to_json_numbers(std::span<const double> numbers);
std::optional<std::vector<double>> from_json_numbers(std::string_view json);

// Rows of frames and sensors hold so many values each; a row's part says which.
inline constexpr std::size_t kJointsARow = 12, kChannelsARow = 16, kComponentsARow = 8;
std::string numbered(const std::string& name, std::size_t count);  // name_0, name_1 …
template <typename Value>  // those of a part, of all; none: there is no such part
sql::Wide<Value> part_of(std::span<const Value> values, std::size_t part, std::size_t a_row,
                         sql::UnknownValues unknown = sql::UnknownValues::refused) {
  const std::size_t first = std::min(part * a_row, values.size());
  return {values.subspan(first, std::min(a_row, values.size() - first)), a_row, unknown};
}

// What a real recording does not know is NaN in its record and NULL in the file.
inline sql::UnknownValues unknown_values_of(const EpisodeRecord& episode) {
  return episode.real ? sql::UnknownValues::allowed : sql::UnknownValues::refused;
}
// A predicate may give no margin at some frame.
inline sql::UnknownValues unknown_values_of(const ChannelRecord& channel, const EpisodeRecord& episode) {
  return channel.name == kMargins ? sql::UnknownValues::allowed : unknown_values_of(episode);
}
inline std::optional<double> known(double value) { return std::isnan(value) ? std::nullopt : std::optional(value); }

// A row of camera; the ordinal is not read.
inline constexpr const char* kCameraColumns =
    "name, width, height, focal_x, focal_y, centre_x, centre_y, k1, k2, p1, p2, k3, near_m, far_m, mount_body, "
    "mount_part, mount_matrix";
void read_camera(sql::Statement& row, Camera& camera);

// The upper three rows, in as many digits as bring every bit back: pictures drawn again are the same bytes.
std::string matrix_text(const Transform& transform);
Transform matrix_from(const std::string& text);

// Scene documents: what many share (shapes, grasps, the robot) is cut out and kept once, by hash.
struct PackedScene {
  std::string document;
  std::vector<std::pair<std::string, std::string>> assets;  // hash, text
};
PackedScene pack_scene(std::string_view document);
std::string unpack_scene(const sql::Database& database, const std::string& packed);

}  // namespace stampede
