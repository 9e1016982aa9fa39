#include "scripting/session/own_words.h"

#include <algorithm>
#include <cctype>

namespace stampede {
namespace {

bool is_letter(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }

}  // namespace

std::string without_flags(const std::string& text) {
  std::string said;
  bool command = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char before = at == 0 ? ' ' : text[at - 1];
    command ^= text[at] == '`';
    // Within a word `--` is PDDL's: chest--top_drawer.
    const bool flag = !command && text.compare(at, 2, "--") == 0 && at + 2 < text.size() && is_letter(text[at + 2]) &&
                      std::isalnum(static_cast<unsigned char>(before)) == 0 && before != '_' && before != '-';
    if (!flag) {
      said += text[at];
      continue;
    }
    std::size_t end = at + 2;
    while (end < text.size() &&
           (is_letter(text[end]) || (text[end] == '-' && end + 1 < text.size() && is_letter(text[end + 1]))))
      ++end;
    std::string word = text.substr(at + 2, end - at - 2);
    std::replace(word.begin(), word.end(), '-', '_');
    said += word == "path" ? "paths" : word;
    at = end - 1;
  }
  return said;
}

}  // namespace stampede
