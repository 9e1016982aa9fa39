#include "db/query.h"

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <utility>

#include "db/catalogue_impl.h"
#include "db/embedded_sql.h"
#include "db/read_only.h"
#include "engine/base/nearest.h"
#include "engine/base/stopping.h"

namespace stampede {
namespace {

struct Finalizer {
  void operator()(sqlite3_stmt* handle) const { sqlite3_finalize(handle); }
};
using Prepared = std::unique_ptr<sqlite3_stmt, Finalizer>;

[[noreturn]] void refuse(int code, const std::string& message, const std::string& hint = "") {
  if ((code & 0xff) == SQLITE_AUTH || (code & 0xff) == SQLITE_READONLY)
    throw Error("query", "a query only reads: " + message, "use SELECT; the views are described in db/README.md");
  if ((code & 0xff) == SQLITE_INTERRUPT) {
    heed_stop();
    throw Error("query", "interrupted");
  }
  throw Error("query", message, hint);
}

// All tables and views with their columns.
std::map<std::string, std::vector<std::string>> columns_of_all(sqlite3* handle) {
  constexpr const char* kAll =
      "SELECT m.name, p.name FROM (SELECT DISTINCT name FROM pragma_table_list WHERE name NOT LIKE 'sqlite%') m, "
      "pragma_table_info(m.name) p ORDER BY m.name, p.cid";
  sqlite3_stmt* statement = nullptr;
  sqlite3_prepare_v2(handle, kAll, -1, &statement, nullptr);
  const Prepared prepared(statement);
  std::map<std::string, std::vector<std::string>> all;
  while (sqlite3_step(statement) == SQLITE_ROW) {
    const auto text = [&](int i) { return reinterpret_cast<const char*>(sqlite3_column_text(statement, i)); };
    all[text(0)].emplace_back(text(1));
  }
  return all;
}

// What there is instead of a name that is not there: the views, or the columns of the tables that the text names.
std::string what_there_is(sqlite3* handle, const std::string& message, const std::string& sql) {
  constexpr std::string_view kTable = "no such table: ", kColumn = "no such column: ";
  if (!message.starts_with(kTable) && !message.starts_with(kColumn)) return "";
  const auto all = columns_of_all(handle);
  if (message.starts_with(kTable)) {
    std::vector<std::string> names;
    for (const auto& [name, columns] : all) names.push_back(name);
    const auto meant = nearest(message.substr(kTable.size()), names);
    std::string hint = (meant ? "did you mean '" + *meant + "'? " : "") + "the views are";
    for (const SqlFile& view : embedded_views()) hint += " " + view.name;
    return hint;
  }
  std::string hint, word;
  std::set<std::string> told;
  for (const char c : sql + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '_') {
      word += c;
      continue;
    }
    const auto found = all.find(std::exchange(word, ""));
    if (found == all.end() || !told.insert(found->first).second) continue;
    hint += (hint.empty() ? "" : "\n    ") + found->first + " has";
    for (const std::string& column : found->second) hint += " " + column;
  }
  return hint;
}

bool only_space(const char* text) {
  return std::all_of(text, text + std::char_traits<char>::length(text),
                     [](unsigned char c) { return std::isspace(c) || c == ';'; });
}

// The first statement of the text, or null; `rest` is what follows it.
Prepared prepare_first(sqlite3* handle, const char* text, const char** rest) {
  sqlite3_stmt* statement = nullptr;
  const int code = sqlite3_prepare_v2(handle, text, -1, &statement, rest);
  Prepared prepared(statement);
  if (code == SQLITE_OK) return prepared;
  const std::string message = sqlite3_errmsg(handle);
  refuse(code, message, what_there_is(handle, message, text));
}

Prepared prepare(sqlite3* handle, const std::string& text) {
  const char* rest = nullptr;
  Prepared prepared = prepare_first(handle, text.c_str(), &rest);
  if (!prepared) throw Error("query", "there is no statement in this text", "write a SELECT, or name a query");
  if (!sqlite3_stmt_readonly(prepared.get())) refuse(SQLITE_AUTH, "this statement would write");
  if (!only_space(rest) && prepare_first(handle, rest, nullptr))
    throw Error("query", "there is more than one statement", "ask one question at a time");
  return prepared;
}

void bind(sqlite3* handle, sqlite3_stmt* statement, const std::vector<SqlValue>& parameters) {
  const int wanted = sqlite3_bind_parameter_count(statement);
  if (wanted != static_cast<int>(parameters.size()))
    throw Error("query",
                "it takes " + std::to_string(wanted) + " parameters, not " + std::to_string(parameters.size()));
  int place = 0;
  for (const SqlValue& value : parameters) {
    ++place;
    int code = SQLITE_OK;
    if (const auto* integer = std::get_if<std::int64_t>(&value)) code = sqlite3_bind_int64(statement, place, *integer);
    if (const auto* real = std::get_if<double>(&value)) code = sqlite3_bind_double(statement, place, *real);
    if (const auto* text = std::get_if<std::string>(&value))
      code = sqlite3_bind_text64(statement, place, text->data(), text->size(), SQLITE_TRANSIENT, SQLITE_UTF8);
    if (const auto* blob = std::get_if<SqlBlob>(&value))
      code = sqlite3_bind_blob64(statement, place, blob->bytes.data(), blob->bytes.size(), SQLITE_TRANSIENT);
    if (code != SQLITE_OK) refuse(code, sqlite3_errmsg(handle));
  }
}

SqlValue value_of(sqlite3_stmt* row, int column) {
  const auto bytes = [&] {
    const void* data = sqlite3_column_blob(row, column);
    const auto size = static_cast<std::size_t>(sqlite3_column_bytes(row, column));
    return std::string(static_cast<const char*>(data ? data : ""), size);
  };
  switch (sqlite3_column_type(row, column)) {
    case SQLITE_INTEGER:
      return static_cast<std::int64_t>(sqlite3_column_int64(row, column));
    case SQLITE_FLOAT:
      return sqlite3_column_double(row, column);
    case SQLITE_TEXT:
      return bytes();
    case SQLITE_BLOB:
      return SqlBlob{bytes()};
    default:
      return std::monostate{};
  }
}

bool is_a_name(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
  });
}

}  // namespace

std::string text_of_question(std::string_view question) {
  if (!is_a_name(question)) return std::string(question);
  if (const NamedQuery* query = find_named_query(question)) return query->sql;
  std::string names = "the named queries are";
  for (const NamedQuery& query : named_queries()) names += " " + query.name;
  throw Error("query", "there is no query named '" + std::string(question) + "'", names);
}

namespace {

// A column is found by its name: of two that are called the same the later is `episode_2`.
void make_unique(std::vector<std::string>& names) {
  std::set<std::string> taken(names.begin(), names.end()), seen;
  for (std::string& name : names) {
    if (seen.insert(name).second) continue;
    std::string other;
    for (int n = 2; taken.contains(other = name + "_" + std::to_string(n)); ++n) {
    }
    taken.insert(other);
    seen.insert(name = other);
  }
}

}  // namespace

bool RowKeeper::row(const std::vector<SqlValue>& values) {
  result.cut = most_rows > 0 && static_cast<std::int64_t>(result.rows.size()) == most_rows;
  if (!result.cut) result.rows.push_back(values);
  return !result.cut;
}

const std::vector<NamedQuery>& named_queries() {
  static const std::vector<NamedQuery> queries = [] {
    std::vector<NamedQuery> list;
    for (const SqlFile& file : embedded_queries()) {
      const std::string first = file.text.substr(0, file.text.find('\n'));
      const std::size_t begin = first.find_first_not_of("- ");
      list.push_back({file.name, begin == std::string::npos ? "" : first.substr(begin), file.text});
    }
    return list;
  }();
  return queries;
}

const NamedQuery* find_named_query(std::string_view name) {
  for (const NamedQuery& query : named_queries())
    if (query.name == name) return &query;
  return nullptr;
}

std::set<std::string> tables_read_by(const sql::Database& database, const std::string& text) {
  std::set<std::string> tables;
  const sql::AsQuestion guard(database, &tables);
  prepare(database.handle(), text);
  return tables;
}

void read_only_query(const sql::Database& database, const std::string& text, RowReceiver& receiver,
                     const QueryOptions& options) {
  const sql::AsQuestion guard(database);
  sqlite3* const handle = database.handle();
  const Prepared statement = prepare(handle, text);
  bind(handle, statement.get(), options.parameters);
  const int columns = sqlite3_column_count(statement.get());
  std::vector<std::string> names;
  for (int i = 0; i < columns; ++i) {
    const char* name = sqlite3_column_name(statement.get(), i);
    names.emplace_back(name ? name : "");
  }
  make_unique(names);
  receiver.columns(names);
  std::vector<SqlValue> values(names.size());
  int code = SQLITE_OK;
  for (std::int64_t rows = 1; (code = sqlite3_step(statement.get())) == SQLITE_ROW; ++rows) {
    for (int i = 0; i < columns; ++i) values[static_cast<std::size_t>(i)] = value_of(statement.get(), i);
    if (!receiver.row(values) || rows == options.most_rows) return;
  }
  if (code != SQLITE_DONE) refuse(code, sqlite3_errmsg(handle));
}

Rows read_only_query(const sql::Database& database, std::string_view text, const std::vector<SqlValue>& parameters) {
  RowKeeper keeper;
  read_only_query(database, std::string(text), keeper, {parameters, 0});
  return std::move(keeper.result);
}

void Catalogue::query(std::string_view question, RowReceiver& receiver, const QueryOptions& options) const {
  read_only_query(impl_->database, text_of_question(question), receiver, options);
}

QueryResult Catalogue::query(std::string_view question, const QueryOptions& options) const {
  RowKeeper keeper;
  keeper.most_rows = options.most_rows;
  query(question, keeper, {options.parameters, 0});
  return std::move(keeper.result);
}

void Catalogue::interrupt() const { sqlite3_interrupt(impl_->database.handle()); }

}  // namespace stampede
