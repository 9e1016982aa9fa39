// Receives finished episodes from any number of threads and commits them one by one in a fixed order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string_view>

#include "db/catalogue.h"
#include "engine/record/episode_queue.h"

namespace stampede {

struct CatalogueWriterOptions {
  EngineInfo engine;
  std::int64_t queue_bytes = EpisodeQueue::kBytes;  // of finished episodes that wait: see EpisodeQueue
  // Called by the writing thread after each commit.
  std::function<void(std::int64_t id, const EpisodeRecord& episode)> committed;
};

// Repeatable: the rows and their ids depend on the places only, not on who finishes first.
class CatalogueWriter final : public EpisodeSink {
 public:
  CatalogueWriter(const std::filesystem::path& path, CatalogueWriterOptions options);
  ~CatalogueWriter() override;  // as finish(), but throws nothing

  bool has(std::string_view key) const override;                      // stored already, by another run too, or received
  void finished(std::int64_t place, EpisodeRecord episode) override;  // throws CatalogueError once writing has failed
  void abandon(std::int64_t place) override;

  // Commits what has arrived, in order, over the gaps of what has not, and closes the file. Throws CatalogueError.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
