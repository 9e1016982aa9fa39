// Tables of the given part in which not all was measured: a recorded hand without touch, say, has NULL in its columns.
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "db/plain_file.h"

namespace stampede::research {

// A column that is NULL throughout was not measured, and is left out. One that is NULL here and there is a mistake: no
// number can stand for what is missing.
class KnownColumns {
 public:
  KnownColumns(const PlainFile& given, std::string_view table);
  bool has(std::string_view column) const { return !left_out_.contains(column); }
  // Of rows of that table: 0 for columns that are left out, which is the same everywhere and tells nothing. Throws
  // Error for NULL in another.
  double real(const Rows& rows, std::size_t row, std::string_view column) const;

 private:
  std::string where_;
  std::set<std::string, std::less<>> left_out_;
};

}  // namespace stampede::research
