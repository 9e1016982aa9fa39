// What modules of virtual tables share. Inside this room only.
#pragma once

#include <sqlite3.h>

#include <exception>
#include <memory>
#include <new>

namespace stampede::sql {

// No exception passes through SQLite: it becomes the table's complaint.
template <typename Work>
int guarded(sqlite3_vtab* table, const Work& work) {
  try {
    work();
    return SQLITE_OK;
  } catch (const std::bad_alloc&) {
    return SQLITE_NOMEM;
  } catch (const std::exception& error) {
    sqlite3_free(table->zErrMsg);
    table->zErrMsg = sqlite3_mprintf("%s", error.what());
    return SQLITE_ERROR;
  }
}

// What SQLite calls of a read-only table, one for each connection. `Table`: what it is of, which lives as long as the
// connection, with declare(sqlite3*) and plan(sqlite3_index_info&). `Rows`: made of a Table; begin(plan's idxNum,
// values), advance(), over(), place(), tell(context, column). Shown as_table it can be made a temporary table; by_name
// it is there by the module's name alone, and nothing is made in a file.
enum class Shown { by_name, as_table };

template <typename Table, typename Rows, Shown shown>
class Module {
 public:
  static void add(sqlite3* handle, const char* name, Table* table) {  // takes it
    sqlite3_create_module_v2(handle, name, &functions(), table, [](void* one) { delete static_cast<Table*>(one); });
  }

 private:
  struct Vtab : sqlite3_vtab {
    const Table* table = nullptr;
  };
  struct Cursor : sqlite3_vtab_cursor {
    explicit Cursor(const Table& table) : sqlite3_vtab_cursor{}, rows(table) {}
    Rows rows;
  };
  static const Table& table_of(sqlite3_vtab* vtab) { return *static_cast<const Vtab*>(vtab)->table; }
  static Rows& rows_of(sqlite3_vtab_cursor* cursor) { return static_cast<Cursor*>(cursor)->rows; }

  static int connect(sqlite3* handle, void* table, int, const char* const*, sqlite3_vtab** vtab, char**) {
    if (const int code = static_cast<const Table*>(table)->declare(handle); code != SQLITE_OK) return code;
    auto made = std::make_unique<Vtab>();
    made->table = static_cast<const Table*>(table);
    *vtab = made.release();
    return SQLITE_OK;
  }
  static int disconnect(sqlite3_vtab* vtab) {
    delete static_cast<Vtab*>(vtab);
    return SQLITE_OK;
  }
  static int open(sqlite3_vtab* vtab, sqlite3_vtab_cursor** cursor) {
    *cursor = new (std::nothrow) Cursor(table_of(vtab));
    return *cursor ? SQLITE_OK : SQLITE_NOMEM;
  }
  static int close(sqlite3_vtab_cursor* cursor) {
    delete static_cast<Cursor*>(cursor);
    return SQLITE_OK;
  }
  static const sqlite3_module& functions() {
    static const sqlite3_module module = [] {
      sqlite3_module one{};
      if constexpr (shown == Shown::as_table) one.xCreate = connect, one.xDestroy = disconnect;
      one.xConnect = connect, one.xDisconnect = disconnect, one.xOpen = open, one.xClose = close;
      one.xBestIndex = [](sqlite3_vtab* vtab, sqlite3_index_info* info) {
        table_of(vtab).plan(*info);
        return SQLITE_OK;
      };
      one.xFilter = [](sqlite3_vtab_cursor* cursor, int asked, const char*, int, sqlite3_value** values) {
        return guarded(cursor->pVtab, [&] { rows_of(cursor).begin(asked, values); });
      };
      one.xNext = [](sqlite3_vtab_cursor* cursor) {
        return guarded(cursor->pVtab, [&] { rows_of(cursor).advance(); });
      };
      one.xEof = [](sqlite3_vtab_cursor* cursor) { return rows_of(cursor).over() ? 1 : 0; };
      one.xColumn = [](sqlite3_vtab_cursor* cursor, sqlite3_context* context, int which) {
        return guarded(cursor->pVtab, [&] { rows_of(cursor).tell(context, which); });
      };
      one.xRowid = [](sqlite3_vtab_cursor* cursor, sqlite3_int64* id) {
        *id = rows_of(cursor).place();
        return SQLITE_OK;
      };
      return one;
    }();
    return module;
  }
};

}  // namespace stampede::sql
