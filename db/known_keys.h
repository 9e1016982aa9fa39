// Which episodes several catalogues hold, each once. Inside this room only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "db/catalogue.h"

namespace stampede {

// Throws CatalogueError naming both files: `episode` of this one is in the other too, by that number, with other
// content.
[[noreturn]] void refuse_other_content(const std::string& path, const EpisodeSummary& episode, const std::string& other,
                                       std::int64_t there);

// Lifetime: the catalogues, which stay where they are.
class KnownKeys {
 public:
  void own(const Catalogue& catalogue, const std::filesystem::path& path);
  // The ids of what nobody has yet; `existing` grows by what another file has. Throws CatalogueError naming both files
  // where two have other content under one key.
  std::vector<std::int64_t> add(const Catalogue& catalogue, const std::filesystem::path& path, std::int64_t& existing);

 private:
  struct Owner {  // the first that has a key
    const Catalogue* catalogue = nullptr;
    std::string path;
    std::int64_t id = 0;
  };
  std::map<std::string, Owner> owners_;
};

}  // namespace stampede
