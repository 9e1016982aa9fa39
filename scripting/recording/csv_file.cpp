#include "scripting/recording/csv_file.h"

#include <charconv>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "scripting/session/text_file.h"

namespace stampede {

CsvFile::CsvFile(const std::filesystem::path& file, std::string shown)
    : shown_(std::move(shown)), text_(read_text_file(file)) {
  if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;  // how some programs begin UTF-8
  if (!read_row()) throw Error(shown_, "this file is empty", "its first line names the columns");
  if (row_.size() == 1 && row_[0].find_first_of(";\t") != std::string_view::npos)
    throw Error(place(), "its fields are not separated by commas",
                "write commas between fields, and a point in decimal numbers");
  for (const std::string_view name : row_) header_.emplace_back(name);
  for (std::size_t i = 0; i < header_.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      if (header_[i] == header_[j])
        throw Error(place(), "two columns are named '" + header_[i] + "'", "name each column once");
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

bool CsvFile::next() {
  if (!read_row()) return false;
  if (row_.size() != header_.size())
    throw Error(place(),
                "this row has " + std::to_string(row_.size()) + " fields, and the header names " +
                    std::to_string(header_.size()),
                at_ >= text_.size() ? "the file ends too early: copy it again" : "write one field for each column");
  return true;
}

double CsvFile::number(std::size_t column) const {
  const std::string_view text = row_[column];
  if (text.empty()) return std::numeric_limits<double>::quiet_NaN();
  double value = 0;
  const char* const first = text.data() + (text[0] == '+' ? 1 : 0);
  const auto [stop, error] = std::from_chars(first, text.data() + text.size(), value);
  if (error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    throw Error(place(), "column " + header_[column] + " holds '" + std::string(text) + "', no finite number",
                "leave the field empty where nothing was read");
  return value;
}

}  // namespace stampede
