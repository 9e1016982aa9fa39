#include "stampede/rows.h"

#include <algorithm>
#include <array>

#include "engine/base/error.h"
#include "engine/base/nearest.h"

namespace stampede {
namespace {

constexpr std::array<const char*, 5> kTypes{"NULL", "integer", "real", "text", "blob"};

template <typename Value>
const Value& value_in(const Rows& rows, std::size_t row, std::string_view column, const char* wanted) {
  const SqlValue& value = rows.at(row, column);
  if (const Value* found = std::get_if<Value>(&value)) return *found;
  throw Error("row " + std::to_string(row) + ", column " + std::string(column),
              std::string("the value is ") + kTypes.at(value.index()) + ", not " + wanted);
}

}  // namespace

const SqlValue& Rows::at(std::size_t row, std::string_view column) const {
  const auto found = std::find(columns.begin(), columns.end(), column);
  if (found == columns.end())
    throw Error(std::string(column), "the answer has no such column", did_you_mean(column, columns));
  if (row >= rows.size())
    throw Error("row " + std::to_string(row), "the answer has " + std::to_string(rows.size()) + " rows");
  return rows[row].at(static_cast<std::size_t>(found - columns.begin()));
}

bool Rows::is_null(std::size_t row, std::string_view column) const { return at(row, column).index() == 0; }

std::int64_t Rows::integer(std::size_t row, std::string_view column) const {
  return value_in<std::int64_t>(*this, row, column, "an integer");
}

double Rows::real(std::size_t row, std::string_view column) const {
  if (const auto* whole = std::get_if<std::int64_t>(&at(row, column))) return static_cast<double>(*whole);
  return value_in<double>(*this, row, column, "a number");
}

const std::string& Rows::text(std::size_t row, std::string_view column) const {
  return value_in<std::string>(*this, row, column, "a text");
}

const std::string& Rows::blob(std::size_t row, std::string_view column) const {
  return value_in<SqlBlob>(*this, row, column, "a blob").bytes;
}

}  // namespace stampede
