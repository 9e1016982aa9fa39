// What a catalogue answers: rows of typed values.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "stampede/basics.h"

namespace stampede {

struct SqlBlob {
  std::string bytes;
  friend bool operator==(const SqlBlob&, const SqlBlob&) = default;
};
using SqlValue = std::variant<std::monostate, std::int64_t, double, std::string, SqlBlob>;  // monostate: NULL

// A cell is named by its row and column. Throws Error for one that is not there (with the nearest name as cure) and for
// a value of another type, NULL included; `real` takes whole numbers too.
struct STAMPEDE_EXPORT Rows {
  std::vector<std::string> columns;
  std::vector<std::vector<SqlValue>> rows;
  bool cut = false;  // there were more rows than asked for

  std::size_t size() const { return rows.size(); }
  const SqlValue& at(std::size_t row, std::string_view column) const;
  bool is_null(std::size_t row, std::string_view column) const;
  std::int64_t integer(std::size_t row, std::string_view column) const;
  double real(std::size_t row, std::string_view column) const;
  const std::string& text(std::size_t row, std::string_view column) const;
  const std::string& blob(std::size_t row, std::string_view column) const;
};

}  // namespace stampede
