#include "db/schema.h"

#include <algorithm>

#include "db/catalogue.h"
#include "db/declared.h"
#include "db/embedded_sql.h"
#include "engine/base/hash.h"
#include "engine/base/reason.h"

namespace stampede {
namespace {

std::string of_all(const std::vector<SqlFile>& files) {
  std::string script;
  for (const SqlFile& file : files) script += file.text;
  return script;
}

sql::Database empty_catalogue() {
  sql::Database memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, ":memory:");
  memory.run(schema_script() + indexes_script() + of_all(embedded_views()));
  return memory;
}

// Views and indexes by name, with what makes them.
std::vector<std::string> derived(const sql::Database& database) {
  std::vector<std::string> list;
  sql::Statement rows(database,
                      "SELECT type || ' ' || name || ' ' || sql FROM main.sqlite_master WHERE type = 'view' OR "
                      "(type = 'index' AND sql IS NOT NULL AND substr(tbl_name, 1, 4) <> 'own_') ORDER BY type, name");
  for (rows.start(); rows.step();) rows.read(list.emplace_back());
  return list;
}

}  // namespace

std::string quoted_columns(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + sql::quoted_name(word);
  return text;
}

namespace {

Table describe(const sql::Database& database, const std::string& name) {
  Table table{name, {}, {}, false};
  std::vector<std::pair<int, std::string>> key;
  sql::Statement info(database, "SELECT name, pk FROM pragma_table_info(?1) ORDER BY cid");
  for (info.start(name); info.step();) {
    std::string column;
    int place = 0;
    info.read(column, place);
    if (column == "episode" || (name == "episode" && column == "id")) {
      table.of_episode = true;
      continue;
    }
    table.columns.push_back(column);
    if (place > 0) key.emplace_back(place, column);
  }
  std::sort(key.begin(), key.end());
  for (const auto& [place, column] : key) table.order.push_back(column);
  if (table.order.empty()) table.order = table.columns;
  return table;
}

}  // namespace

const std::string& current_tables_hash() {
  static const std::string hash = [] {
    Hasher hasher;
    for (const auto& [name, sql] : declared_by(schema_version()).tables) hasher.text(name).text(tokens_of(sql));
    return hasher.digest();
  }();
  return hash;
}

const std::vector<Table>& current_tables() {
  static const std::vector<Table> tables = [] {
    const sql::Database memory = empty_catalogue();
    std::vector<Table> list;
    for (const auto& [name, sql] : declared_by(schema_version()).tables) list.push_back(describe(memory, name));
    return list;
  }();
  return tables;
}

const std::string& derived_sql(const std::string& name) {
  const auto& files = embedded_derived();
  return std::find_if(files.begin(), files.end(), [&](const SqlFile& file) { return file.name == name; })->text;
}

std::string schema_script() {
  return of_all(embedded_schema()) + "PRAGMA application_id = " + std::to_string(kApplicationId) +
         ";\nPRAGMA user_version = " + std::to_string(schema_version()) + ";\n";
}

bool has_current_views(const sql::Database& database) {
  static const std::vector<std::string> current = derived(empty_catalogue());
  return derived(database) == current;
}

std::string indexes_script() { return of_all(embedded_indexes()); }

std::string drop_views_script() {
  std::string script;
  for (const SqlFile& view : embedded_views())
    script += "DROP VIEW IF EXISTS main." + sql::quoted_name(view.name) + ";\n";
  return script;
}

std::string views_script() { return drop_views_script() + indexes_script() + of_all(embedded_views()); }

std::string temporary_views_script() {
  std::string script = "PRAGMA temp_store = MEMORY;\nBEGIN;\n";
  for (const SqlFile& file : embedded_views()) {
    const std::string head = "CREATE VIEW ";
    script += "CREATE TEMP VIEW " + file.text.substr(head.size());
  }
  return script + "COMMIT;\n";
}

}  // namespace stampede
