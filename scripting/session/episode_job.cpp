#include "scripting/session/episode_job.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <tuple>

#include "engine/base/hash.h"
#include "engine/base/names.h"
#include "engine/base/naming.h"
#include "engine/base/text.h"
#include "scripting/runtime/script_error.h"
#include "scripting/session/bddl_task_file.h"
#include "scripting/session/made_sentences.h"

namespace stampede {
namespace {

void hash_asked(Hasher& hasher, const AskedAction& one) {
  const auto list = [&](const auto& items, const auto& add) {
    hasher.number(items.size());
    for (const auto& item : items) add(item);
  };
  const auto number = [&](double value) { hasher.number(value); };
  const auto text = [&](const std::string& value) { hasher.text(value); };
  const auto maybe = [&](const std::optional<double>& value) {
    hasher.number<std::uint8_t>(value.has_value()).number(value.value_or(0));
  };
  const AgentAction& asked = one.asked;
  hasher.number(one.first_frame).number(one.end_frame).number(one.segment).text(asked.space);
  list(asked.values, number);
  maybe(asked.gripper);
  hasher.text(asked.frame).text(asked.controller).number(asked.frames).text(asked.skill);
  list(asked.arguments, text);
  list(asked.parameters, [&](const SkillParameter& parameter) {
    hasher.text(parameter.name);
    list(parameter.values, number);
  });
  maybe(one.reward);
}

// The key holds the task alone, so that every run of a task meets its variations in one order.
std::vector<std::string> shuffled(std::vector<std::string> variations, const std::string& task) {
  Random(RandomKey("variations").with(task)).shuffle(variations);
  return variations;
}

bool agrees(const std::map<std::string, std::string>& axes, const std::vector<std::string>& parts) {
  return std::all_of(parts.begin(), parts.end(), [&](const std::string& part) {
    const std::size_t equals = part.find('=');
    if (equals == std::string::npos) return false;
    const auto axis = axes.find(part.substr(0, equals));
    return axis != axes.end() && axis->second == part.substr(equals + 1);
  });
}

}  // namespace

const Library::TaskInfo& task_info(const Library& library, const std::string& name) {
  if (const ScriptFile* file = library.file(DefinitionKind::task, name)) library.require_sound({file});
  if (const Library::TaskInfo* task = library.task(name)) return *task;
  throw Error("", "there is no task '" + name + "'", did_you_mean(name, names_of(library.files(DefinitionKind::task))));
}

std::vector<std::string> matching_variations(const Library::TaskInfo& task, const std::string& text) {
  if (text.empty()) return task.variation_texts;
  const std::vector<std::string> parts = split(text, ',');
  std::vector<std::string> found;
  for (std::size_t i = 0; i < task.variation_texts.size(); ++i) {
    if (task.variation_texts[i] == text || agrees(task.variations[i], parts)) found.push_back(task.variation_texts[i]);
  }
  if (!found.empty()) return found;
  throw Error("--variation", "task '" + task.name + "' has no variation '" + text + "'",
              did_you_mean(text, task.variation_texts));
}

Shard shard_from(const std::string& text) {
  Shard shard;
  const std::size_t slash = text.find('/');
  const auto number = [&](std::string_view part, std::int64_t& value) {
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    return error == std::errc() && !part.empty() && end == part.data() + part.size();
  };
  const std::string_view all = text;
  if (slash == std::string::npos || !number(all.substr(0, slash), shard.index) ||
      !number(all.substr(slash + 1), shard.count))
    throw Error("--shard", "'" + text + "' is no shard", "write I/N, such as 2/8: the second of eight parts");
  check_shard(shard, "--shard");
  return shard;
}

void check_shard(Shard shard, const std::string& where) {
  const std::string count = std::to_string(shard.count);
  if (shard.count < 1) throw Error(where, "a run has at least one part, not " + count);
  if (shard.index < 1 || shard.index > shard.count)
    throw Error(where, "there is no part " + std::to_string(shard.index) + "/" + count,
                "parts count from 1/" + count + " to " + count + "/" + count);
}

JobList::JobList(const Library& library, const JobRequest& request) : shard_(request.shard) {
  std::vector<SeedStrand> strands;
  for (const std::string& name : std::set<std::string>(request.tasks.begin(), request.tasks.end())) {
    const Library::TaskInfo& task = task_info(library, name);
    std::vector<std::string> variations = shuffled(task.variation_texts, name);
    if (!request.variation.empty() || request.variations) {
      const std::vector<std::string> wanted =
          request.variations ? request.variations->at(name) : matching_variations(task, request.variation);
      std::erase_if(variations, [&](const std::string& v) { return std::ranges::find(wanted, v) == wanted.end(); });
    }
    const auto stride = static_cast<std::int64_t>(variations.size());
    for (std::int64_t i = 0; i < std::min(stride, request.episodes); ++i)
      strands.push_back({name, variations[static_cast<std::size_t>(i)], request.first_seed + i, stride,
                         (request.episodes - i + stride - 1) / stride});
  }
  arrange(std::move(strands));
}

JobList::JobList(const Library& library, std::vector<SeedStrand> strands, Shard shard) : shard_(shard) {
  for (const SeedStrand& strand : strands) {
    const std::vector<std::string>& known = task_info(library, strand.task).variation_texts;
    if (std::ranges::find(known, strand.variation) == known.end())
      throw Error("", "task '" + strand.task + "' has no variation '" + strand.variation + "'",
                  did_you_mean(strand.variation, known));
  }
  arrange(std::move(strands));
}

void JobList::arrange(std::vector<SeedStrand> strands) {
  std::ranges::sort(strands);
  for (SeedStrand& strand : strands) {
    const std::int64_t count = strand.count;
    strands_.push_back({std::move(strand), whole_});
    whole_ += count;
  }
}

std::int64_t JobList::size() const { return (whole_ - shard_.index + shard_.count) / shard_.count; }

const JobList::Strand& JobList::strand_at(std::int64_t place) const {
  const auto after = std::upper_bound(strands_.begin(), strands_.end(), place,
                                      [](std::int64_t value, const Strand& strand) { return value < strand.begin; });
  return *std::prev(after);
}

EpisodeJob JobList::operator[](std::int64_t index) const {
  const std::int64_t place = shard_.index - 1 + index * shard_.count;
  const Strand& strand = strand_at(place);
  return {strand.task, strand.variation, strand.first_seed + (place - strand.begin) * strand.stride};
}

std::vector<SeedStrand> JobList::strands() const { return {strands_.begin(), strands_.end()}; }

std::vector<EpisodeJob> JobList::first_of_each_task() const {
  std::vector<EpisodeJob> jobs;
  for (const Strand& strand : strands_)
    if (jobs.empty() || jobs.back().task != strand.task)
      jobs.push_back({strand.task, strand.variation, strand.first_seed});
  return jobs;
}

void check_split(Split split, std::int64_t first_seed, std::int64_t last_seed) {
  const bool test = split == Split::test;
  const std::string border = std::to_string(kFirstTestSeed);
  if (first_seed < 0) throw Error("--seed", "a seed is 0 or more, not " + std::to_string(first_seed));
  if (!test && last_seed >= kFirstTestSeed) {
    throw Error("--seed", "seeds from " + border + " up belong to the test split",
                "say --split test, or stay below " + border);
  }
  if (test && first_seed < kFirstTestSeed) {
    throw Error("--seed", "the test split has seeds from " + border + " up, not " + std::to_string(first_seed),
                "leave --seed out, or leave --split test out");
  }
}

namespace {

Hasher hashed(const std::vector<DefinitionRecord>& definitions) {
  std::set<std::string> hashes;
  for (const DefinitionRecord& one : definitions) hashes.insert(one.kind + " " + one.name + " " + one.hash);
  Hasher hasher;
  for (const std::string& one : hashes) hasher.text(one);
  return hasher;
}

}  // namespace

std::string definitions_hash(const std::vector<DefinitionRecord>& definitions) { return hashed(definitions).digest(); }

std::string episode_key(const std::vector<DefinitionRecord>& definitions, const EpisodeJob& job,
                        const RunOptions& options) {
  Hasher hasher = hashed(definitions);
  hasher.text(job.task).text(job.variation).number(job.seed);
  for (const auto& [name, value] : options.as_text()) hasher.text(name).text(value);
  return hasher.digest();
}

std::string acted_key(const EpisodeRecord& record) {
  Hasher hasher;
  hasher.text(record.made.key);
  for (const auto& [name, value] : record.made.options) hasher.text(name).text(value);
  for (const Command& command : record.commands)
    hasher.number(command.step).text(operation_kind(command.operation)).text(operation_to_bytes(command.operation));
  for (const AskedAction& one : record.agent_actions) hash_asked(hasher, one);
  return hasher.digest();
}

PreparedEpisode::PreparedEpisode(std::shared_ptr<const Library> library, EpisodeJob job, RunOptions options,
                                 std::shared_ptr<Assets> assets)
    : library_(std::move(library)),
      job_(std::move(job)),
      options_(std::move(options)),
      scripts_(library_, job_, further_things(options_.perturb), std::move(assets)) {
  options_.seed = job_.seed;
  definitions_ = scripts_.definitions();
  key_ = episode_key(definitions_, job_, options_);
}

EpisodeRecord PreparedEpisode::run(const std::atomic<bool>* stop) {
  EpisodeRecord record;
  try {
    record = run_episode(scripts_.task(), scripts_.symbols(), scripts_.skills(), options_, stop);
  } catch (const ScriptError& error) {
    record = failed(Reason::script_error, error.what());
  }
  complete(record);
  return record;
}

EpisodeRecord PreparedEpisode::failed(Reason reason, const std::string& detail) {
  EpisodeRecord record;
  record.axes = scripts_.task()(0).axes;
  record.made.options = options_.as_text();
  record.reason = reason;
  record.detail = detail;
  return record;
}

void PreparedEpisode::complete(EpisodeRecord& record) const {
  record.made.key = key_;
  record.task = job_.task;
  record.variation = job_.variation;
  record.seed = job_.seed;
  record.made.split = options_.split;
  record.made.definitions = definitions_;
  if (options_.sentences) add_sentences(*options_.sentences, *library_, record);
  if (options_.goal || record.frames.empty()) return;
  if (const auto imported = imported_problem(library_, job_.task))
    record.labels.verdicts = {bddl_verdict(record, *imported)};
}

}  // namespace stampede
