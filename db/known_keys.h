// Which episodes several catalogues hold, each once. Inside this room only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "db/catalogue.h"

namespace stampede {

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
