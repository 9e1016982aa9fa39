// Where a field stands in its file.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace stampede {

// Reads tables in Lua source: `objects.block.count` → the line of its first mention; `` → the line of the last
// `return` outside all brackets. Strings, comments and long brackets are passed over.
std::map<std::string, int> field_lines(std::string_view source);

// The line of a path, or of the nearest table around it; 1 when nothing is known.
int line_of(const std::map<std::string, int>& lines, std::string path);

}  // namespace stampede
