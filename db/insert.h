// Statements that fill tables. Inside this room only.
#pragma once

#include <string>

#include "db/sqlite.h"

namespace stampede::sql {

// Prepared once and kept: an episode has thousands of rows. Columns are named, so that a table may get another one or
// another order.
inline Statement insert(const Database& database, const std::string& table, const std::string& columns,
                        const std::string& ending = "") {
  std::string text = "INSERT INTO ";
  text.append(table).append(" (").append(columns).append(") VALUES (?");
  for (const char c : columns)
    if (c == ',') text += ",?";
  text.append(")").append(ending);
  return {database, text, true};
}

}  // namespace stampede::sql
