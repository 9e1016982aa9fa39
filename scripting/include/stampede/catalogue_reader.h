// A catalogue to be read: questions in SQL, episodes as arrays, pictures. It needs no scripts, and is open at once.
//
//   const CatalogueReader demos("demos.db");
//   const auto id = demos.query("SELECT episode FROM demos").integer(0, "episode");
//   const EpisodeArrays arrays = demos.arrays(id, {{"joint_positions", "action"}});
//   const PictureFrames front = demos.pictures(id, "front_rgb", {0, 1, 2});
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "stampede/arrays.h"
#include "stampede/basics.h"
#include "stampede/error.h"
#include "stampede/rows.h"
#include "stampede/world_state.h"

namespace stampede {

// A ready question: `stampede query FILE NAME`.
struct ReadyQuestion {
  std::string name, description, sql;
};
STAMPEDE_EXPORT std::vector<ReadyQuestion> ready_questions();  // by name

// What one camera saw at some frames, as one array.
struct PictureFrames {
  std::vector<std::int64_t> shape;  // frames, height, width, and 3 for colours
  std::variant<std::vector<std::uint8_t>, std::vector<float>, std::vector<std::uint16_t>> data;  // as PictureRequest
};

struct PictureFramesRequest {
  std::vector<std::int64_t> frames = {};  // any order, repeats among them
  bool draw = false;                      // those that are not stored are drawn now, at the size of those that are
  int threads = 1;                        // that decode
};

// Lifetime: one thread at a time; movable. Not across a fork: a child opens its own. Many may read one file at once,
// and while another process writes to it.
// Throws: CatalogueError for a file that cannot serve, Error for unknown episodes, columns and bad SQL.
class STAMPEDE_EXPORT CatalogueReader {
 public:
  // A file; or a folder for which `stampede index` has made an index: all catalogues below it, read as one.
  explicit CatalogueReader(const std::filesystem::path& file);
  // Several read as one, `CatalogueReader(std::vector<std::filesystem::path>{"a.db", "b.db"})`: episodes are numbered
  // anew, file by file, one that two files have is there once, and `file_of(episode)` and `number_in_file(episode)`
  // tell SQL where it is from. What a question reads but pictures is copied aside. Throws CatalogueError naming both
  // files where two have other content under one key.
  explicit CatalogueReader(const std::vector<std::filesystem::path>& files);
  ~CatalogueReader();
  CatalogueReader(CatalogueReader&&) noexcept;
  CatalogueReader& operator=(CatalogueReader&&) noexcept;

  // One SELECT, or the name of a ready question, over the views (db/README.md). `parameters`: for ?1, ?2 …
  Rows query(std::string_view question, const std::vector<SqlValue>& parameters = {},
             std::int64_t most_rows = 0) const;  // 0: all

  EpisodeArrays arrays(std::int64_t episode, const ArrayRequest& request = {}) const;

  // `column`: one of EpisodeArrays::pictures by name: front_rgb, wrist_depth … Throws Error for a frame whose picture
  // is not stored, unless it may be drawn, and for pictures of different sizes.
  PictureFrames pictures(std::int64_t episode, const std::string& column, const PictureFramesRequest& request) const;

  // Drawn now, as Session::picture and points.
  CameraPicture picture(std::int64_t episode, std::int64_t frame, const PictureRequest& request = {}) const;
  CameraPoints points(std::int64_t episode, std::int64_t frame, const PictureRequest& request = {}) const;

  WorldState state(std::int64_t episode, std::int64_t frame) const;

 private:
  struct Impl;
  Own<Impl> impl_;
};

}  // namespace stampede
