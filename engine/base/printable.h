// Text for people: what a script, a file, a program or a model said, without what a terminal would obey.
#pragma once

#include <string>
#include <string_view>

namespace stampede {

// The first character of a text that is not empty.
struct CodePoint {
  std::string_view bytes;  // one, where they are no UTF-8
  bool printable = false;  // neither a control character, nor one that turns or hides what follows, nor no UTF-8
};
CodePoint code_point(std::string_view text);

// Line ends and tabs stay, everything else that is not printable is written as an escape: \x1b, \u202e.
std::string printable(std::string_view text);
// As one line: line ends and tabs are written as escapes too.
std::string printable_line(std::string_view text);

}  // namespace stampede
