// Receives finished episodes from any number of threads and commits them one by one in a fixed order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "db/catalogue.h"

namespace stampede {

struct CatalogueWriterOptions {
  EngineInfo engine;
  std::int64_t queue_bytes = 512'000'000;  // of finished episodes that wait; a full queue makes finished() wait
  // Called by the writing thread after each commit.
  std::function<void(std::int64_t id, const EpisodeRecord& episode)> committed;
};

// Every episode of a run has a place, 0, 1, 2 …, and is committed in that order; each place is finished or abandoned
// once. Start the work on them in this order: then a full queue can never hold up the next in line.
// Repeatable: the rows and their ids depend on the places only, not on who finishes first.
class CatalogueWriter {
 public:
  CatalogueWriter(const std::filesystem::path& path, CatalogueWriterOptions options);
  ~CatalogueWriter();  // as finish(), but throws nothing

  bool has(std::string_view key) const;  // stored already, by another run too, or received

  // One whose key is stored (by another run too), or that was interrupted, leaves no trace. Throws CatalogueError once
  // writing has failed.
  void finished(std::int64_t place, EpisodeRecord episode);
  void abandon(std::int64_t place);  // it will not come: do not wait for it

  // Commits what has arrived, in order, over the gaps of what has not, and closes the file. Throws CatalogueError.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
