// Names of files that are made from data: of cameras, tasks, channels, domains, sentences.
#pragma once

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>

namespace stampede {

// One part of a path, whatever the text is. Letters (of any alphabet), digits, `_`, `-`, `.`, blanks and harmless marks
// stay; everything else is %XX of its bytes: separators, control characters, what is no UTF-8, `%` itself, a dot,
// dash, tilde or blank at the beginning, a dot or blank at the end, and the first letter of names that some systems
// keep to themselves (con, nul, com1). Two texts never give one name. Long ones are cut at kLongestFileName bytes and
// end in a hash.
std::string file_name(std::string_view text);
inline constexpr std::size_t kLongestFileName = 160;  // leaves room for an ending

// The names in one folder: those of different letters' size are told apart too, since not all disks do.
class FileNames {
 public:
  explicit FileNames(std::initializer_list<std::string_view> taken = {});  // what the folder's owner writes by itself

  // A name that none before it had, the same for the same calls: file_name(text), with a number where that is taken.
  std::string take(std::string_view text);

 private:
  std::set<std::string> taken_;  // in small letters
};

}  // namespace stampede
