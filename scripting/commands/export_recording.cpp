// Episodes as recording folders: the form in which recordings of real robots come in.
#include "db/recording/export_recording.h"

#include <fmt/format.h>

#include <ostream>

#include "db/stored_episode.h"
#include "scripting/commands/export_kinds.h"

namespace stampede::program {
namespace {

namespace fs = std::filesystem;

// Files of one recording beside those of another would read as one, and what a robot recorded cannot be made again.
void require_room(const fs::path& folder) {
  std::error_code ignored;
  if (!fs::exists(folder, ignored)) return;
  if (!fs::is_directory(folder, ignored))
    throw Error(folder.string(), "this is a file, and a recording is a folder", "name a new folder as --out");
  if (fs::is_empty(folder, ignored)) return;
  throw Error(folder.string(), "this folder is not empty, and a recording is not written over others",
              "name a new folder as --out");
}

}  // namespace

ExportCount export_recordings(const ExportJob& job) {
  require_room(job.folder);
  ExportCount count;
  for (const std::int64_t id : job.episodes) {
    if (job.console.stopped()) break;
    const StoredEpisode stored = read_stored(job.catalogue, id);
    if (!stored.scene) {
      job.console.err << fmt::format("episode {} is left out: {}\n", id, stored.why_not);
      ++count.left_out;
      continue;
    }
    const fs::path folder = job.episodes.size() == 1 ? job.folder : job.folder / fmt::format("episode_{:06}", id);
    count.files += export_recording(job.catalogue, stored, folder);
  }
  return count;
}

}  // namespace stampede::program
