// Which episodes a run consists of, their keys, and one of them from scripts to record.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/episode/runner.h"
#include "scripting/library/library.h"
#include "scripting/runtime/episode_scripts.h"
#include "stampede/episode.h"

namespace stampede {

// Seeds from here on are the test split's.
inline constexpr std::int64_t kFirstTestSeed = 1'000'000;

// Of a text such as `2/8`. Throws Error when it is none, or names a part that is not there.
Shard shard_from(const std::string& text);
void check_shard(Shard shard, const std::string& where);  // throws Error, likewise

struct JobRequest {
  std::vector<std::string> tasks;
  std::int64_t episodes = 1;  // per task, good or bad
  std::int64_t first_seed = 0;
  std::string variation = {};  // canonical text or a part of one (`colour=red`); empty: all
  // Which variations are used, in place of all that match.
  std::optional<std::map<std::string, std::vector<std::string>>> variations = {};  // by task
  Shard shard = {};
};

// Episodes of one variation: seeds first_seed, first_seed + stride …
struct SeedStrand {
  std::string task, variation;
  std::int64_t first_seed = 0, stride = 1, count = 1;
  friend auto operator<=>(const SeedStrand&, const SeedStrand&) = default;
};

// Episode i of a task has seed first_seed + i and variation i mod V of a shuffle that depends on the task alone. The
// list is sorted by task, variation, seed: the order in which they are stored. A task named twice counts once.
// Each job is worked out when it is asked for, so a list of a million takes the memory of its variations.
class JobList {
 public:
  // Throws Error for unknown tasks and for a variation that no task's axes have, with the nearest as cure.
  JobList(const Library& library, const JobRequest& request);
  // These, and no others. Throws Error for tasks and variations that the library does not have.
  JobList(const Library& library, std::vector<SeedStrand> strands, Shard shard = {});
  std::int64_t size() const;
  EpisodeJob operator[](std::int64_t index) const;
  std::vector<SeedStrand> strands() const;  // of all shards
  std::vector<EpisodeJob> first_of_each_task() const;

 private:
  struct Strand : SeedStrand {
    std::int64_t begin = 0;  // place of the first in the whole run
  };
  void arrange(std::vector<SeedStrand> strands);
  const Strand& strand_at(std::int64_t place) const;
  std::vector<Strand> strands_;
  std::int64_t whole_ = 0;  // episodes of all shards
  Shard shard_;
};

// The variations of a task that agree with every `axis=value` of the text.
std::vector<std::string> matching_variations(const Library::TaskInfo& task, const std::string& text);

// Throws Error with the nearest name as cure, and the complaints about the task's own file.
const Library::TaskInfo& task_info(const Library& library, const std::string& name);

// Throws Error when the seed does not belong to the split.
void check_split(Split split, std::int64_t first_seed, std::int64_t last_seed);

// Of all files that a task's episodes are made of. Other files, other hash; the same on every machine.
std::string definitions_hash(const std::vector<DefinitionRecord>& definitions);

// What tells the episode from every other, known before it runs: a hash of definitions, task, variation, seed and
// every option that alters data.
std::string episode_key(const std::vector<DefinitionRecord>& definitions, const EpisodeJob& job,
                        const RunOptions& options);

// The same of one in which an agent acted, known when it is over: what was done tells it from every other episode of
// the same start. `record.made.key`: that of its start.
std::string acted_key(const EpisodeRecord& record);

// One episode's scripts and key. Lifetime: used by one thread.
class PreparedEpisode {
 public:
  PreparedEpisode(std::shared_ptr<const Library> library, EpisodeJob job, RunOptions options,
                  std::shared_ptr<Assets> assets = nullptr);
  const EpisodeJob& job() const { return job_; }
  const std::string& key() const { return key_; }
  const RunOptions& options() const { return options_; }
  EpisodeScripts& scripts() { return scripts_; }
  // Fills in what a record says of its scripts: key, split, definitions, the verdict of an imported problem's dialect.
  void complete(EpisodeRecord& record) const;
  // One of which nothing is known but why it failed. It is not complete.
  EpisodeRecord failed(Reason reason, const std::string& detail);
  // Runs it; the record is complete.
  EpisodeRecord run(const std::atomic<bool>* stop);

 private:
  std::shared_ptr<const Library> library_;
  EpisodeJob job_;
  RunOptions options_;
  EpisodeScripts scripts_;
  std::vector<DefinitionRecord> definitions_;
  std::string key_;
};

}  // namespace stampede
