// Questions to any database, strictly read-only: what catalogues and plain files answer with. Inside this room only.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "db/query.h"
#include "db/sqlite.h"

namespace stampede {

// Throws Error with SQLite's complaint, for more than one statement, and for one that would write.
void read_only_query(const sql::Database& database, const std::string& text, RowReceiver& receiver,
                     const QueryOptions& options);
Rows read_only_query(const sql::Database& database, std::string_view text, const std::vector<SqlValue>& parameters);

}  // namespace stampede
