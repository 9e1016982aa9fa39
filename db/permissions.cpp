#include "db/permissions.h"

#include <algorithm>
#include <initializer_list>
#include <string_view>

namespace stampede::sql {
namespace {

constexpr int kMostBytes = 1 << 29;  // of a value: no picture is as large
constexpr int kMostSql = 1'000'000;  // bytes of a statement

bool is_one_of(const char* name, std::initializer_list<std::string_view> names) {
  return name && std::find(names.begin(), names.end(), std::string_view(name)) != names.end();
}

// Functions of SQLite that touch files are not compiled into the library; nor may anything load them, or print
// addresses.
bool is_harmless_function(const char* name) {
  return !is_one_of(name, {"load_extension", "writefile", "readfile", "edit", "fts3_tokenizer"});
}

bool tells_about_tables(const char* pragma) {
  return is_one_of(pragma, {"table_info", "table_xinfo", "table_list", "index_list", "index_info", "foreign_key_list"});
}

// application_id and user_version with a value would set them.
bool is_harmless_pragma(const char* pragma, const char* value) {
  return tells_about_tables(pragma) || (!value && is_one_of(pragma, {"application_id", "user_version"}));
}

bool may_be_asked_by_reader(const char* pragma, const char* value) {
  return is_harmless_pragma(pragma, value) ||
         is_one_of(pragma, {"cache_size", "data_version", "temp_store", "foreign_key_check", "integrity_check",
                            "quick_check", "schema_version"});
}

bool may_be_asked_by_writer(const char* pragma, const char* value) {
  return may_be_asked_by_reader(pragma, value) ||
         is_one_of(pragma, {"analysis_limit", "application_id", "defer_foreign_keys", "foreign_keys", "journal_mode",
                            "page_size", "synchronous", "user_version", "wal_autocheckpoint"});
}

// Reading, as a question does it. SQLite asks for an update of its own table when pragma_table_info() and its like are
// set up; it never lets a statement do it.
bool reads(int action, const char* first, const char* second) {
  switch (action) {
    case SQLITE_SELECT:
    case SQLITE_READ:
    case SQLITE_RECURSIVE:
      return true;
    case SQLITE_FUNCTION:
      return is_harmless_function(second);
    case SQLITE_UPDATE:
      return is_one_of(first, {"sqlite_master", "sqlite_temp_master"});
    default:
      return false;
  }
}

bool may_read(int action, const char* first, const char* second) {
  switch (action) {
    case SQLITE_PRAGMA:
      return may_be_asked_by_reader(first, second);
    case SQLITE_TRANSACTION:
    case SQLITE_CREATE_TEMP_VIEW:
    case SQLITE_DROP_TEMP_VIEW:
      return true;
    case SQLITE_INSERT:
    case SQLITE_DELETE:
      return is_one_of(first, {"sqlite_temp_master"});
    default:
      return reads(action, first, second);
  }
}

bool may_write(int action, const char* first, const char* second) {
  switch (action) {
    case SQLITE_PRAGMA:
      return may_be_asked_by_writer(first, second);
    case SQLITE_FUNCTION:
      return is_harmless_function(second);
    case SQLITE_ATTACH:
    case SQLITE_DETACH:
    case SQLITE_CREATE_TRIGGER:
    case SQLITE_CREATE_TEMP_TRIGGER:
    case SQLITE_CREATE_VTABLE:
    case SQLITE_DROP_VTABLE:
      return false;
    default:
      return true;
  }
}

int decide(void* data, int action, const char* first, const char* second, const char* schema, const char*) {
  const auto& permissions = *static_cast<const Permissions*>(data);
  if (permissions.read && action == SQLITE_READ && first) permissions.read->insert(first);
  bool allowed = action == SQLITE_ATTACH && permissions.may_attach;
  const bool shows = action == SQLITE_CREATE_VTABLE || (action == SQLITE_INSERT && is_one_of(first, {"sqlite_master"}));
  allowed |= shows && permissions.may_show && is_one_of(schema, {"temp"});
  switch (permissions.purpose) {
    case Purpose::question:
      allowed |= reads(action, first, second) || (action == SQLITE_PRAGMA && is_harmless_pragma(first, second));
      break;
    case Purpose::read:
      allowed |= may_read(action, first, second);
      break;
    case Purpose::write:
      allowed |= may_write(action, first, second);
      break;
  }
  return allowed ? SQLITE_OK : SQLITE_DENY;
}

}  // namespace

void restrict_to(sqlite3* handle, Permissions* permissions) {
  sqlite3_db_config(handle, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);  // temporary ones, which are ours, stay
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_LOAD_EXTENSION, 0, nullptr);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_FTS3_TOKENIZER, 0, nullptr);
  sqlite3_exec(handle, "PRAGMA cell_size_check = ON", nullptr, nullptr, nullptr);
  sqlite3_limit(handle, SQLITE_LIMIT_LENGTH, kMostBytes);
  sqlite3_limit(handle, SQLITE_LIMIT_SQL_LENGTH, kMostSql);
  sqlite3_limit(handle, SQLITE_LIMIT_ATTACHED, 1);
  sqlite3_limit(handle, SQLITE_LIMIT_TRIGGER_DEPTH, 10);  // of what foreign keys of a user's own tables do
  sqlite3_limit(handle, SQLITE_LIMIT_LIKE_PATTERN_LENGTH, 1000);
  sqlite3_limit(handle, SQLITE_LIMIT_WORKER_THREADS, 0);
  sqlite3_set_authorizer(handle, decide, permissions);
}

}  // namespace stampede::sql
