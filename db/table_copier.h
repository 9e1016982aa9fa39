// Rows of one catalogue into another, value by value: neither file sees the other. Inside this room only.
#pragma once

#include <cstdint>

#include "db/schema.h"
#include "db/sqlite.h"

namespace stampede {

// Lifetime: both databases.
class TableCopier {
 public:
  TableCopier(const sql::Database& from, const sql::Database& to, const Table& table);
  void copy_episode(std::int64_t there, std::int64_t here);  // of a table of episodes: the rows of one
  void copy_shared();                                        // of any other: what is not here yet

 private:
  void put(sql::Statement& row, int first);

  sql::Statement rows_, write_;
  int columns_ = 0;
};

// What episodes share by hash or name, such as scripts, scenes, texts. Splits are the same everywhere.
bool is_shared(const Table& table);

// Throws CatalogueError naming both files where they say different things of one variation.
void check_variations(const sql::Database& from, const sql::Database& to);

}  // namespace stampede
