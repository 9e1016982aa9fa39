#include "db/research/known_columns.h"

#include "engine/base/error.h"

namespace stampede::research {

KnownColumns::KnownColumns(const PlainFile& given, std::string_view table)
    : where_(given.path().string() + ", table " + std::string(table)) {
  const Rows columns = given.query("SELECT name FROM pragma_table_info('" + std::string(table) + "')");
  std::string select;
  for (std::size_t i = 0; i < columns.size(); ++i)
    select += (select.empty() ? "SELECT count(\"" : ", count(\"") + columns.text(i, "name") + "\")";
  if (select.empty()) return;
  const Rows counts = given.query(select + " FROM \"" + std::string(table) + "\"");
  for (std::size_t i = 0; i < columns.size(); ++i)
    if (counts.rows.front().at(i) == SqlValue(std::int64_t{0})) left_out_.insert(columns.text(i, "name"));
}

double KnownColumns::real(const Rows& rows, std::size_t row, std::string_view column) const {
  if (!has(column)) return 0;
  if (rows.is_null(row, column))
    throw Error(where_, "the column " + std::string(column) + " is NULL in some rows, and a number in others",
                "make the data set of a catalogue whose episodes were all measured alike: all simulated, or all "
                "recorded with the same streams");
  return rows.real(row, column);
}

}  // namespace stampede::research
