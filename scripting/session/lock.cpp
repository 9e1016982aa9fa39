#include "scripting/session/lock.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include "engine/base/hash.h"
#include "engine/base/names.h"
#include "engine/start/options.h"

namespace stampede {
namespace {

// Every episode of a library is made of these, whatever its task.
bool is_of_all(const DefinitionRecord& script) {
  const std::optional<DefinitionKind> kind = definition_kind_from(script.kind);
  return kind && is_shared(*kind) && !is_foreign(script.path);
}

DefinitionRecord record_of(const ScriptFile& file) {
  return {std::string(to_string(file.kind)), file.name, file.shown_path, file.source, file.hash};
}

std::vector<DefinitionRecord> shared_ones(const std::vector<DefinitionRecord>& scripts) {
  std::vector<DefinitionRecord> shared;
  std::ranges::copy_if(scripts, std::back_inserter(shared), is_of_all);
  return shared;
}

// What may be one LockedRun: options, and scripts that every episode is made of.
using Group = std::tuple<std::map<std::string, std::string>, Split, std::string>;

struct Seed {
  std::int64_t seed = 0, id = 0;
  std::size_t file = 0;  // of several that are asked as one
};
using Seeds = std::map<std::pair<std::string, std::string>, std::vector<Seed>>;  // by task and variation

// The scripts of runs that one library holds, and their episodes.
struct Portion {
  std::map<std::string, DefinitionRecord> scripts;  // by path
  Seeds seeds;

  bool takes(const StoredRun& run) const {
    return std::ranges::all_of(run.definitions, [&](const DefinitionRecord& one) {
      const auto found = scripts.find(one.path);
      return found == scripts.end() || found->second.hash == one.hash;
    });
  }
};

class Portions {
 public:
  // `asked`: the options that the run was asked for.
  void add(const StoredRun& run, const std::map<std::string, std::string>& asked, const EpisodeSummary& episode,
           std::size_t file) {
    const Split split = episode.seed >= kFirstTestSeed ? Split::test : Split::train;
    Portion*& portion = portion_of_[{run.hash, split, asked}];
    if (portion == nullptr) portion = &portion_for(run, {asked, split, definitions_hash(shared_ones(run.definitions))});
    portion->seeds[{episode.task, episode.variation}].push_back({episode.seed, episode.id, file});
  }
  const std::map<Group, std::deque<Portion>>& by_group() const { return portions_; }

 private:
  Portion& portion_for(const StoredRun& run, Group group) {
    std::deque<Portion>& portions = portions_[std::move(group)];
    const auto found = std::ranges::find_if(portions, [&](const Portion& one) { return one.takes(run); });
    Portion& portion = found != portions.end() ? *found : portions.emplace_back();
    for (const DefinitionRecord& one : run.definitions) portion.scripts.try_emplace(one.path, one);
    return portion;
  }
  std::map<Group, std::deque<Portion>> portions_;
  std::map<std::tuple<std::string, Split, std::map<std::string, std::string>>, Portion*> portion_of_;
};

// Arithmetic progressions, as long as they come.
template <typename Take>
void each_strand(Seeds seeds, const Take& take) {
  for (auto& [of, list] : seeds) {
    std::ranges::sort(list, {}, &Seed::seed);
    for (std::size_t begin = 0; begin < list.size();) {
      std::size_t end = begin + 1;
      const std::int64_t stride = end < list.size() ? list[end].seed - list[begin].seed : 1;
      while (end < list.size() && list[end].seed - list[end - 1].seed == stride) ++end;
      const auto count = static_cast<std::int64_t>(end - begin);
      take(SeedStrand{of.first, of.second, list[begin].seed, count > 1 ? stride : 1, count},
           std::span(list).subspan(begin, end - begin));
      begin = end;
    }
  }
}

std::string hash_of(std::span<const Seed> seeds, const std::vector<ContentHashes>& hashes) {
  Hasher hasher;
  for (const Seed& one : seeds) hasher.text(hashes[one.file].episodes.at(one.id));
  return hasher.digest().substr(0, 16);
}

[[noreturn]] void refuse(const std::string& file, const EpisodeSummary& episode, const std::string& why) {
  throw Error(file, fmt::format("episode {} ({}, seed {}): {}", episode.id, episode.task, episode.seed, why),
              "a lock holds what `stampede run` makes from scripts: keep the others in a file of their own");
}

// The options that runs were asked for: a record holds those that its task and world chose too. Which they were is
// known by an episode's key.
class AskedOptions {
 public:
  // Nothing: the episode was not made by a run from its scripts. Throws Error, as options_from().
  const std::map<std::string, std::string>* of(const StoredRun& run, const EpisodeSummary& episode) {
    std::vector<Asked>& known = by_run_[run.hash];
    if (known.empty()) known = candidates(run);
    const auto found = std::ranges::find_if(known, [&](const Asked& one) {
      return episode_key(run.definitions, {episode.task, episode.variation, episode.seed}, one.options) == episode.key;
    });
    return found == known.end() ? nullptr : &found->text;
  }

 private:
  struct Asked {
    std::map<std::string, std::string> text;
    RunOptions options;
  };
  static constexpr std::size_t kMostChosen = 8;

  static std::vector<Asked> candidates(const StoredRun& run) {
    std::vector<std::string> chosen;  // by the run, or by the task or world
    for (const auto& [name, value] : run.options)
      if (name.starts_with("observe_") && chosen.size() < kMostChosen) chosen.push_back(name);
    std::vector<Asked> all;
    for (std::size_t left_out = 0; left_out < std::size_t{1} << chosen.size(); ++left_out) {
      std::map<std::string, std::string> text = run.options;
      for (std::size_t i = 0; i < chosen.size(); ++i)
        if ((left_out >> i & 1) != 0) text.erase(chosen[i]);
      RunOptions options = options_from(text);
      all.push_back({std::move(text), std::move(options)});
    }
    return all;
  }
  std::map<std::string, std::vector<Asked>> by_run_;
};

void check_pictures(const Catalogue& catalogue, const std::string& file, const EpisodeSummary& episode,
                    const StoredRun& run) {
  if (run.options.contains("observe_images") || catalogue.images(episode.id).empty()) return;
  refuse(file, episode, "its pictures were drawn later, not by the run");
}

const StoredRun& run_of(const std::vector<StoredRun>& runs, const std::string& file, const EpisodeSummary& episode) {
  const auto found = std::ranges::lower_bound(runs, episode.run, {}, &StoredRun::hash);
  if (found == runs.end() || found->hash != episode.run)
    throw CatalogueError(file, fmt::format("episode {} names a run that is not there", episode.id),
                         "the file is damaged: generate it again");
  return *found;
}

void check_one_engine(const std::string& file, const std::vector<StoredRun>& runs) {
  for (const StoredRun& run : runs)
    if (run.engine.version != runs[0].engine.version || run.engine.numerics != runs[0].engine.numerics)
      throw Error(file,
                  run.engine.version != runs[0].engine.version
                      ? "episodes of the releases " + runs[0].engine.version + " and " + run.engine.version
                      : "episodes of two builds, or of two classes of processor",
                  "lock a catalogue whose episodes one release made on one class of processor");
}

bool is_acted(const StoredRun& run) {
  const auto behaviour = run.options.find("behaviour");
  return behaviour != run.options.end() && behaviour->second == "agent";
}

// Strictly: throws Error for an episode that no run makes again.
void add_portions(const Catalogue& catalogue, const std::vector<StoredRun>& runs, const std::string& file,
                  bool strictly, std::size_t number, Portions& portions) {
  if (strictly) check_one_engine(file, runs);
  AskedOptions asked;
  for (const EpisodeSummary& episode : catalogue.episodes()) {
    const StoredRun& run = run_of(runs, file, episode);
    const std::map<std::string, std::string>* options = nullptr;
    try {
      if (!episode.real && !is_acted(run)) options = asked.of(run, episode);
    } catch (const Error& error) {
      if (strictly) refuse(file, episode, error.message());
    }
    if (strictly && episode.real) refuse(file, episode, "it was recorded, not simulated");
    if (strictly && options == nullptr)
      refuse(file, episode, "an agent acted in it, and a lock has no room for what was done");
    if (strictly) check_pictures(catalogue, file, episode, run);
    portions.add(run, options != nullptr ? *options : run.options, episode, number);
  }
}

using ScriptPlaces = std::map<std::tuple<std::string, std::string, std::string>, std::size_t>;  // by kind, name, hash

}  // namespace

std::int64_t Lock::episodes() const {
  std::int64_t count = 0;
  for (const LockedRun& run : runs)
    for (const LockedStrand& strand : run.strands) count += strand.episodes.count;
  return count;
}

Lock lock_of(const Catalogue& catalogue, const std::string& file) {
  const std::vector<StoredRun> runs = catalogue.runs();
  Portions portions;
  add_portions(catalogue, runs, file, true, 0, portions);
  if (portions.by_group().empty()) throw Error(file, "it has no episodes", "lock it once something has been run");
  const std::vector<ContentHashes> hashes = {catalogue.content_hashes()};
  Lock lock;
  lock.engine = runs.front().engine;
  lock.hash = hashes[0].whole;
  ScriptPlaces places;
  for (const auto& [group, list] : portions.by_group())
    for (const Portion& portion : list)
      for (const auto& [path, script] : portion.scripts)
        if (places.try_emplace({script.kind, script.name, script.hash}, 0).second) lock.scripts.push_back(script);
  std::ranges::sort(lock.scripts, {}, [](const auto& one) { return std::tie(one.kind, one.name, one.hash); });
  for (std::size_t i = 0; i < lock.scripts.size(); ++i)
    places[{lock.scripts[i].kind, lock.scripts[i].name, lock.scripts[i].hash}] = i;
  for (const auto& [group, list] : portions.by_group()) {
    for (const Portion& portion : list) {
      LockedRun& run = lock.runs.emplace_back();
      std::tie(run.options, run.split, std::ignore) = group;
      for (const auto& [path, script] : portion.scripts)
        run.scripts.push_back(places.at({script.kind, script.name, script.hash}));
      std::ranges::sort(run.scripts);
      each_strand(portion.seeds, [&](const SeedStrand& strand, std::span<const Seed> seeds) {
        run.strands.push_back({strand, hash_of(seeds, hashes)});
      });
    }
  }
  return lock;
}

Lock plan_of(const Library& library, const JobList& jobs, const RunOptions& options, const EngineInfo& engine) {
  Lock plan;
  plan.engine = engine;
  LockedRun& run = plan.runs.emplace_back();
  run.options = options.as_text();
  run.split = options.split;
  static_cast<void>(options_from(run.options));  // throws for what makes nothing again
  std::vector<const ScriptFile*> files;
  bool imported = false;
  for (const SeedStrand& strand : jobs.strands()) {
    run.strands.push_back({strand, {}});
    const Library::TaskInfo& task = *library.task(strand.task);
    files.push_back(library.file(DefinitionKind::task, task.name));
    files.push_back(library.file(DefinitionKind::world, task.world));  // named by the task, or the usual one
    imported = imported || task.is_imported;
  }
  for (const ScriptFile* file : library.all_files())
    if (is_shared(file->kind) && !is_foreign(file->shown_path)) files.push_back(file);
  std::set<std::tuple<std::string, std::string, std::string>> known;
  for (const ScriptFile* file : library.used_by(files)) {
    if (file->kind == DefinitionKind::words || (is_foreign(file->shown_path) && !imported)) continue;
    DefinitionRecord script = record_of(*file);
    if (known.insert({script.kind, script.name, script.hash}).second) plan.scripts.push_back(std::move(script));
  }
  std::ranges::sort(plan.scripts, {}, [](const auto& one) { return std::tie(one.kind, one.name, one.hash); });
  run.scripts.resize(plan.scripts.size());
  std::iota(run.scripts.begin(), run.scripts.end(), std::size_t{0});
  return plan;
}

Roots roots_of(const Lock& lock, const LockedRun& run, const Roots& beside) {
  Roots roots{beside.folders, {}};
  for (const std::size_t place : run.scripts) {
    const DefinitionRecord& script = lock.scripts[place];
    roots.given.push_back({*definition_kind_from(script.kind), script.name, script.path, script.source});
  }
  return roots;
}

JobList jobs_of(const Library& library, const LockedRun& run, Shard shard) {
  std::vector<SeedStrand> strands;
  for (const LockedStrand& one : run.strands) strands.push_back(one.episodes);
  return {library, std::move(strands), shard};
}

std::string makes_other_data(const Lock& lock, const EngineInfo& here) {
  if (lock.engine.version != here.version)
    return "it was locked with release " + lock.engine.version + ", and this is " + here.version +
           ": physics and planners of another release need not do the same";
  if (lock.engine.numerics != here.numerics)
    return "it was locked by another build or on another class of processor, whose sums end in other digits";
  return {};
}

namespace {

// Of one group and variation: what is locked of it, and what is there.
struct Both {
  std::vector<const LockedStrand*> locked;
  std::vector<Seed> there;
};
using Whose = std::tuple<Group, std::string, std::string>;  // task, variation

Group group_of(const Lock& lock, const LockedRun& run) {
  std::vector<DefinitionRecord> scripts;
  for (const std::size_t place : run.scripts) scripts.push_back(lock.scripts[place]);
  return {run.options, run.split, definitions_hash(shared_ones(scripts))};
}

std::map<Whose, Both> side_by_side(const Lock& lock, const Portions& portions) {
  std::map<Whose, Both> both;
  for (const LockedRun& run : lock.runs) {
    const Group group = group_of(lock, run);
    for (const LockedStrand& strand : run.strands)
      both[{group, strand.episodes.task, strand.episodes.variation}].locked.push_back(&strand);
  }
  for (const auto& [group, list] : portions.by_group())
    for (const Portion& portion : list)
      for (const auto& [of, seeds] : portion.seeds) {
        std::vector<Seed>& there = both[{group, of.first, of.second}].there;
        there.insert(there.end(), seeds.begin(), seeds.end());
      }
  return both;
}

std::vector<std::string> scripts_of_one_alone(const Lock& lock, const Portions& portions) {
  std::map<std::string, std::set<std::string>> locked, there;  // hashes by path
  for (const DefinitionRecord& script : lock.scripts) locked[script.path].insert(script.hash);
  for (const auto& [group, list] : portions.by_group())
    for (const Portion& portion : list)
      for (const auto& [path, script] : portion.scripts) there[path].insert(script.hash);
  std::vector<std::string> paths;
  for (const auto& [path, hashes] : there)
    if (const auto found = locked.find(path); found == locked.end() || found->second != hashes) paths.push_back(path);
  return paths;
}

}  // namespace

LockCheck verify(const Lock& lock, const std::vector<const Catalogue*>& catalogues) {
  Portions portions;
  std::vector<ContentHashes> hashes;
  for (const Catalogue* catalogue : catalogues) {
    add_portions(*catalogue, catalogue->runs(), "", false, hashes.size(), portions);
    hashes.push_back(lock.is_plan() ? ContentHashes() : catalogue->content_hashes());
  }
  LockCheck check;
  const auto add = [](const Whose& whose, const std::vector<Seed>& seeds, std::vector<SeedStrand>& to) {
    each_strand({{{std::get<1>(whose), std::get<2>(whose)}, seeds}},
                [&](const SeedStrand& strand, std::span<const Seed>) { to.push_back(strand); });
  };
  for (const auto& [whose, both] : side_by_side(lock, portions)) {
    std::map<std::int64_t, std::vector<Seed>> there;  // by seed; of the same start several where scripts differ
    for (const Seed& one : both.there) there[one.seed].push_back(one);
    std::vector<Seed> missing;
    for (const LockedStrand* strand : both.locked) {
      std::vector<Seed> found;
      for (std::int64_t i = 0; i < strand->episodes.count; ++i) {
        const std::int64_t seed = strand->episodes.first_seed + i * strand->episodes.stride;
        const auto at = there.find(seed);
        if (at == there.end())
          missing.push_back({seed});
        else
          found.push_back(at->second.front());
      }
      for (const Seed& one : found) there.erase(one.seed);
      const auto count = static_cast<std::int64_t>(found.size());
      if (lock.is_plan())
        check.same += count;
      else if (count == strand->episodes.count && hash_of(found, hashes) != strand->hash)
        check.other.push_back(strand->episodes);
      else if (count == strand->episodes.count)
        check.same += count;
    }
    add(whose, missing, check.missing);
    std::vector<Seed> further;
    for (const auto& [seed, list] : there) further.push_back(list.front());
    add(whose, further, check.further);
  }
  const bool complete = check.missing.empty() && check.other.empty();
  check.whole =
      complete && (lock.is_plan() || (check.further.empty() && (hashes.size() > 1 || hashes.at(0).whole == lock.hash)));
  if (!check.whole) check.other_scripts = scripts_of_one_alone(lock, portions);
  return check;
}

}  // namespace stampede
