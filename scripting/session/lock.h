// A lock: what a catalogue's episodes are made of, in kilobytes, such that anybody makes the same bytes of it again.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "db/catalogue.h"
#include "scripting/session/episode_job.h"

namespace stampede {

struct LockedStrand {
  SeedStrand episodes;
  std::string hash;  // of their content, one after the other; empty: of a plan
};

// Episodes that are made with one set of options from one set of scripts.
struct LockedRun {
  std::map<std::string, std::string> options;  // RunOptions::as_text
  Split split = Split::train;
  std::vector<std::size_t> scripts;  // in Lock::scripts
  std::vector<LockedStrand> strands;
};

// A plan is a lock of what nobody has made yet: its hashes are empty.
struct Lock {
  EngineInfo engine;
  std::string hash;                       // Catalogue::content_hash
  std::vector<DefinitionRecord> scripts;  // by kind, name, hash
  std::vector<LockedRun> runs;
  std::int64_t episodes() const;
  bool is_plan() const { return hash.empty(); }
};

// Repeatable: equal catalogues, equal locks. Throws Error, with the episode, for what no run makes again: what a policy
// did, what was recorded of a real robot, options of which the catalogue keeps only a hash, pictures that came later,
// and what several releases or classes of processor made.
Lock lock_of(const Catalogue& catalogue, const std::string& file);

// What a run would make. Throws Error, by its name, for an option that a lock cannot hold.
Lock plan_of(const Library& library, const JobList& jobs, const RunOptions& options, const EngineInfo& engine);

std::string to_text(const Lock& lock);                   // JSON
Lock lock_from_file(const std::filesystem::path& file);  // throws Error with place and cure

// To load its library with. `beside`: folders with what scripts read beside them, with the words of sentences, and with
// objects whose traits and parts the predicates of every task speak of.
Roots roots_of(const Lock& lock, const LockedRun& run, const Roots& beside);
JobList jobs_of(const Library& library, const LockedRun& run, Shard shard);

// Why this program makes other data here; empty: it makes the same.
std::string makes_other_data(const Lock& lock, const EngineInfo& here);

struct LockCheck {
  bool whole = false;                      // all is as locked, and no more is there; of a plan: nothing is missing
  std::int64_t same = 0;                   // episodes of strands that are complete and have the locked content
  std::vector<SeedStrand> missing;         // not there
  std::vector<SeedStrand> other;           // with other content than was locked
  std::vector<SeedStrand> further;         // there, and not locked
  std::vector<std::string> other_scripts;  // paths of scripts that differ, or are in one of the two alone
};
// Several catalogues count as one: the parts of a run.
LockCheck verify(const Lock& lock, const std::vector<const Catalogue*>& catalogues);

}  // namespace stampede
