// Questions to a catalogue: SQL text or the name of a file in db/queries, strictly read-only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "stampede/rows.h"

namespace stampede {

using QueryResult = Rows;

// Receives an answer row by row, as it is made.
class RowReceiver {
 public:
  virtual ~RowReceiver() = default;
  virtual void columns(const std::vector<std::string>& names) = 0;  // once, first
  virtual bool row(const std::vector<SqlValue>& values) = 0;        // false: no more are wanted
};

struct QueryOptions {
  std::vector<SqlValue> parameters;  // for ?1, ?2 …
  std::int64_t most_rows = 0;        // 0: all
};

struct NamedQuery {
  std::string name, description, sql;
};
const std::vector<NamedQuery>& named_queries();             // by name
const NamedQuery* find_named_query(std::string_view name);  // nullptr: none

}  // namespace stampede
