// What an object is made of, as a table.
#pragma once

#include "db/query.h"
#include "engine/model/scene.h"

namespace stampede::program {

// A row for the object, each of its parts and each region: name, kind, type, traits, size (m, of its box), how it moves
// and its numbers, as predicates, skills and tasks name them. `scene`: of the object alone.
QueryResult object_table(const Scene& scene);

}  // namespace stampede::program
