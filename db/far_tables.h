// Tables whose rows stay in other files, as tables of this connection. Inside this room only.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "db/schema.h"
#include "db/sqlite.h"

namespace stampede {

// Where an episode's rows are: a database that lives as long as this, and the episode's number there. No database:
// there is no such episode. Throws where it cannot be had.
struct FarEpisode {
  std::shared_ptr<const sql::Database> database;
  std::int64_t there = 0;
};
using FindsFar = std::function<FarEpisode(std::int64_t episode)>;

// The table under its own name for whoever asks this connection: its rows are read where they lie, episode by episode,
// and of none but those that a question names. Episodes are those of the table `episode`.
// Lifetime: the database stays where it is.
void add_far_table(const sql::Database& database, const Table& table, FindsFar find);

}  // namespace stampede
