// What the sources of Catalogue share.
#pragma once

#include <memory>
#include <string>

#include "db/catalogue.h"
#include "db/sqlite.h"

namespace stampede {

class EpisodeWriter;

struct Catalogue::Impl {
  Impl();
  ~Impl();
  sql::Database database;
  bool writable = false;
  std::unique_ptr<EpisodeWriter> writer;  // made at the first add(); its statements must go before the database
};

// Lists of texts as JSON in a column.
std::string to_json_list(const std::vector<std::string>& texts);
std::vector<std::string> from_json_list(const sql::Database& database, const std::string& json);

// Scene documents: what many share (shapes, grasps, the robot) is cut out and kept once, by hash.
struct PackedScene {
  std::string document;
  std::vector<std::pair<std::string, std::string>> assets;  // hash, text
};
PackedScene pack_scene(std::string_view document);
std::string unpack_scene(const sql::Database& database, const std::string& packed);

}  // namespace stampede
