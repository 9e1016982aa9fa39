#include "scripting/program/table_text.h"

#include <algorithm>

#include "scripting/program/console.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

std::string one_line(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '\n' || c == '\r' || c == '\t' ? ' ' : c;
  return result;
}

std::vector<int> column_widths(const TextTable& table, int width) {
  std::vector<int> widths;
  for (const std::string& column : table.columns) widths.push_back(display_width(column));
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], display_width(row[c].text));
  }
  const auto total = [&] {
    int sum = 2 * (static_cast<int>(widths.size()) - 1);
    for (const int w : widths) sum += w;
    return sum;
  };
  while (width > 0 && total() > width) {
    int& widest = *std::max_element(widths.begin(), widths.end());
    if (widest <= 8) break;  // narrower than that nothing can be read
    --widest;
  }
  return widths;
}

void add_line(std::string& text, std::string line) {
  while (!line.empty() && line.back() == ' ') line.pop_back();
  text += line + "\n";
}

std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

}  // namespace

std::string as_table(const TextTable& table, int width) {
  const std::vector<int> widths = column_widths(table, width);
  std::string text, header, rule;
  for (std::size_t c = 0; c < widths.size(); ++c) {
    const std::string gap = c == 0 ? "" : "  ";
    const bool number = !table.rows.empty() && table.rows.front()[c].number;
    const std::string name = clipped(table.columns[c], widths[c]);
    header += gap + (number ? right_aligned(name, widths[c]) : padded(name, widths[c]));
    rule += gap + repeated("─", widths[c]);
  }
  add_line(text, header);
  add_line(text, rule);
  for (const auto& row : table.rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string shown = clipped(one_line(row[c].text), widths[c]);
      line += (c == 0 ? "" : "  ") + (row[c].number ? right_aligned(shown, widths[c]) : padded(shown, widths[c]));
    }
    add_line(text, line);
  }
  return text;
}

std::string as_csv(const TextTable& table) {
  std::string text;
  for (std::size_t c = 0; c < table.columns.size(); ++c) text += (c == 0 ? "" : ",") + csv_field(table.columns[c]);
  text += "\n";
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) text += (c == 0 ? "" : ",") + csv_field(row[c].text);
    text += "\n";
  }
  return text;
}

std::string as_json(const TextTable& table) {
  std::string text = "[";
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    text += r == 0 ? "\n  {" : ",\n  {";
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
      const Cell& cell = table.rows[r][c];
      text += (c == 0 ? "" : ", ") + json_quoted(table.columns[c]) + ": ";
      text += cell.null ? "null" : cell.number ? cell.text : json_quoted(cell.text);
    }
    text += "}";
  }
  return text + (table.rows.empty() ? "]\n" : "\n]\n");
}

}  // namespace stampede::program
