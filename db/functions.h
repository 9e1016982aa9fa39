// Functions of ours for questions in SQL, where SQLite has none: db/README.md describes them. Inside this room only.
#pragma once

#include <sqlite3.h>

namespace stampede::sql {

// For statements of this connection, not for what a file declares.
void add_functions(sqlite3* handle);

}  // namespace stampede::sql
