// The catalogue: one SQLite file of episodes. Opened for writing it is in WAL mode; closing makes it one plain file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"
#include "engine/base/error.h"
#include "engine/episode/record.h"

namespace stampede {

inline constexpr std::int64_t kApplicationId = 0x53746d70;  // `Stmp`, at byte 68 of the file
int schema_version();                                       // number of the last file in db/schema

// What made the episodes; part of table engine_run.
struct EngineInfo {
  std::string version;
  std::string numerics;  // hash of a fixed probe
};

struct EpisodeSummary {
  std::int64_t id = 0;
  std::string key, task, variation;
  std::int64_t seed = 0;
  Outcome outcome = Outcome::failure;
  Reason reason = Reason::none;
  std::int64_t frames = 0;
  double duration_s = 0;
};

// Lifetime: one thread at a time, but for interrupt().
// Throws: CatalogueError with the cure when the file cannot serve: another application's, another schema version,
// not a database, not there, read-only, a full disk. A file that was not ours is never changed.
class Catalogue {
 public:
  static Catalogue open(const std::filesystem::path& path);   // read-only; works in a read-only folder
  static Catalogue write(const std::filesystem::path& path);  // made when it is not there
  ~Catalogue();                                               // closes; throws nothing
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;

  std::vector<EpisodeSummary> episodes() const;  // by id
  std::optional<std::int64_t> find(std::string_view key) const;

  // Everything but wall times, object grasps and numbers (they are in the scene document). Negative zero comes back
  // as zero: SQLite knows one zero. Definitions are sorted by kind, name and hash. Throws Error for an unknown id.
  EpisodeRecord read_episode(std::int64_t id) const;

  // One transaction; all or nothing. Result: its id, one above the greatest. Throws CatalogueError when the key is
  // there already, and Error when the record contradicts itself.
  std::int64_t add(const EpisodeRecord& episode, const EngineInfo& engine);

  // Of all data, whatever the ids: two catalogues of the same episodes agree. Host and wall times are left out.
  std::string content_hash() const;
  std::string episode_hash(std::int64_t id) const;

  // `question`: one SELECT, or a query's name. Throws Error with SQLite's complaint, or when it would write.
  QueryResult query(std::string_view question, const QueryOptions& options = {}) const;
  void interrupt() const;  // from any thread: the running query throws Error

  void close();  // as the destructor, but throws CatalogueError when the last pages cannot be written

  struct Impl;

 private:
  explicit Catalogue(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
