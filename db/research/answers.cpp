#include "db/research/answers.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/read_file.h"
#include "engine/base/read_json.h"
#include "engine/base/utf8.h"

namespace stampede::research {
namespace {

using Json = nlohmann::ordered_json;

std::string column_names(const ResearchProblem& problem) {
  std::string text;
  for (const AnswerColumn& column : problem.answer) text += (text.empty() ? "" : ", ") + column.name;
  return "answers to " + problem.name + " have the columns " + text;
}

const AnswerColumn* find_column(const ResearchProblem& problem, std::string_view name) {
  for (const AnswerColumn& column : problem.answer)
    if (column.name == name) return &column;
  return nullptr;
}

std::string shown(const std::string& text) { return text.size() > 60 ? text.substr(0, 60) + "…" : text; }

[[noreturn]] void refuse_column(const std::string& where, const std::string& name, const ResearchProblem& problem) {
  throw Error(where, "there is no column '" + shown(name) + "'", column_names(problem));
}

// As text; of lists and objects only that they are ones.
std::string shown(const nlohmann::json& json) {
  if (json.is_array()) return "a list";
  if (json.is_object()) return "an object";
  return shown(json.dump());
}

[[noreturn]] void refuse_value(const std::string& where, const AnswerColumn& column, const std::string& found) {
  const char* wanted = column.type == AnswerType::integer ? "a whole number"
                       : column.type == AnswerType::real  ? "a finite number"
                                                          : "a text";
  throw Error(where, "'" + column.name + "' is " + wanted + ", not " + found, "it is: " + column.about);
}

SqlValue value_from(const nlohmann::json& json, const AnswerColumn& column, const std::string& where) {
  if (json.is_null() && column.optional) return std::monostate{};
  if (column.type == AnswerType::integer && json.is_number_integer()) return json.get<std::int64_t>();
  if (column.type == AnswerType::integer && json.is_number_float()) {
    const double number = json.get<double>();
    if (std::abs(number) < 1e15 && number == std::floor(number)) return static_cast<std::int64_t>(number);
  }
  if (column.type == AnswerType::real && json.is_number()) return json.get<double>();
  if (column.type == AnswerType::text && json.is_string()) return json.get<std::string>();
  refuse_value(where, column, shown(json));
}

std::vector<SqlValue> row_from(const nlohmann::json& json, const ResearchProblem& problem, const std::string& where) {
  if (!json.is_object()) throw Error(where, "an answer is an object", column_names(problem));
  for (const auto& [name, value] : json.items())
    if (!find_column(problem, name)) refuse_column(where, name, problem);
  std::vector<SqlValue> row;
  for (const AnswerColumn& column : problem.answer) {
    const auto found = json.find(column.name);
    if (found == json.end() && !column.optional)
      throw Error(where, "the column '" + column.name + "' is missing", column_names(problem));
    row.push_back(found == json.end() ? SqlValue(std::monostate{}) : value_from(*found, column, where));
  }
  return row;
}

constexpr const char* kCompare = "compare it with answers.example.json";

void read_json(const std::string& text, const ResearchProblem& problem, Answers& answers) {
  JsonLimits limits;
  limits.depth = 16;  // answers need three
  const nlohmann::json json = json_from_text(text, answers.where, kCompare, limits);
  if (!json.is_object()) throw Error(answers.where, "answers are one JSON object", kCompare);
  std::vector<std::string> known = {"answers", "by", "dataset", "problem"};
  for (const AnswerColumn& column : problem.answer_texts) known.push_back(column.name);
  require_known_fields(json, known, answers.where);
  for (const auto& [name, value] : json.items()) {
    if (name == "answers" || name == "by") continue;  // who made them is nobody's answer
    if (!value.is_string()) throw Error(answers.where, "'" + shown(name) + "' is a text", kCompare);
    if (name == "dataset")
      answers.dataset = value.get<std::string>();
    else if (name == "problem")
      answers.problem = value.get<std::string>();
    else
      answers.texts[name] = value.get<std::string>();
  }
  const auto rows = json.find("answers");
  if (rows == json.end()) return;
  if (!rows->is_array()) throw Error(answers.where, "'answers' is a list of objects", column_names(problem));
  if (problem.answer.empty() && !rows->empty())
    throw Error(answers.where, "'answers' has rows, of which this problem has none", kCompare);
  std::size_t number = 0;
  for (const nlohmann::json& row : *rows)
    answers.rows.rows.push_back(row_from(row, problem, answers.where + ", answer " + std::to_string(++number)));
}

// The cells of a line of CSV (RFC 4180, without line ends in cells).
std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (quoted && line[i] == '"' && i + 1 < line.size() && line[i + 1] == '"')
      cells.back() += line[++i];
    else if (line[i] == '"')
      quoted = !quoted;
    else if (line[i] == ',' && !quoted)
      cells.emplace_back();
    else
      cells.back() += line[i];
  }
  return cells;
}

SqlValue value_from(const std::string& cell, const AnswerColumn& column, const std::string& where) {
  if (cell.empty() && column.optional) return std::monostate{};
  if (column.type == AnswerType::text) return cell;
  const char* end = cell.data() + cell.size();
  if (column.type == AnswerType::integer) {
    std::int64_t number = 0;
    if (const auto read = std::from_chars(cell.data(), end, number); read.ec == std::errc{} && read.ptr == end)
      return number;
  } else {
    double number = 0;
    if (const auto read = std::from_chars(cell.data(), end, number);
        read.ec == std::errc{} && read.ptr == end && std::isfinite(number))
      return number;
  }
  refuse_value(where, column, "'" + shown(cell) + "'");
}

void read_csv(const std::string& text, const ResearchProblem& problem, Answers& answers) {
  std::vector<std::string> header;
  std::size_t begin = 0, line_number = 0;
  while (begin < text.size()) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    std::string line = text.substr(begin, end - begin);
    begin = end + 1, ++line_number;
    if (!line.empty() && line.back() == '\r') line.pop_back();
    const std::string where = answers.where + ":" + std::to_string(line_number);
    constexpr std::string_view kDataset = "# dataset: ";
    if (line.starts_with(kDataset)) answers.dataset = line.substr(kDataset.size());
    if (line.empty() || line[0] == '#') continue;
    const std::vector<std::string> cells = cells_of(line);
    if (header.empty()) {
      header = cells;
      for (const std::string& name : header)
        if (!find_column(problem, name)) refuse_column(where, name, problem);
      for (const std::string& name : header)
        if (std::count(header.begin(), header.end(), name) > 1)
          throw Error(where, "the column '" + name + "' is there twice", column_names(problem));
      for (const AnswerColumn& column : problem.answer)
        if (!column.optional && std::find(header.begin(), header.end(), column.name) == header.end())
          throw Error(where, "the column '" + column.name + "' is missing", column_names(problem));
      continue;
    }
    if (cells.size() != header.size())
      throw Error(where,
                  std::to_string(cells.size()) + " cells, where the header has " + std::to_string(header.size()));
    std::vector<SqlValue> row;
    for (const AnswerColumn& column : problem.answer) {
      const auto at = std::find(header.begin(), header.end(), column.name) - header.begin();
      row.push_back(static_cast<std::size_t>(at) == header.size()
                        ? SqlValue(std::monostate{})
                        : value_from(cells[static_cast<std::size_t>(at)], column, where));
    }
    if (end == text.size())
      throw Error(where, "the file ends within this line: it may have been cut here",
                  "write it again; where nothing is missing, end its last line with a line end");
    answers.rows.rows.push_back(std::move(row));
  }
}

Json json_of(const SqlValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* real = std::get_if<double>(&value)) return *real;
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

Json example_value(const AnswerColumn& column) {
  if (column.type == AnswerType::integer) return std::stoll(column.example);
  if (column.type == AnswerType::real) return std::stod(column.example);
  return column.example;
}

}  // namespace

Answers read_answers(const std::filesystem::path& file, const ResearchProblem& problem) {
  Answers answers;
  answers.where = file.string();
  for (const AnswerColumn& column : problem.answer) answers.rows.columns.push_back(column.name);
  std::string text = read_file(file);
  require_text(text, answers.where);
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);  // a byte order mark, as spreadsheets write it
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) throw Error(answers.where, "this file is empty", kCompare);
  if (text[first] == '{' || text[first] == '[')
    read_json(text, problem, answers);
  else
    read_csv(text, problem, answers);
  return answers;
}

std::string answers_text(const Answers& answers) {
  Json head = {{"by", "stampede baseline"}, {"dataset", answers.dataset}, {"problem", answers.problem}};
  for (const auto& [name, text] : answers.texts) head[name] = text;
  std::string text = head.dump();
  text.pop_back();
  if (answers.rows.columns.empty()) return text + "}\n";
  text += ",\"answers\":[";  // an answer a line: for people, and for comparing files
  const char* between = "\n";
  for (const auto& row : answers.rows.rows) {
    Json one = Json::object();
    for (std::size_t i = 0; i < row.size(); ++i)
      if (!std::holds_alternative<std::monostate>(row[i])) one[answers.rows.columns[i]] = json_of(row[i]);
    text += between + one.dump();
    between = ",\n";
  }
  return text + "\n]}\n";
}

std::string example_answers(const ResearchProblem& problem, const std::string& dataset,
                            const std::vector<std::int64_t>& units) {
  Json json = {{"dataset", dataset}, {"problem", problem.name}};
  for (const AnswerColumn& column : problem.answer_texts) json[column.name] = column.example;
  if (!problem.answer.empty()) json["answers"] = Json::array();
  for (std::size_t i = 0; !problem.answer.empty() && i < std::min<std::size_t>(units.size(), 2); ++i) {
    Json row = Json::object();
    for (const AnswerColumn& column : problem.answer)
      if (!column.example.empty())
        row[column.name] = &column == &problem.answer.front() ? Json(units[i]) : example_value(column);
    json["answers"].push_back(row);
  }
  return json.dump(2) + "\n";
}

}  // namespace stampede::research
