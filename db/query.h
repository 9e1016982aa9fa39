// Questions to a catalogue: SQL text or the name of a file in db/queries, strictly read-only.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace stampede {

struct SqlBlob {
  std::string bytes;
  friend bool operator==(const SqlBlob&, const SqlBlob&) = default;
};
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string, SqlBlob>;  // monostate: NULL

struct QueryResult {
  std::vector<std::string> columns;
  std::vector<std::vector<SqlValue>> rows;
  bool cut = false;  // there were more rows than asked for
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
