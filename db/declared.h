// What the schema of a file declares, against what this release and earlier ones declare. Inside this room only.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "db/sqlite.h"

namespace stampede {

// The words and signs of a declaration, a space between two: without comments, other spaces, and quotes around names
// that need none. Two texts with the same are read alike by SQLite.
std::string tokens_of(std::string_view sql);
std::vector<std::string> token_list(std::string_view sql);

// The tables and indexes of a release, by name, as we write them down; never as a file does.
struct Declarations {
  std::map<std::string, std::string> tables, indexes;  // name -> SQL
  std::map<std::string, std::string> automatic;        // indexes that SQLite makes for a table: name -> table
};
const Declarations& declared_by(int release);  // this one, or one that migrations begin from

// Throws CatalogueError naming the first thing in `schema` (`main`, or an attached file) that the release does not
// declare, or declares otherwise: nothing of it is run. A user's own tables are plain ones. Views of our names may say
// what they like: they are made anew, or hidden by temporary ones, and never read.
void check_declarations(const sql::Database& database, const std::string& schema, int release);

// The same for a file that holds nothing but plain tables with indexes on single columns.
void check_plain_tables(const sql::Database& database);

}  // namespace stampede
