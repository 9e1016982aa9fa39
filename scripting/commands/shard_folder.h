// A run cut into shards, as a folder that many machines see: what is to be made, the scripts that make and merge it,
// the parts, and what each shard said.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "scripting/session/lock.h"

namespace stampede::program {

inline constexpr std::int64_t kMostShards = 1'000'000;

// run.plan        what is to be made
// shard.sh        `sh shard.sh I` makes shard I: parts/partI.db appears whole or not at all, and is never made twice
// finish.sh       merges the parts that are there into demos.db and says what is missing
// logs/           what shards and the merge said
// complete.txt    appears once nothing is missing; until then missing.txt, where a merge was tried
// cluster.json    of how many shards, and who works on them
class ShardFolder {
 public:
  struct Shape {
    std::int64_t episodes = 0;
    int shards = 1;
    std::vector<std::string> roots;  // words of --root and --path for `make`
  };
  // Throws Error where there is something already.
  ShardFolder(std::filesystem::path path, const Lock& plan, Shape shape);
  // Throws Error for a folder of anything else. Its scripts are written anew, so that none of somebody else runs.
  explicit ShardFolder(std::filesystem::path path);

  const std::filesystem::path& path() const { return path_; }
  const Shape& shape() const { return shape_; }

  bool has_part(int shard) const;           // from 1
  bool is_complete() const;                 // merged, and nothing is missing
  std::string last_words(int shard) const;  // the last line of its log; empty: it said nothing

  // Of a scheduler, kept for who asks later.
  struct Submitted {
    std::vector<std::string> options;  // words for sbatch
    std::vector<std::string> arrays;   // job ids
    std::string finish;                // job id
  };
  const Submitted& submitted() const { return submitted_; }
  void keep(Submitted submitted);

 private:
  void write_scripts() const;
  void write_manifest() const;

  std::filesystem::path path_;  // absolute
  Shape shape_;
  Submitted submitted_;
};

}  // namespace stampede::program
