// Tables for questions that are worked out from an episode when they are asked: db/README.md describes them. Inside
// this room only.
#pragma once

#include <cstdint>
#include <functional>

#include "db/sqlite.h"
#include "stampede/arrays.h"

namespace stampede {

// `progress` and `applicable`, for statements of this connection. Lifetime: the database stays where it is. Episodes
// are those of its table; `arrays` reads one of them.
using ReadsArrays = std::function<EpisodeArrays(std::int64_t episode, const ArrayRequest& request)>;
void add_frame_labels(const sql::Database& database, ReadsArrays arrays);
void add_frame_labels(const sql::Database& database);  // which has the arrays too

}  // namespace stampede
