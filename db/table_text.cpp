#include "db/table_text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <sstream>

#include "engine/base/printable.h"
#include "engine/base/utf8.h"

namespace stampede {
namespace {

std::string hexadecimal(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += "0123456789abcdef"[byte >> 4];
    text += "0123456789abcdef"[byte & 15];
  }
  return text;
}

// The shortest text that reads back to the same number; always with a sign that it is real.
std::string exact(double value) {
  if (std::isinf(value)) return value > 0 ? "Infinity" : "-Infinity";
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  std::string text(buffer.data(), end);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string rounded(double value) {
  std::array<char, 40> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

constexpr const char* kNull = "NULL";  // in tables

struct TableCell {
  std::string operator()(std::monostate) const { return kNull; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return rounded(value); }
  std::string operator()(const std::string& value) const {
    return value == kNull ? "'" + value + "'" : printable_line(value);
  }
  std::string operator()(const SqlBlob& value) const { return "<" + std::to_string(value.bytes.size()) + " bytes>"; }
};

std::string csv_text(const std::string& value) {
  if (!value.empty() && value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string text = "\"";
  for (const char c : value) text += c == '"' ? "\"\"" : std::string(1, c);
  return text + "\"";
}

struct CsvCell {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return exact(value); }
  std::string operator()(const std::string& value) const { return csv_text(value); }
  std::string operator()(const SqlBlob& value) const { return hexadecimal(value.bytes); }
};

struct JsonCell {
  std::string operator()(std::monostate) const { return "null"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return std::isinf(value) ? json_text(exact(value)) : exact(value); }
  std::string operator()(const std::string& value) const { return json_text(value); }
  std::string operator()(const SqlBlob& value) const { return json_text(hexadecimal(value.bytes)); }
};

bool is_number(const SqlValue& value) {
  return std::holds_alternative<std::int64_t>(value) || std::holds_alternative<double>(value);
}

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string space(width - std::min(width, width_of(text)), ' ');
  return right ? space + text : text + space;
}

void end_line(std::string& text) {
  while (!text.empty() && text.back() == ' ') text.pop_back();
  text += '\n';
}

class TableWriter : public RowWriter {
 public:
  explicit TableWriter(std::ostream& out) : out_(out) {}
  void columns(const std::vector<std::string>& names) override {
    for (const std::string& name : names) names_.push_back(printable_line(name));
    right_.resize(names.size());
    for (const std::string& name : names_) width_.push_back(width_of(name));
  }
  bool row(const std::vector<SqlValue>& values) override {
    std::vector<std::string> line;
    for (const SqlValue& value : values) line.push_back(std::visit(TableCell{}, value));
    if (shown_) {
      write(line);
    } else {
      for (std::size_t i = 0; i < line.size(); ++i) {
        width_[i] = std::max(width_[i], width_of(line[i]));
        if (is_number(values[i])) right_[i] = true;
      }
      waiting_.push_back(std::move(line));
      if (waiting_.size() == kRowsThatDecide) show();
    }
    return out_.good();
  }
  void finish() override {
    if (!shown_) show();
  }

 private:
  static constexpr std::size_t kRowsThatDecide = 1000;
  void show() {
    shown_ = true;
    write(names_);
    std::vector<std::string> lines;
    for (const std::size_t width : width_) lines.emplace_back(width, '-');
    write(lines);
    for (const auto& line : waiting_) write(line);
    waiting_.clear();
  }
  void write(const std::vector<std::string>& cells) {
    std::string text;
    for (std::size_t i = 0; i < cells.size(); ++i) text += (i ? "  " : "") + padded(cells[i], width_[i], right_[i]);
    end_line(text);
    out_ << text;
  }
  std::ostream& out_;
  std::vector<std::string> names_;
  std::vector<std::size_t> width_;
  std::vector<bool> right_;
  std::vector<std::vector<std::string>> waiting_;
  bool shown_ = false;
};

class CsvWriter : public RowWriter {
 public:
  explicit CsvWriter(std::ostream& out) : out_(out) {}
  void columns(const std::vector<std::string>& names) override {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) text += (i ? "," : "") + csv_text(names[i]);
    out_ << text << '\n';
  }
  bool row(const std::vector<SqlValue>& values) override {
    std::string text;
    for (std::size_t i = 0; i < values.size(); ++i) text += (i ? "," : "") + std::visit(CsvCell{}, values[i]);
    out_ << text << '\n';
    return out_.good();
  }
  void finish() override {}

 private:
  std::ostream& out_;
};

class JsonWriter : public RowWriter {
 public:
  explicit JsonWriter(std::ostream& out) : out_(out) {}
  void columns(const std::vector<std::string>& names) override {
    for (const std::string& name : names) keys_.push_back(json_text(name) + ": ");
    out_ << '[';
  }
  bool row(const std::vector<SqlValue>& values) override {
    std::string text = any_ ? ",\n {" : "\n {";
    any_ = true;
    for (std::size_t i = 0; i < values.size(); ++i)
      text += (i ? ", " : "") + keys_[i] + std::visit(JsonCell{}, values[i]);
    out_ << text << '}';
    return out_.good();
  }
  void finish() override { out_ << (any_ ? "\n]\n" : "]\n"); }

 private:
  std::ostream& out_;
  std::vector<std::string> keys_;
  bool any_ = false;
};

std::string all_of(const QueryResult& result, TextFormat format) {
  std::ostringstream out;
  const std::unique_ptr<RowWriter> writer = row_writer(format, out);
  writer->columns(result.columns);
  for (const auto& row : result.rows) writer->row(row);
  writer->finish();
  return std::move(out).str();
}

}  // namespace

std::string json_text(std::string_view text) {
  std::string json = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = utf8_length(text, i);
    const char c = text[i];
    if (length == 0) {
      json += "\\ufffd";
    } else if (c == '"' || c == '\\') {
      json += std::string("\\") + c;
    } else if (c == '\n') {
      json += "\\n";
    } else if (static_cast<unsigned char>(c) < 0x20) {
      json += "\\u00" + hexadecimal({&c, 1});
    } else {
      json += text.substr(i, length);
    }
    i += std::max<std::size_t>(length, 1);
  }
  return json + "\"";
}

std::unique_ptr<RowWriter> row_writer(TextFormat format, std::ostream& out) {
  if (format == TextFormat::csv) return std::make_unique<CsvWriter>(out);
  if (format == TextFormat::json) return std::make_unique<JsonWriter>(out);
  return std::make_unique<TableWriter>(out);
}

std::string to_table(const QueryResult& result) {
  return all_of(result, TextFormat::table) + (result.cut ? "… and more rows\n" : "");
}

std::string to_csv(const QueryResult& result) { return all_of(result, TextFormat::csv); }

std::string to_json(const QueryResult& result) { return all_of(result, TextFormat::json); }

}  // namespace stampede
