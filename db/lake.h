// Many catalogues below a folder, asked as one by an index of what they hold. Inside this room, and for `index`.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <vector>

#include "db/catalogue.h"

namespace stampede {

struct LakeChange {
  std::int64_t files = 0, episodes = 0;  // in the index now
  std::int64_t added = 0, removed = 0;   // files; one that has changed is both
  std::int64_t twice = 0;                // episodes that two files have: they are there once, by the first
  std::vector<std::string> left_out;     // files of other programs, and those that nobody has written to yet
  bool interrupted = false;              // what is done is kept
};

// The index, FOLDER/index.lake, holds all that a question may ask but what there is for every frame: that is read where
// it lies, and so are scenes. Episodes are numbered from 1, file by file in the order of their paths as they were when
// first indexed; what comes later is numbered after them.
// Lifetime: one thread at a time, but for interrupt().
class Lake {
 public:
  // Makes the index, or brings it up to date: only files that are new, gone or changed cost anything. Throws
  // CatalogueError for a file that cannot serve, and for two with other content under one key or that disagree about a
  // variation (it names both).
  static LakeChange index(const std::filesystem::path& folder, const std::atomic<bool>* stop);

  // Throws CatalogueError, with the cure, where there is no index, and where a file is gone or has changed since.
  explicit Lake(const std::filesystem::path& folder);
  ~Lake();
  Lake(Lake&&) noexcept;
  Lake& operator=(Lake&&) noexcept;

  std::int64_t not_indexed() const;  // catalogues that have come since
  void query(std::string_view question, RowReceiver& receiver, const QueryOptions& options = {}) const;
  void interrupt() const;  // from any thread

  struct Place {
    std::shared_ptr<const Catalogue> catalogue;
    std::int64_t episode;  // its number there
  };
  Place place(std::int64_t episode) const;  // throws Error for an unknown one

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
