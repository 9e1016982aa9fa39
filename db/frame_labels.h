// Tables for questions that are worked out from an episode when they are asked: db/README.md describes them. Inside
// this room only.
#pragma once

#include "db/sqlite.h"

namespace stampede {

// `progress` and `applicable`, for statements of this connection. Lifetime: the database stays where it is.
void add_frame_labels(const sql::Database& database);

}  // namespace stampede
