// What Slurm is asked, by its own programs: sbatch, squeue, scontrol, scancel.
#pragma once

#include <string>
#include <vector>

#include "scripting/commands/shard_folder.h"

namespace stampede::program {

// Where these programs are missing, or no controller answers, each throws Error with what they said.

// Throws UsageError for what `cluster` says itself (--array, --chdir …), and for what is no option.
std::vector<std::string> sbatch_words(const std::string& text);

// Throws Error where arrays of this cluster do not go so far.
void require_array_of(int shards);

// Submits these shards as one array and a merge that follows it and whatever of the folder is still at work; a merge
// that waited before is cancelled. Kept in the folder.
void submit(ShardFolder& folder, const std::vector<int>& shards);

struct SlurmState {
  std::vector<int> running, waiting;  // shards
  std::vector<std::string> reasons;   // for which they wait, as Slurm names them
  bool merge_waits = false;           // or runs
};
SlurmState state_of(const ShardFolder& folder);

int cancel(const ShardFolder& folder);  // returns how many tasks waited or ran

}  // namespace stampede::program
