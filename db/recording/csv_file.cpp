#include "db/recording/csv_file.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "engine/base/error.h"
#include "engine/base/read_file.h"
#include "engine/base/utf8.h"

namespace stampede {
namespace {

constexpr std::size_t kMostColumns = 4096;
constexpr std::uintmax_t kMostCsvBytes = std::uintmax_t{512} << 20;

}  // namespace

CsvFile::CsvFile(const std::filesystem::path& file, std::string shown)
    : shown_(std::move(shown)), text_(read_file(file, kMostCsvBytes)) {
  require_text(text_, shown_);
  if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // how some programs begin UTF-8
  if (!read_row()) throw Error(shown_, "this file is empty", "its first line names the columns");
  if (row_.size() == 1 && row_[0].find_first_of(";\t") != std::string_view::npos)
    throw Error(place(), "its fields are not separated by commas",
                "write commas between fields, and a point in decimal numbers");
  for (const std::string_view name : row_) header_.emplace_back(name);
  if (header_.size() > kMostColumns)
    throw Error(place(),
                "it has " + std::to_string(header_.size()) + " columns, at most " + std::to_string(kMostColumns),
                "split it into streams of fewer columns");
  std::set<std::string_view> seen;
  for (const std::string& name : header_)
    if (!seen.insert(name).second)
      throw Error(place(), "two columns are named '" + name + "'", "name each column once");
  require_line_end();
}

bool CsvFile::read_row() {
  row_.clear();
  unquoted_.clear();
  while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) {  // empty lines
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }
  if (at_ >= text_.size()) return false;
  ++line_;
  while (true) {
    if (text_[at_] == '"') {
      std::string& field = unquoted_.emplace_back();
      for (++at_;; ++at_) {
        if (at_ >= text_.size()) throw Error(place(), "a quote is not closed", "end the field with a quote");
        if (text_[at_] != '"') {
          field += text_[at_];
        } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
          field += text_[at_++];
        } else {
          break;
        }
      }
      ++at_;
      row_.emplace_back(field);
    } else {
      const std::size_t end = std::min(text_.find_first_of(",\n\r", at_), text_.size());
      row_.emplace_back(std::string_view(text_).substr(at_, end - at_));
      at_ = end;
    }
    if (at_ >= text_.size() || text_[at_] != ',') break;
    if (++at_ >= text_.size()) {  // a comma ends the file
      row_.emplace_back();
      break;
    }
  }
  if (at_ < text_.size() && text_[at_] == '\r') ++at_;
  if (at_ < text_.size() && text_[at_] != '\n') throw Error(place(), "a comma is missing here");
  if (at_ < text_.size()) ++at_;
  return true;
}

// A file that was cut in its last number has as many fields as a whole one.
void CsvFile::require_line_end() const {
  if (at_ < text_.size() || text_.ends_with('\n') || text_.ends_with('\r')) return;
  throw Error(place(), "the file ends within this line: it may have been cut here",
              "copy it again; where nothing is missing, end its last line with a line end");
}

bool CsvFile::next() {
  if (!read_row()) return false;
  if (row_.size() != header_.size())
    throw Error(place(),
                "this row has " + std::to_string(row_.size()) + " fields, and the header names " +
                    std::to_string(header_.size()),
                at_ >= text_.size() ? "the file ends too early: copy it again" : "write one field for each column");
  require_line_end();
  return true;
}

double CsvFile::number(std::size_t column) const {
  const std::string_view text = row_[column];
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* const first = text.data() + (text[0] == '+' && !text.starts_with("+-") ? 1 : 0);
  const auto [stop, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    throw Error(place(), "column " + header_[column] + " holds '" + std::string(text) + "', no finite number",
                "leave the field empty where nothing was read");
  return value;
}

}  // namespace stampede
