#include "db/schema.h"

#include <algorithm>
#include <cctype>

#include "db/catalogue.h"
#include "db/embedded_sql.h"
#include "engine/base/hash.h"
#include "engine/base/reason.h"

namespace stampede {
namespace {

// Declarations that mean the same are the same: an added column, or a table that a migration made, has other spaces.
std::string without_looks(const std::string& sql) {
  std::string bare;
  bool quoted = false;
  for (std::size_t i = 0; i < sql.size(); ++i) {
    const char c = sql[i];
    if (c == '\'') quoted = !quoted;
    if (!quoted && sql.compare(i, 2, "--") == 0) {
      i = std::min(sql.find('\n', i), sql.size() - 1);
      continue;
    }
    if (quoted || (c != '"' && !std::isspace(static_cast<unsigned char>(c)))) bare += c;
  }
  return bare;
}

std::string of_all(const std::vector<SqlFile>& files) {
  std::string script;
  for (const SqlFile& file : files) script += file.text;
  return script;
}

sql::Database empty_catalogue() {
  sql::Database memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, ":memory:");
  memory.run(schema_script() + of_all(embedded_indexes()) + of_all(embedded_views()));
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

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + ('"' + word + '"');
  return text;
}

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

std::string tables_hash(const sql::Database& database) {
  sql::Statement rows(database,
                      "SELECT name, sql FROM main.sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite!_%' "
                      "ESCAPE '!' AND substr(name, 1, 4) <> ?1 ORDER BY name");
  Hasher hasher;
  for (rows.start(kOwnPrefix); rows.step();) {
    std::string name, sql;
    rows.read(name, sql);
    hasher.text(name).text(without_looks(sql));
  }
  return hasher.digest();
}

const std::string& current_tables_hash() {
  static const std::string hash = tables_hash(empty_catalogue());
  return hash;
}

const std::vector<std::string>& current_tables() {
  static const std::vector<std::string> names = [] {
    const sql::Database memory = empty_catalogue();
    std::vector<std::string> list;
    sql::Statement rows(memory,
                        "SELECT name FROM sqlite_master WHERE type = 'table' AND name NOT LIKE 'sqlite!_%' ESCAPE '!' "
                        "ORDER BY name");
    for (rows.start(); rows.step();) rows.read(list.emplace_back());
    return list;
  }();
  return names;
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

std::string drop_views_script(const sql::Database& database) {
  std::string script;
  sql::Statement views(database, "SELECT name FROM main.sqlite_master WHERE type = 'view' ORDER BY name");
  for (views.start(); views.step();) {
    std::string name;
    views.read(name);
    script += "DROP VIEW \"" + name + "\";\n";
  }
  return script;
}

std::string views_script(const sql::Database& database) {
  return drop_views_script(database) + of_all(embedded_indexes()) + of_all(embedded_views());
}

std::string temporary_views_script() {
  std::string script = "PRAGMA temp_store = MEMORY;\nBEGIN;\n";
  for (const SqlFile& file : embedded_views()) {
    const std::string head = "CREATE VIEW ";
    script += "CREATE TEMP VIEW " + file.text.substr(head.size());
  }
  return script + "COMMIT;\n";
}

}  // namespace stampede
