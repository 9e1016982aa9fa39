#include "db/declared.h"

#include <algorithm>
#include <cctype>
#include <mutex>
#include <optional>
#include <set>

#include "db/catalogue.h"
#include "db/embedded_sql.h"
#include "db/migrations.h"
#include "db/schema.h"

namespace stampede {
namespace {

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || (c & 0x80) != 0; }

bool is_one_word(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](char c) { return is_word(c) && (c & 0x80) == 0; }) &&
         !std::isdigit(static_cast<unsigned char>(name[0]));
}

bool is_plain_name(std::string_view name) {
  return is_one_word(name) && sqlite3_keyword_check(name.data(), static_cast<int>(name.size())) == 0;
}

// Reads SQL word by word, as SQLite does.
class Tokens {
 public:
  explicit Tokens(std::string_view sql) : sql_(sql) {}

  std::vector<std::string> read() {
    while (at_ < sql_.size())
      if (!skip_space()) tokens_.push_back(next());
    return std::move(tokens_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < sql_.size() ? sql_[at_ + ahead] : '\0'; }

  bool skip_space() {
    if (std::isspace(static_cast<unsigned char>(peek())) && peek() != '\v') {
      ++at_;
    } else if (peek() == '-' && peek(1) == '-') {
      at_ = std::min(sql_.find('\n', at_), sql_.size());
    } else if (const std::size_t end = sql_.find("*/", at_ + 2);
               peek() == '/' && peek(1) == '*' && end != std::string_view::npos) {
      at_ = end + 2;
    } else {
      return false;
    }
    return true;
  }

  std::string next() {
    const char c = peek();
    if (c == '\'' || ((c == 'x' || c == 'X') && peek(1) == '\'')) return literal();
    if (c == '"' || c == '`' || c == '[') return name(c == '[' ? ']' : c);
    const std::size_t begin = at_++;
    if (is_word(c))
      while (is_word(peek())) ++at_;
    return std::string(sql_.substr(begin, at_ - begin));
  }

  // Up to the quote that ends it; one that is doubled does not, but for brackets.
  std::string_view quoted_by(char quote) {
    const std::size_t begin = at_;
    for (; at_ < sql_.size(); ++at_) {
      if (peek() != quote) continue;
      if (quote == ']' || peek(1) != quote) break;
      ++at_;
    }
    const std::string_view inside = sql_.substr(begin, at_ - begin);
    if (at_ < sql_.size()) ++at_;
    return inside;
  }

  std::string literal() {
    const std::size_t begin = at_;
    at_ += peek() == '\'' ? 1 : 2;
    quoted_by('\'');
    return std::string(sql_.substr(begin, at_ - begin));
  }

  std::string name(char quote) {
    ++at_;
    std::string_view inside = quoted_by(quote);
    const bool of_table = !tokens_.empty() && tokens_.back() == "TABLE";  // may be a word of SQL, as `action` is
    if (is_plain_name(inside) || (of_table && is_one_word(inside))) return std::string(inside);
    std::string plain;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      plain += inside[i];
      if (quote != ']' && inside[i] == quote) ++i;  // the second of two
    }
    return sql::quoted_name(plain);
  }

  std::string_view sql_;
  std::size_t at_ = 0;
  std::vector<std::string> tokens_;
};

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

Declarations declarations_of(const sql::Database& database) {
  Declarations found;
  sql::Statement rows(database, "SELECT type, name, tbl_name, sql FROM main.sqlite_master WHERE type <> 'view'");
  for (rows.start(); rows.step();) {
    std::string type, name, table;
    std::optional<std::string> sql;
    rows.read(type, name, table, sql);
    if (!sql)
      found.automatic[name] = table;
    else
      (type == "table" ? found.tables : found.indexes)[name] = *sql;
  }
  return found;
}

struct Row {
  std::string type, name, table, sql;
  bool without_sql = false;
};

std::vector<Row> schema_rows(const sql::Database& database, const std::string& schema) {
  std::vector<Row> list;
  sql::Statement rows(
      database, "SELECT type, name, tbl_name, sql FROM " + sql::quoted_name(schema) + ".sqlite_master ORDER BY rowid");
  for (rows.start(); rows.step();) {
    Row& row = list.emplace_back();
    std::optional<std::string> sql;
    rows.read(row.type, row.name, row.table, sql);
    row.without_sql = !sql;
    row.sql = sql.value_or("");
  }
  return list;
}

bool is_own(const std::string& name) { return name.starts_with(kOwnPrefix); }

// SQLite's own: what it counted for its planner, and the last numbers of a user's tables.
bool is_of_sqlite(const Row& row) {
  static const std::map<std::string, std::string> known = {
      {"sqlite_stat1", "CREATE TABLE sqlite_stat1 ( tbl , idx , stat )"},
      {"sqlite_stat4", "CREATE TABLE sqlite_stat4 ( tbl , idx , neq , nlt , ndlt , sample )"},
      {"sqlite_sequence", "CREATE TABLE sqlite_sequence ( name , seq )"}};
  const auto found = known.find(row.name);
  return row.type == "table" && row.table == row.name && found != known.end() && tokens_of(row.sql) == found->second;
}

bool begins(const std::vector<std::string>& tokens, const std::vector<std::string>& words) {
  return tokens.size() >= words.size() && std::equal(words.begin(), words.end(), tokens.begin());
}

// A name as it is among tokens.
std::string as_token(const std::string& name) { return is_plain_name(name) ? name : sql::quoted_name(name); }

// CREATE [UNIQUE] INDEX `name` ON `table` …
bool is_index(const Row& row) {
  std::vector<std::string> tokens = token_list(row.sql);
  if (tokens.size() > 1 && tokens[1] == "UNIQUE") tokens.erase(tokens.begin() + 1);
  if (tokens.size() > 3) tokens[3] = upper(tokens[3]);
  return begins(tokens, {"CREATE", "INDEX", as_token(row.name), "ON", as_token(row.table), "("});
}

// A user's own: columns that are stored, and indexes on them. What is worked out when somebody asks is SQL of a file.
bool is_plain_own(const Row& row) {
  if (row.type == "index") return row.without_sql ? row.name.starts_with("sqlite_autoindex_") : is_index(row);
  const std::vector<std::string> tokens = token_list(row.sql);
  return row.type == "table" && row.table == row.name && begins(tokens, {"CREATE", "TABLE", as_token(row.name), "("}) &&
         std::none_of(tokens.begin(), tokens.end(),
                      [](const std::string& token) { return upper(token) == "AS" || upper(token) == "GENERATED"; });
}

[[noreturn]] void refuse(const sql::Database& database, const std::string& what, const std::string& hint) {
  throw CatalogueError(database.path(), what, "nothing in it was run; " + hint);
}

std::string named(const Row& row) { return "the " + sql::shown(row.type) + " '" + sql::shown(row.name) + "'"; }

// What made the episodes, for complaints; empty when the file does not say, or not where release 8 and earlier do.
std::string engine_of(const sql::Database& database, const std::string& schema, const Declarations& declared) {
  for (const Row& row : schema_rows(database, schema))
    if (row.name == "engine_run" && tokens_of(row.sql) == tokens_of(declared.tables.at("engine_run")))
      return sql::shown(database.text("SELECT group_concat(DISTINCT engine_version) FROM " + sql::quoted_name(schema) +
                                      ".engine_run"));
  return "";
}

class Check {
 public:
  Check(const sql::Database& database, const std::string& schema, int release)
      : database_(database), schema_(schema), release_(release), declared_(declared_by(release)) {}

  void run() {
    const std::vector<Row> rows = schema_rows(database_, schema_);
    for (const Row& row : rows) {
      check(row);
      if (row.type == "table" && !seen_.insert(row.name).second) strange("has the table '" + row.name + "' twice");
    }
    for (const auto& [name, sql] : declared_.tables)
      if (!seen_.contains(name)) strange("lacks the table '" + name + "'");
    const std::string where = " FROM " + sql::quoted_name(schema_) + ".sqlite_master WHERE rootpage > 0";
    if (database_.number("SELECT count(*) - count(DISTINCT rootpage)" + where) != 0)
      throw CatalogueError(database_.path(), "two of its tables share their pages",
                           "the file is damaged: take a copy of it, or generate it again");
  }

 private:
  void check(const Row& row) const {
    if (row.type == "trigger")
      refuse(database_, "it holds " + named(row) + ", and a catalogue has none",
             "take it out with a program for SQLite (DROP TRIGGER), or generate the episodes again");
    if (row.type == "view") return check_view(row);
    if (is_of_sqlite(row)) return;
    if (is_own(row.table)) {
      if (is_plain_own(row)) return;
      refuse(database_, "it holds " + named(row) + ", which computes what it shows",
             "tables of your own (own_…) have plain columns: put what is computed into another file");
    }
    if (row.type == "index") return check_index(row);
    check_table(row);
  }

  void check_view(const Row& row) const {
    const auto& ours = embedded_views();
    const bool known =
        std::any_of(ours.begin(), ours.end(), [&](const SqlFile& view) { return view.name == row.name; });
    if (known && begins(token_list(row.sql), {"CREATE", "VIEW", row.name})) return;
    refuse(database_, "it holds " + named(row) + ", which is none of a catalogue's",
           "take it out with a program for SQLite (DROP VIEW), and keep views of your own in a file beside it");
  }

  void check_index(const Row& row) const {
    if (row.without_sql) {
      const auto found = declared_.automatic.find(row.name);
      if (found != declared_.automatic.end() && found->second == row.table) return;
    } else {
      const auto found = declared_.indexes.find(row.name);
      if (found != declared_.indexes.end() && tokens_of(found->second) == tokens_of(row.sql)) return;
    }
    refuse(database_, "it holds " + named(row) + ", which is none of a catalogue's",
           "take it out with a program for SQLite (DROP INDEX): those of a catalogue are made when it is opened to "
           "write");
  }

  void check_table(const Row& row) const {
    const auto found = declared_.tables.find(row.name);
    if (row.type != "table" || found == declared_.tables.end())
      strange("has " + named(row) + ", which is none of a catalogue's");
    if (row.table != row.name || tokens_of(found->second) != tokens_of(row.sql))
      strange("declares " + named(row) + " otherwise");
  }

  [[noreturn]] void strange(const std::string& what) const {
    const std::string engine = engine_of(database_, schema_, declared_);
    refuse(database_,
           "its tables are those of no release: it says schema " + std::to_string(release_) + ", and " + what,
           "read it with the build that made it" + (engine.empty() ? "" : " (" + engine + ")") +
               ", which lay between two releases, or generate the episodes again with this one; tables of your own "
               "begin with own_");
  }

  const sql::Database& database_;
  const std::string& schema_;
  int release_;
  const Declarations& declared_;
  std::set<std::string> seen_;
};

Declarations declarations_made(int release) {
  const sql::Database memory(":memory:", SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, ":memory:");
  if (release == schema_version()) {
    memory.run(schema_script() + indexes_script());
    return declarations_of(memory);
  }
  for (const SqlFile& first : embedded_releases()) memory.run(first.text);
  migrate(memory, earlier_releases().front(), release);
  return declarations_of(memory);
}

// CREATE TABLE `name` ( column , column … )
bool is_list_of_columns(const std::vector<std::string>& tokens, const std::string& name) {
  if (!begins(tokens, {"CREATE", "TABLE", as_token(name), "("}) || tokens.back() != ")" || tokens.size() % 2 != 0)
    return false;
  for (std::size_t i = 4; i + 1 < tokens.size(); ++i) {
    const bool is_name = tokens[i][0] == '"' || is_plain_name(tokens[i]);
    if (i % 2 == 0 ? !is_name : tokens[i] != ",") return false;
  }
  return true;
}

}  // namespace

std::vector<std::string> token_list(std::string_view sql) { return Tokens(sql).read(); }

std::string tokens_of(std::string_view sql) {
  std::string text;
  for (const std::string& token : token_list(sql)) text.append(text.empty() ? "" : " ").append(token);
  return text;
}

const Declarations& declared_by(int release) {
  static std::mutex mutex;
  static std::map<int, Declarations> made;  // when they are asked for: most files are of this release
  const std::lock_guard lock(mutex);
  const auto found = made.find(release);
  return found != made.end() ? found->second : made[release] = declarations_made(release);
}

void check_declarations(const sql::Database& database, const std::string& schema, int release) {
  Check(database, schema, release).run();
}

void check_plain_tables(const sql::Database& database) {
  for (const Row& row : schema_rows(database, "main")) {
    const bool plain = row.type == "table" ? is_list_of_columns(token_list(row.sql), row.name) && row.table == row.name
                                           : row.type == "index" && is_index(row) && token_list(row.sql).size() == 8;
    if (!plain && !is_of_sqlite(row))
      refuse(database, "it holds " + named(row) + ", and a data set has plain tables only",
             "make the data set again with `stampede dataset`");
  }
}

}  // namespace stampede
