// The tables of this build, and what tells whether a file has them. Inside this room only.
#pragma once

#include <string>
#include <vector>

#include "db/sqlite.h"

namespace stampede {

// Tables of this name are a user's own: they are neither checked nor hashed, and merging leaves them behind.
inline constexpr const char* kOwnPrefix = "own_";

struct Table {
  std::string name;
  std::vector<std::string> columns, order;  // but the episode's number; of the key, or all
  bool of_episode = false;                  // has a column `episode`, or is the table of episodes
};
Table describe(const sql::Database& database, const std::string& name);
std::string joined(const std::vector<std::string>& columns);  // quoted, with commas

// Digest of the tables of the file as they were declared, but for comments, spaces and quotes around names.
std::string tables_hash(const sql::Database& database);

const std::string& current_tables_hash();                      // of the files in db/schema
const std::vector<std::string>& current_tables();              // their names, sorted
const std::string& derived_sql(const std::string& name);       // of a file in db/derived
std::string schema_script();                                   // makes them, inside the caller's transaction
bool has_current_views(const sql::Database& database);         // views and indexes are as this build has them
std::string drop_views_script(const sql::Database& database);  // all views of the file
std::string views_script(const sql::Database& database);       // drops them, makes those of this build and the indexes
std::string temporary_views_script();                          // the same views for a file that may not be written

}  // namespace stampede
