// Episodes as recording folders: the form in which recordings of real robots come in.
#include "scripting/recording/export_recording.h"

#include <fmt/format.h>

#include <ostream>

#include "scripting/commands/export_kinds.h"
#include "scripting/session/stored_episode.h"

namespace stampede::program {

ExportCount export_recordings(const ExportJob& job) {
  ExportCount count;
  for (const std::int64_t id : job.episodes) {
    if (job.console.stopped()) break;
    const StoredEpisode stored = read_stored(job.catalogue, id);
    if (!stored.scene) {
      job.console.err << fmt::format("episode {} is left out: {}\n", id, stored.why_not);
      ++count.left_out;
      continue;
    }
    const std::filesystem::path folder =
        job.episodes.size() == 1 ? job.folder : job.folder / fmt::format("episode_{:06}", id);
    count.files += export_recording(job.catalogue, stored, folder);
  }
  return count;
}

}  // namespace stampede::program
