// Recordings of real robots, and labels by people or models.
#include <fmt/format.h>

#include <ostream>

#include "db/catalogue.h"
#include "db/recording/import_recording.h"
#include "db/recording/label_file.h"
#include "db/recording/recording_file.h"
#include "engine/record/observation.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/import_kinds.h"
#include "scripting/commands/recording_stage.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

struct Imported {
  std::string folder;
  std::int64_t episode = 0;
  bool added = false;  // false: it was there already
  std::int64_t frames = 0, pictures = 0;
  double duration_s = 0;
  std::vector<StreamRecord> streams;
  std::vector<std::string> notes;
};

Imported import_one(const std::string& folder, Catalogue& catalogue, const RecordingStager& stager,
                    const ImportOptions& options) {
  const StoredRecording stored = store_recording(folder, stager, options, catalogue, this_engine());
  const EpisodeRecord& record = stored.episode;
  Imported one;
  one.folder = folder;
  one.frames = static_cast<std::int64_t>(record.frames.size());
  one.pictures = record.images ? static_cast<std::int64_t>(record.images->count()) : 0;
  one.duration_s = record.duration_s();
  one.streams = record.streams;
  one.notes = stored.notes;
  one.added = stored.added;
  one.episode = stored.id;
  return one;
}

void print(const Imported& one, Console& console) {
  console.out << fmt::format("{}: episode {}{}, {:.1f} s, {} frames, {} pictures\n", one.folder, one.episode,
                             one.added ? "" : " (there already)", one.duration_s, one.frames, one.pictures);
  for (const std::string& note : one.notes) console.err << "  " << note << "\n";
  for (const StreamRecord& stream : one.streams) {
    const std::string name = stream.name == stream.kind ? stream.kind : stream.kind + " " + stream.name;
    console.err << fmt::format("  {}: {} readings, {:.1f} Hz, longest gap {:.3f} s", name, stream.readings,
                               stream.rate_hz, stream.longest_gap_s);
    if (stream.rule != "kept") console.err << fmt::format(", {} frames without", stream.missing);
    console.err << "\n";
  }
}

void print_json(const std::vector<Imported>& all, Console& console) {
  JsonText json;
  json.object().key("recordings").array();
  for (const Imported& one : all) {
    json.object().field("folder", one.folder).field("episode", one.episode).field("added", one.added);
    json.field("duration_s", one.duration_s).field("frames", one.frames).field("pictures", one.pictures);
    json.key("streams").array();
    for (const StreamRecord& stream : one.streams)
      json.object()
          .field("kind", stream.kind)
          .field("name", stream.name)
          .field("readings", stream.readings)
          .field("rate_hz", stream.rate_hz)
          .field("longest_gap_s", stream.longest_gap_s)
          .field("missing", stream.missing)
          .end();
    json.end().end();
  }
  console.out << json.end().end().text();
}

}  // namespace

ExitCode import_recordings(const Arguments& arguments, Console& console) {
  std::vector<std::string> folders = arguments.list("FILE");
  folders.erase(folders.begin());
  if (folders.empty())
    throw UsageError("stampede import recording needs a FOLDER", "name folders with a recording.json");
  ImportOptions options;
  options.workers = workers_of(arguments);
  if (arguments.has("--frame-hz"))
    options.frame_hz = static_cast<int>(in_range(arguments, "--frame-hz", 1, kMostFrameHz));
  if (arguments.has("--world")) options.world = arguments.text("--world");
  const RecordingStager stager = stager_of(load_library(arguments));
  const std::filesystem::path out = arguments.text("--out");
  const bool is_new = !std::filesystem::exists(out);
  Catalogue catalogue = Catalogue::write(out, Journal::in_place);
  std::vector<Imported> all;
  try {
    for (const std::string& folder : folders) {
      if (console.stopped()) break;
      all.push_back(import_one(folder, catalogue, stager, options));
      if (!arguments.flag("--json")) print(all.back(), console);
    }
  } catch (const std::exception&) {  // a mistake, or an end that was asked for
    const bool nothing = is_new && catalogue.episodes().empty();
    catalogue.close();
    std::error_code ignored;
    if (nothing) std::filesystem::remove(out, ignored);
    throw;
  }
  catalogue.close();
  if (arguments.flag("--json")) print_json(all, console);
  if (console.stopped()) console.err << "interrupted: what is stored stays, and the same command goes on from there\n";
  return console.stopped() ? kInterrupted : kDone;
}

ExitCode import_labels(const Arguments& arguments, Console& console) {
  const std::vector<std::string>& words = arguments.list("FILE");
  if (words.size() != 3) throw UsageError("write: stampede import labels FILE CATALOGUE --episode N");
  if (!arguments.has("--episode")) throw UsageError("stampede import labels needs --episode N");
  const std::int64_t id = in_range(arguments, "--episode", 1, std::int64_t{1} << 40);
  if (!std::filesystem::exists(words[2])) Catalogue::open(words[2]);  // says what is wrong
  Catalogue catalogue = Catalogue::write(words[2]);
  EpisodeRecord episode = catalogue.read_episode(id);
  if (!episode.real)
    throw UsageError("episode " + std::to_string(id) + " is simulated: its labels are the simulator's",
                     "name an episode whose source is real");
  const Labels labels = read_labels(words[1], words[1], episode);
  put_labels(labels, episode);
  catalogue.set_labels(id, episode);
  catalogue.close();
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("episode", id).field("segments", static_cast<std::int64_t>(labels.segments.size()));
    json.field("facts", static_cast<std::int64_t>(labels.facts.size()));
    console.out << json.field("sentences", static_cast<std::int64_t>(labels.language.size())).end().text();
  } else {
    console.out << fmt::format("episode {}: {} segments, {} facts, {} sentences\n", id, labels.segments.size(),
                               labels.facts.size(), labels.language.size());
  }
  return kDone;
}

}  // namespace stampede::program
