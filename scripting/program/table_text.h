// Rows of text as a table, CSV or JSON.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace stampede::program {

struct Cell {
  std::string text;
  bool number = false;  // right-aligned in tables, bare in JSON
  bool null = false;
};

struct TextTable {
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;
};

// Columns aligned; where the table is wider than `width` (0: unlimited) its widest columns are cut with `…`.
std::string as_table(const TextTable& table, int width);
std::string as_csv(const TextTable& table);   // RFC 4180, \n line ends; NULL is empty
std::string as_json(const TextTable& table);  // an array of objects

}  // namespace stampede::program
