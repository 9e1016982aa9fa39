#include <fmt/format.h>

#include <ostream>
#include <set>

#include "db/stored_episode.h"
#include "engine/base/file_name.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/export_kinds.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/session/stored_symbols.h"

namespace stampede::program {
namespace {

std::vector<BddlMapping> chosen_mappings(const Arguments& arguments) {
  const std::string dialect = arguments.text("--dialect");
  const auto library = words_of(arguments);
  if (arguments.has("--mapping")) {
    std::vector<BddlMapping> mappings = {read_bddl_mapping(*library, arguments.text("--mapping"))};
    if (dialect != "both" && dialect != dialect_name(mappings[0].dialect))
      throw UsageError("--mapping is for " + dialect_name(mappings[0].dialect) + ", not for " + dialect,
                       "leave --dialect out");
    return mappings;
  }
  return bddl_mappings_of(*library, dialect);
}

class BddlExporter {
 public:
  explicit BddlExporter(const ExportJob& job)
      : job_(job), mappings_(chosen_mappings(job.arguments)), folder_(indexed_folder(job, index_)) {}

  ExportCount run() {
    for (const std::int64_t id : job_.episodes) {
      if (job_.console.stopped()) break;
      const StoredEpisode stored = read_stored(job_.catalogue, id);
      for (const BddlMapping& mapping : mappings_) write(stored, mapping);
    }
    write_index(folder_, index_);
    return count_;
  }

 private:
  void write(const StoredEpisode& stored, const BddlMapping& mapping) {
    const EpisodeRecord& episode = stored.episode;
    const std::int64_t frame = *job_.arguments.integer("--frame");
    BddlExport result;
    try {
      if (stored.scene == nullptr) throw Error("", stored.why_not);
      const StoredSymbols symbols = read_symbols(episode);
      const AbstractState state = abstract_state(episode, frame);
      result = bddl_at({episode, *stored.scene, symbols, state}, mapping, job_.arguments.list("--leave-out"));
    } catch (const Error& error) {
      result.refusal = error.message();
    }
    const std::string dialect = dialect_name(mapping.dialect);
    std::string file;
    if (result.refusal.empty()) {
      file = put(stored.id, episode.task, result);
    } else {
      ++count_.left_out;
      job_.console.err << "episode " << stored.id << ", " << dialect << ": " << result.refusal << "\n";
    }
    std::string notes;
    for (const BddlNote& note : result.notes) notes += (notes.empty() ? "" : "; ") + to_text(note);
    index_.rows.push_back(
        {file, dialect, stored.id, episode.task, episode.variation, episode.seed, frame, result.refusal, notes});
  }

  // As their loaders look for them: LIBERO's by the words of the instruction, BEHAVIOR's by activity and number.
  std::string put(std::int64_t id, const std::string& task, BddlExport& result) {
    std::string file = fmt::format("libero/e{:05}/{}", id, file_name(result.file_name));
    if (result.problem.dialect == BddlDialect::behavior) {
      const int number = numbers_[task]++;
      result.problem.name = fmt::format("{}-{}", task, number);
      result.text = to_bddl(result.problem);
      file = fmt::format("behavior/{}/problem{}.bddl", file_name(task), number);
    }
    folder_.write(file, with_notes(result));
    ++count_.files;
    return file;
  }

  const ExportJob& job_;
  std::vector<BddlMapping> mappings_;
  std::map<std::string, int> numbers_;  // by task
  QueryResult index_{{"file", "dialect", "episode", "task", "variation", "seed", "frame", "refusal", "notes"}, {}};
  OutputFolder folder_;
  ExportCount count_;
};

}  // namespace

ExportCount export_bddl_files(const ExportJob& job) { return BddlExporter(job).run(); }

}  // namespace stampede::program
