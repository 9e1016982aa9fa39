// What a connection may do, whatever a file or a question says: one place for all of them. Inside this room only.
#pragma once

#include <sqlite3.h>

#include <set>
#include <string>

namespace stampede::sql {

// question: a user's, which reads and does nothing else. read: ours, which may also make temporary views. write: ours,
// which makes and fills tables. None reads views that are stored in a file, makes triggers or virtual tables by itself,
// loads code or changes the schema by hand.
enum class Purpose { question, read, write };

struct Permissions {
  Purpose purpose = Purpose::question;
  bool may_attach = false;                // while a file is attached that we name ourselves
  bool may_show = false;                  // while a temporary table is made of a module of ours
  std::set<std::string>* read = nullptr;  // receives the names of tables and views that a statement would read
};

// Takes from the connection what files could abuse: triggers, stored views, functions in declarations that reach out,
// hand-written schemas. `permissions` must outlive the connection, and may change at any time.
void restrict_to(sqlite3* handle, Permissions* permissions);

}  // namespace stampede::sql
