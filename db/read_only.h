// Questions to any database, strictly read-only: what catalogues and plain files answer with. Inside this room only.
#pragma once

#include <set>
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

// Of tables and views, by name. Throws as the question itself would.
std::set<std::string> tables_read_by(const sql::Database& database, const std::string& text);

// SQL, of a name too. Throws Error for a name that no query has.
std::string text_of_question(std::string_view question);

struct RowKeeper : RowReceiver {
  void columns(const std::vector<std::string>& names) override { result.columns = names; }
  bool row(const std::vector<SqlValue>& values) override;
  QueryResult result;
  std::int64_t most_rows = 0;  // 0: all
};

}  // namespace stampede
