// The tables of this build, and what tells whether a file has them. Inside this room only.
#pragma once

#include <string>
#include <vector>

#include "db/sqlite.h"

namespace stampede {

// Tables of this name are a user's own: plain columns, neither checked nor hashed, and merging leaves them behind.
inline constexpr const char* kOwnPrefix = "own_";

struct Table {
  std::string name;
  std::vector<std::string> columns, order;  // but the episode's number; of the key, or all
  bool of_episode = false;                  // has a column `episode`, or is the table of episodes
};
std::string quoted_columns(const std::vector<std::string>& columns);  // with commas

const std::string& current_tables_hash();                 // of the files in db/schema, but for comments and spaces
const std::vector<Table>& current_tables();               // by name: as we declare them, whatever a file says
const std::string& derived_sql(const std::string& name);  // of a file in db/derived
std::string schema_script();                              // makes them, inside the caller's transaction
bool has_current_views(const sql::Database& database);    // views and indexes are as this build has them
std::string indexes_script();                             // makes those that are missing
std::string drop_views_script();                          // all of ours that are there
std::string views_script();                               // drops them, makes those of this build and the indexes
std::string temporary_views_script();                     // the same views for who asks: those of a file are not read

}  // namespace stampede
