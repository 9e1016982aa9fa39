// CSV files with a header: rows of fields, read one after the other.
#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// Fields are separated by commas; one that begins with a quote ends at the next, where two quotes stand for one.
// Throws Error with file and line for what is no UTF-8, rows of another length than the header's, a last line without a
// line end, which may be cut off, and more columns or bytes than anybody records.
class CsvFile {
 public:
  CsvFile(const std::filesystem::path& file, std::string shown);
  const std::vector<std::string>& header() const { return header_; }
  bool next();                                                          // false: there are no more rows
  const std::vector<std::string_view>& fields() const { return row_; }  // until the next row
  // Of the row: a number; NaN where the field is empty. Throws Error where it is none, or not finite.
  double number(std::size_t column) const;
  std::string place() const { return shown_ + ":" + std::to_string(line_); }
  const std::string& text() const { return text_; }  // the whole file

 private:
  bool read_row();
  void require_line_end() const;  // throws Error
  std::string shown_, text_;
  std::size_t at_ = 0;
  int line_ = 0;
  std::vector<std::string> header_;
  std::vector<std::string_view> row_;
  std::deque<std::string> unquoted_;  // fields of the row that held doubled quotes
};

}  // namespace stampede
