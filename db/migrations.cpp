#include "db/migrations.h"

#include <sstream>

#include "db/catalogue.h"
#include "db/count_visible.h"
#include "db/declared.h"
#include "db/embedded_sql.h"
#include "db/schema.h"

namespace stampede {
namespace {

int first_number(const SqlFile& migration) { return std::stoi(migration.name); }  // 005_to_006

// The words after `-- changes` in the first line.
std::vector<std::string> changed_tables(const SqlFile& migration) {
  std::istringstream line(migration.text.substr(0, migration.text.find('\n')));
  std::string dashes, changes;
  line >> dashes >> changes;
  std::vector<std::string> tables;
  for (std::string table; line >> table;) tables.push_back(table);
  return tables;
}

// A migration has up to three parts: what is done to tables that are copied to be read; views that show large tables of
// `old` in their new shape; what makes tables of them.
struct Parts {
  std::string copied, in_place, written;
};
Parts parts_of(const std::string& text, const std::string& old) {
  const std::size_t tables = std::min(text.find("\n-- to write"), text.size());
  const std::size_t views = std::min(text.find("\n-- in place"), tables);  // where there are none: no such part
  Parts parts{text.substr(0, views), text.substr(views, tables - views), text.substr(tables)};
  const std::string from = "FROM old.";
  for (std::size_t at = 0; (at = parts.in_place.find(from, at)) != std::string::npos; at += from.size())
    parts.in_place.replace(at, from.size(), "FROM " + old + ".");
  return parts;
}

// From the attached file into the temporary database, once: declared by us, never as the file says.
void copy_table(const sql::Database& database, const std::string& table, int schema) {
  const auto& tables = declared_by(schema).tables;
  const auto declared = tables.find(table);
  sql::Statement there(database, "SELECT 1 FROM main.sqlite_master WHERE type = 'table' AND name = ?1");
  if (declared == tables.end() || there.start(table).step()) return;
  database.run(declared->second);
  database.run("INSERT INTO main." + table + " SELECT * FROM file." + table);
}

}  // namespace

const std::vector<int>& earlier_releases() {
  static const std::vector<int> releases = [] {
    std::vector<int> list;
    for (const SqlFile& migration : embedded_migrations()) list.push_back(first_number(migration));
    return list;
  }();
  return releases;
}

void migrate(const sql::Database& database, int from, int to) {
  for (const SqlFile& migration : embedded_migrations()) {
    const int begin = first_number(migration);
    if (begin < from || begin >= to) continue;
    const Parts parts = parts_of(migration.text, "main");
    database.run(parts.copied + parts.in_place + parts.written);
    if (begin != 5) continue;
    count_stored_masks(database);
    database.run(indexes_script());
    database.run(derived_sql("effects_held"));
    database.run("INSERT INTO undeclared_change (episode, segment, fact, negated) " + derived_sql("undeclared_change"));
  }
  database.run("PRAGMA user_version = " + std::to_string(to));
}

sql::Database migrated_to_read(const std::string& uri, int flags, const std::string& shown_path, int schema) {
  // An empty name is a database of its own on disk, without a file that others see; it goes when it is closed.
  sql::Database database("", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE | (flags & SQLITE_OPEN_URI), shown_path);
  database.attach(uri, "file");
  check_declarations(database, "file", schema);
  // Before there are temporary views: setting it drops them. Tables that did not change are not here to be referred to.
  database.run("PRAGMA foreign_keys = OFF; PRAGMA temp_store = MEMORY; BEGIN");
  for (const SqlFile& migration : embedded_migrations()) {
    if (first_number(migration) < schema) continue;
    for (const std::string& table : changed_tables(migration)) copy_table(database, table, schema);
    const Parts parts = parts_of(migration.text, "file");
    database.run(parts.copied + parts.in_place);
  }
  if (schema == 5) {  // which had none
    database.run(indexes_script());
    database.run(derived_sql("effects_held"));
    database.run("CREATE TEMP VIEW undeclared_change AS " + derived_sql("undeclared_change"));
  }
  database.run("COMMIT");
  database.only_read();
  return database;
}

void copy_database(const std::filesystem::path& file, const std::filesystem::path& copy) {
  const sql::Database from(std::filesystem::absolute(file).string(), SQLITE_OPEN_READONLY, file.string());
  const sql::Database to(copy.string(), SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, copy.string());
  sqlite3_backup* backup = sqlite3_backup_init(to.handle(), "main", from.handle(), "main");
  if (backup == nullptr) to.fail(sqlite3_errcode(to.handle()));
  sqlite3_backup_step(backup, -1);
  int code = sqlite3_backup_finish(backup);
  // The copy of a file in WAL mode says that it is in that mode too: whoever reads it would leave a log beside it.
  if (code == SQLITE_OK) code = sqlite3_exec(to.handle(), "PRAGMA journal_mode = DELETE", nullptr, nullptr, nullptr);
  if (code == SQLITE_OK) return;
  std::error_code ignored;
  std::filesystem::remove(copy, ignored);
  to.fail(code);
}

}  // namespace stampede
