// How a catalogue of an earlier release becomes one of this release. Inside this room only.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "db/sqlite.h"
#include "engine/base/scratch_folder.h"

namespace stampede {

// Schemas that users have files of, the oldest first: those that a migration begins from.
const std::vector<int>& earlier_releases();

// Runs the numbered migrations between two schemas, inside the caller's transaction.
void migrate(const sql::Database& database, int from, int to);

// A database that shows the file at `uri` as one of this release without changing it: the tables that migrations
// change are copied into a temporary database and migrated there, the others are read where they are. What is counted
// from pictures is left out. Lifetime: reads the file as long as it lives.
sql::Database migrated_to_read(const std::string& uri, int flags, const std::string& shown_path, int schema);

// Everything that is committed in `file`, in a new file without a log. Throws CatalogueError when there is no room.
void copy_database(const std::filesystem::path& file, const std::filesystem::path& copy);

// A copy of the file that goes with its owner or, when the program dies, stays beside the file until it is migrated:
// SQLite's own log brings the file back, the copy is for disks that lie. Throws CatalogueError when there is no room.
class KeptCopy {
 public:
  explicit KeptCopy(const std::filesystem::path& file) : folder_(file) { copy_database(file, folder_.file()); }

 private:
  ScratchFolder folder_;
};

}  // namespace stampede
