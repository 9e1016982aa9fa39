// Functions of ours for questions in SQL, where SQLite has none: db/README.md describes them. Inside this room only.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

namespace stampede::sql {

// For statements of this connection, not for what a file declares.
void add_functions(sqlite3* handle);

// `file_of` and `number_in_file` of an episode. Nothing: there is no such episode.
struct Origin {
  std::string file;
  std::int64_t episode = 0;  // its number there
};
using OriginOf = std::function<std::optional<Origin>(std::int64_t episode)>;
void add_origins(sqlite3* handle, OriginOf origin_of);

}  // namespace stampede::sql
