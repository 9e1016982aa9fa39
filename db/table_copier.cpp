#include "db/table_copier.h"

namespace stampede {

TableCopier::TableCopier(const sql::Database& from, const sql::Database& to, const Table& table)
    : columns_(static_cast<int>(table.columns.size())) {
  const std::string columns = quoted_columns(table.columns);
  std::string read = "SELECT " + columns + " FROM " + table.name, write = "INSERT INTO main." + table.name + " (";
  if (table.of_episode) {
    const std::string number = table.name == "episode" ? "id" : "episode";
    read.append(" WHERE ").append(number).append(" = ?1");
    write.append(number).append(", ");
  }
  write.append(columns).append(") VALUES (").append(table.of_episode ? "?1" : "?");
  for (int i = table.of_episode ? 0 : 1; i < columns_; ++i) write += ", ?";
  rows_ = sql::Statement(from, read, true);
  write_ = sql::Statement(to, write.append(table.of_episode ? ")" : ") ON CONFLICT DO NOTHING"), true);
}

void TableCopier::copy_episode(std::int64_t there, std::int64_t here) {
  for (rows_.start(there); rows_.step();) put(write_.start(here), 1);
}

void TableCopier::copy_shared() {
  for (rows_.start(); rows_.step();) put(write_.start(), 0);
}

void TableCopier::put(sql::Statement& row, int first) {
  for (int i = 0; i < columns_; ++i)
    sqlite3_bind_value(row.handle(), first + i + 1, sqlite3_column_value(rows_.handle(), i));
  while (row.step()) {
  }
}

bool is_shared(const Table& table) { return !table.of_episode && table.name != "split"; }

void check_variations(const sql::Database& from, const sql::Database& to) {
  sql::Statement theirs(from, "SELECT task, variation, axis, value FROM variation_axis");
  sql::Statement ours(
      to, "SELECT 1 FROM main.variation_axis WHERE task = ?1 AND variation = ?2 AND axis = ?3 AND value <> ?4");
  for (theirs.start(); theirs.step();) {
    std::string task, variation, axis, value;
    theirs.read(task, variation, axis, value);
    if (ours.start(task, variation, axis, value).step())
      throw CatalogueError(from.path(),
                           "it and " + to.path() + " disagree about the variation " +
                               sql::shown(task + " " + variation + ", axis " + axis),
                           "they were made from different tasks of one name: keep them apart");
  }
}

}  // namespace stampede
