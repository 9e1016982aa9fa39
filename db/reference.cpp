#include "db/reference.h"

#include <algorithm>
#include <sstream>

#include "db/embedded_sql.h"
#include "db/table_text.h"
#include "engine/base/text.h"

namespace stampede {
namespace {

// `| `episode` | number of the episode | – | – | never |`
ViewColumn column_of(const std::string& line) {
  std::istringstream row(line);
  std::vector<std::string> cells;
  for (std::string cell; std::getline(row, cell, '|');) cells.push_back(trimmed(cell));
  cells.resize(6);
  const auto known = [](const std::string& cell) { return cell == "–" ? std::string() : cell; };
  return {cells[1].substr(1, cells[1].size() - 2), cells[2], known(cells[3]), known(cells[4]), cells[5]};
}

std::string told(const ViewColumn& column) {
  std::string text = column.meaning;
  if (!column.unit.empty()) text += "; " + column.unit;
  if (!column.frame.empty()) text += "; frame of reference: " + column.frame;
  if (column.null != "never") text += "; NULL: " + column.null;
  return text;
}

}  // namespace

const std::vector<ViewReference>& view_reference() {
  static const std::vector<ViewReference> views = [] {
    std::vector<ViewReference> list;
    std::istringstream lines(embedded_readme());
    for (std::string line; std::getline(lines, line);) {
      if (line.starts_with("### ")) {
        list.push_back({line.substr(4), "", {}});
      } else if (!list.empty() && line.starts_with("| `")) {
        list.back().columns.push_back(column_of(line));
      } else if (!list.empty() && list.back().columns.empty() && !line.empty() && line.front() != '|') {
        list.back().description += (list.back().description.empty() ? "" : " ") + line;
      }
    }
    return list;
  }();
  return views;
}

std::string datasette_metadata(const std::string& database) {
  std::string text = "{\"databases\": {" + json_text(database) + ": {\"tables\": {";
  const char* before = "\n";
  for (const ViewReference& view : view_reference()) {
    text += before + json_text(view.name) + ": {\"description\": " + json_text(view.description) + ", \"columns\": {";
    before = "";
    for (const ViewColumn& column : view.columns) {
      text += before + json_text(column.name) + ": " + json_text(told(column));
      before = ", ";
    }
    text += "}}";
    before = ",\n";
  }
  return text + "}}}}\n";
}

}  // namespace stampede
