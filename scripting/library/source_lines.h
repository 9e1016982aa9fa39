// Where a field stands in its file.
#pragma once

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// Reads tables in Lua source: `objects.block.count` → the line of its first mention; `` → the line of the last
// `return` outside all brackets. Strings, comments and long brackets are passed over.
std::map<std::string, int> field_lines(std::string_view source);

// The line of a path, or of the nearest table around it; 1 when nothing is known.
int line_of(const std::map<std::string, int>& lines, std::string path);

// The line that speaks of a ground atom, as is.inside("cup", "shelf") or in PDDL; of several the one that names most of
// its arguments. 0: none.
int line_of_atom(std::string_view source, std::string_view predicate, const std::vector<std::string>& arguments);

// What a source names, comments passed over.
struct Mentions {
  std::set<std::string> after_is, after_act;  // is.NAME and is_not.NAME; act.NAME
  std::set<std::string> texts;                // all texts, without their quotes
  std::set<std::string> fields;               // paths, as of field_lines
  std::set<std::string> policies;             // policy("NAME") and robot:policy("NAME")
  std::map<std::string, int> numbers;         // w:number(…, "NAME"), and the line of the first
  using Members = std::map<std::pair<std::string, std::string>, int>;
  Members methods, members;  // OWNER:NAME and OWNER.NAME, where OWNER stands alone, and the line of the first
};
Mentions mentions_in(std::string_view source);

}  // namespace stampede
