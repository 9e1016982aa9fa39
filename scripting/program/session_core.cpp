#include "scripting/program/session_core.h"

#include "db/catalogue_writer.h"
#include "scripting/program/episode_job.h"
#include "scripting/program/numerics.h"
#include "scripting/program/roots.h"

namespace stampede {

SessionCore::SessionCore(const std::filesystem::path& root, const std::vector<std::filesystem::path>& paths,
                         std::filesystem::path catalogue)
    : library_(Library::load(make_roots(root, paths))), catalogue_(std::move(catalogue)) {}

std::vector<std::string> SessionCore::tasks() const {
  std::vector<std::string> names;
  for (const ScriptFile* file : library_->files(DefinitionKind::task)) names.push_back(file->name);
  return names;
}

std::vector<std::string> SessionCore::variations(const std::string& task) const {
  return task_info(*library_, task).variation_texts;
}

std::optional<Episode> SessionCore::stored(const std::string& key) const {
  if (catalogue_.empty() || !std::filesystem::exists(catalogue_)) return std::nullopt;
  const Catalogue catalogue = Catalogue::open(catalogue_);
  const std::optional<std::int64_t> id = catalogue.find(key);
  if (!id) return std::nullopt;
  const EpisodeRecord record = catalogue.read_episode(*id);
  Episode episode;
  episode.id = *id;
  episode.key = key;
  episode.task = record.task;
  episode.variation = record.variation;
  episode.seed = record.seed;
  episode.outcome = record.outcome;
  episode.reason = to_string(record.reason);
  episode.detail = record.detail;
  episode.frames = static_cast<std::int64_t>(record.frames.size());
  episode.duration_s = static_cast<double>(record.steps) / record.physics_hz;
  episode.undone = static_cast<int>(record.attempts.size());
  return episode;
}

Episode SessionCore::run(const std::string& task_name, const EpisodeRequest& request) const {
  const std::vector<std::string> variations = matching_variations(task_info(*library_, task_name), request.variation);
  RunOptions options;
  options.on_failure = request.on_failure;
  options.controller = request.controller;
  options.split = request.seed >= kFirstTestSeed ? "test" : "train";
  check_split(options.split, request.seed, request.seed);
  PreparedEpisode prepared(library_, {task_name, variations.empty() ? "" : variations.front(), request.seed}, options);
  if (auto episode = stored(prepared.key())) return *episode;
  EpisodeRecord record = prepared.run(nullptr);
  Episode episode{0,
                  record.key,
                  record.task,
                  record.variation,
                  record.seed,
                  record.outcome,
                  std::string(to_string(record.reason)),
                  record.detail,
                  static_cast<std::int64_t>(record.frames.size()),
                  static_cast<double>(record.steps) / record.physics_hz,
                  static_cast<int>(record.attempts.size())};
  if (catalogue_.empty()) return episode;
  Catalogue catalogue = Catalogue::write(catalogue_);
  episode.id = catalogue.add(record, {STAMPEDE_VERSION, numerics_probe()});
  catalogue.close();
  return episode;
}

QueryResult SessionCore::query(std::string_view question) const {
  if (catalogue_.empty()) throw Error("Session", "it has no catalogue to ask", "set SessionOptions::catalogue");
  return Catalogue::open(catalogue_).query(question);
}

}  // namespace stampede
