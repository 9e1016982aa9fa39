// What modules of virtual tables share. Inside this room only.
#pragma once

#include <sqlite3.h>

#include <exception>
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

}  // namespace stampede::sql
