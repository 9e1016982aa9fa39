// Writes what many episodes share: each is stored once, by its hash or name.
#pragma once

#include <string>

#include "db/catalogue.h"
#include "db/sqlite.h"

namespace stampede {

class SharedWriter {
 public:
  explicit SharedWriter(const sql::Database& database);
  void write_variation(const EpisodeRecord& episode);
  std::string write_engine_run(const EpisodeRecord& episode, const EngineInfo& engine);  // its hash
  std::string write_scene(const std::string& document);                                  // its hash

 private:
  const sql::Database& database_;
  sql::Statement definition_, engine_run_, engine_run_definition_, predicate_, variation_, variation_axis_, scene_,
      asset_;
};

}  // namespace stampede
