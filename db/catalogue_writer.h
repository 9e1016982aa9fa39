// Receives finished episodes from any number of threads and commits them one by one in a fixed order.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "db/catalogue.h"
#include "engine/episode/interfaces.h"

namespace stampede {

struct EpisodeIdentity {
  std::string task, variation;
  std::int64_t seed = 0;
  std::string key;
  friend auto operator<=>(const EpisodeIdentity&, const EpisodeIdentity&) = default;
};

struct CatalogueWriterOptions {
  EngineInfo engine;
  std::int64_t queue_bytes = 512'000'000;  // of finished episodes that wait; a full queue makes finished() wait
  // Called by the writing thread after each commit.
  std::function<void(std::int64_t id, const EpisodeRecord& episode)> committed;
};

// Repeatable: the rows and their ids depend on the announced episodes only, not on who finishes first.
class CatalogueWriter : public EpisodeSink {
 public:
  CatalogueWriter(const std::filesystem::path& path, CatalogueWriterOptions options);
  ~CatalogueWriter() override;  // as finish(), but throws nothing

  bool has(std::string_view key) const;  // stored already, or received

  // Announces what will be finished or abandoned. Result: those that are not stored yet, in the order of commits
  // (task, variation, seed). Hand them out in this order: then a full queue can never hold up the next in line.
  std::vector<EpisodeIdentity> expect(std::vector<EpisodeIdentity> episodes);

  // One that nobody announced is committed at once; one whose key is stored, or that was interrupted, leaves no trace.
  void finished(EpisodeRecord episode) override;  // throws CatalogueError once writing has failed
  void abandon(std::string_view key);             // it will not come: do not wait for it

  // Commits what has arrived, in order, over the gaps of what has not, and closes the file. Throws CatalogueError.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
