// The catalogue: one SQLite file of episodes. Opened for writing it is in WAL mode; closing makes it one plain file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"
#include "engine/base/error.h"
#include "engine/record/record.h"
#include "stampede/arrays.h"

namespace stampede {

inline constexpr std::int64_t kApplicationId = 0x53746d70;  // `Stmp`, at byte 68 of the file
int schema_version();                                       // raised whenever a table changes

// What made the episodes; part of table engine_run.
struct EngineInfo {
  std::string version;
  std::string numerics;  // hash of a fixed probe
};

struct EpisodeSummary {
  std::int64_t id = 0;
  std::string key, task, variation;
  std::int64_t seed = 0;
  bool real = false;
  std::string run;  // StoredRun::hash
  Outcome outcome = Outcome::failure;
  Reason reason = Reason::none;
  std::int64_t frames = 0;
  double duration_s = 0;
};

// All that episodes of one run share and that can alter data.
struct StoredRun {
  std::string hash;
  EngineInfo engine;
  std::map<std::string, std::string> options;
  std::vector<DefinitionRecord> definitions;  // by kind, name, hash
};

// Of all data, whatever the ids: two catalogues of the same episodes agree. Host and wall times are left out.
struct ContentHashes {
  std::string whole;
  std::map<std::int64_t, std::string> episodes;  // by id
};

// A stored picture or point cloud.
struct ImageEntry {
  std::int64_t frame = 0;
  std::string camera, kind;   // rgb depth instance semantic points
  int width = 0, height = 0;  // pixels
  std::int64_t bytes = 0;
  friend bool operator==(const ImageEntry&, const ImageEntry&) = default;
};

// A camera and where it was at each frame of an episode.
struct CameraTrack {
  Camera camera;
  std::vector<Pose> world_from_camera;  // may be empty for one that the episode has
};

struct AddedImages {
  std::int64_t added = 0, skipped = 0;  // skipped: the same bytes were there
};

// Lifetime: one thread at a time, but for interrupt().
// Throws: CatalogueError with the cure when the file cannot serve: another application's, a newer schema's, one of no
// release, not a database, not there, read-only, a full disk. A file that was not ours is never changed.
// A catalogue of an earlier release opens: read, it stays as it is; written, it is migrated first, all or nothing.
// How a transaction can be undone. `log`: what is new goes beside the file first, so others read it meanwhile.
// `in_place`: what is new goes into the file, what was there before goes beside it: every byte is written once, which
// large pictures want, and others wait. A file that others have open keeps its log.
enum class Journal { log, in_place };

class Catalogue {
 public:
  static Catalogue open(const std::filesystem::path& path);  // read-only; works in a read-only folder
  static Catalogue write(const std::filesystem::path& path, Journal journal = Journal::log);  // made when not there
  // Nothing has been written to it: it is not there, or a run was killed before it had a table.
  static bool is_new(const std::filesystem::path& path);
  ~Catalogue();  // closes; throws nothing
  Catalogue(Catalogue&&) noexcept;
  Catalogue& operator=(Catalogue&&) noexcept;

  std::vector<EpisodeSummary> episodes() const;  // by id
  std::vector<StoredRun> runs() const;           // by hash
  std::optional<std::int64_t> find(std::string_view key) const;

  // Everything but object grasps (they are in the scene document) and images (they may be large: see read_image).
  // Negative zero comes back as zero: SQLite knows one zero. Definitions are sorted by kind, name and hash. Throws
  // Error for an unknown id.
  EpisodeRecord read_episode(std::int64_t id) const;
  // The same values as episode_arrays() makes of that record, without making it.
  EpisodeArrays read_arrays(std::int64_t id, const ArrayRequest& request = {}) const;

  // One transaction; all or nothing. Result: its id, one above the greatest. Throws CatalogueError when the key is
  // there already, and Error when the record contradicts itself.
  std::int64_t add(const EpisodeRecord& episode, const EngineInfo& engine);
  // The same, but nothing where the key is there already: another run may write to the file too.
  std::optional<std::int64_t> add_if_new(const EpisodeRecord& episode, const EngineInfo& engine);
  // The same for an episode whose key is known only when its pictures were read: `key` is asked once all is written.
  std::optional<std::int64_t> add_if_new(const EpisodeRecord& episode, const EngineInfo& engine,
                                         const std::function<std::string()>& key);

  // Segments, facts, sentences and keyframes of a real episode become those of the record; all or nothing. Throws Error
  // for a simulated one: what its segments say is what was done.
  void set_labels(std::int64_t id, const EpisodeRecord& labelled);

  // Pictures made later, in one transaction; all or nothing. ImageRecord::camera counts in `cameras`. A camera that the
  // episode does not have is added to it; one of a known name must be the known one, at any size. Throws Error for
  // another camera of that name, a frame that is not there, and where other bytes are stored already.
  AddedImages add_images(std::int64_t id, const ImageStore& images, const std::vector<CameraTrack>& cameras);
  std::vector<ImageEntry> images(std::int64_t id) const;  // by frame, camera (in the episode's order), kind
  // The bytes of a PNG file; of a PLY file for kind `points`. Throws Error when there is none.
  std::vector<std::uint8_t> read_image(std::int64_t id, std::int64_t frame, std::string_view camera,
                                       std::string_view kind) const;
  // Of many frames; empty where there is none.
  std::vector<std::string> read_images(std::int64_t id, const std::vector<std::int64_t>& frames,
                                       std::string_view camera, std::string_view kind) const;

  // Copies episodes of another catalogue of this release: `ids` of that file, whose keys are not here yet, with all
  // that they refer to. A transaction for some dozens of them. `copied` is called after each transaction with how many
  // were copied so far; when it says false, the rest is left. Throws CatalogueError when the two disagree about a
  // variation.
  void copy_episodes(const std::filesystem::path& file, const std::vector<std::int64_t>& ids,
                     const std::function<bool(std::int64_t)>& copied);

  ContentHashes content_hashes() const;
  std::string content_hash() const { return content_hashes().whole; }
  std::string episode_hash(std::int64_t id) const;

  // `question`: one SELECT, or a query's name. Throws Error with SQLite's complaint, or when it would write.
  QueryResult query(std::string_view question, const QueryOptions& options = {}) const;
  // The same row by row: nothing is held. QueryOptions::most_rows ends it too.
  void query(std::string_view question, RowReceiver& receiver, const QueryOptions& options = {}) const;
  void interrupt() const;  // from any thread: the running query throws Error

  void close();  // as the destructor, but throws CatalogueError when the last pages cannot be written

  struct Impl;

  // Keys of the episodes after the one of this number, another run's too; sets it to the last one's.
  std::vector<std::string> keys_after(std::int64_t& last_id) const;

 private:
  friend class CatalogueSet;
  friend class Lake;
  explicit Catalogue(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
