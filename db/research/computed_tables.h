// Tables of data sets that no SELECT can say, because they are worked out from an episode's arrays.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "db/catalogue.h"

namespace stampede::research {

struct ComputedTable {
  std::string name, description;
  Rows (*rows)(const Catalogue& catalogue, std::int64_t episode) = nullptr;
};

const ComputedTable* find_computed_table(std::string_view name);  // nullptr: there is none
std::string describe_table(std::string_view name);                // computed or a SELECT's; empty: there is none

}  // namespace stampede::research
