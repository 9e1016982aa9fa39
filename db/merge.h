// Many catalogues into one, by key.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace stampede {

struct MergedFile {
  std::string path;
  std::int64_t added = 0, existing = 0;  // existing: the same episodes were there already
  std::vector<std::string> own_tables;   // of its owner's (own_…): not copied
};
struct MergeResult {
  std::vector<MergedFile> files;  // as given
  bool interrupted = false;       // the same call goes on from there
};

struct MergeOptions {
  // Also what two versions of a script, two releases or two classes of processor made.
  bool mixed = false;
  const std::atomic<bool>* stop = nullptr;
};

// Adds the episodes of `from` to `into`, which is made when it is not there. Catalogues of earlier releases are
// read as they are. Repeatable: the content hash is that of one run which made all episodes. Throws:
// CatalogueError, before anything is written, when two files have other content under the same key, or, not `mixed`,
// when they were made differently; it names both. What Catalogue::open() throws.
MergeResult merge(const std::filesystem::path& into, const std::vector<std::filesystem::path>& from,
                  const MergeOptions& options = {});

}  // namespace stampede
