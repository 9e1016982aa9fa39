#include "engine/base/file_name.h"

#include <algorithm>
#include <array>

#include "engine/base/hash.h"
#include "engine/base/printable.h"

namespace stampede {
namespace {

constexpr std::string_view kElsewhere = "/\\:*?\"<>|%";  // the first separates here, all mean something somewhere

std::string escaped(std::string_view bytes) {
  constexpr std::string_view kHexadecimal = "0123456789ABCDEF";
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    text += {'%', kHexadecimal[byte >> 4], kHexadecimal[byte & 15]};
  }
  return text;
}

std::string small(std::string_view text) {
  std::string result(text);
  for (char& c : result)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return result;
}

// Devices of DOS, which Windows finds in every folder, whatever the ending.
bool is_reserved(std::string_view text) {
  const std::string stem = small(text.substr(0, text.find('.')));
  if (stem == "con" || stem == "prn" || stem == "aux" || stem == "nul") return true;
  return stem.size() == 4 && (stem.starts_with("com") || stem.starts_with("lpt")) && stem[3] >= '0' && stem[3] <= '9';
}

bool stays(const CodePoint& point) {
  if (!point.printable) return false;
  return point.bytes.size() > 1 || kElsewhere.find(point.bytes[0]) == std::string_view::npos;
}

}  // namespace

std::string file_name(std::string_view text) {
  if (text.empty()) return "%";
  std::string name;
  std::size_t whole = 0;  // bytes of the name that a long one keeps
  const bool reserved = is_reserved(text);
  for (std::size_t at = 0; at < text.size();) {
    const CodePoint point = code_point(text.substr(at));
    const bool first = at == 0, last = at + point.bytes.size() == text.size();
    const char c = point.bytes[0];
    const bool misplaced =
        (first && (c == '.' || c == '-' || c == ' ' || c == '~' || reserved)) || (last && (c == '.' || c == ' '));
    name += stays(point) && !misplaced ? std::string(point.bytes) : escaped(point.bytes);
    at += point.bytes.size();
    if (name.size() + 18 <= kLongestFileName) whole = name.size();
  }
  if (name.size() <= kLongestFileName) return name;
  return name.substr(0, whole) + "%-" + content_hash(text).substr(0, 16);  // no escape begins so
}

FileNames::FileNames(std::initializer_list<std::string_view> taken) {
  for (const std::string_view name : taken) taken_.insert(small(name));
}

std::string FileNames::take(std::string_view text) {
  const std::string name = file_name(text);
  std::string chosen = name;
  for (int number = 2; !taken_.insert(small(chosen)).second; ++number) chosen = name + "%~" + std::to_string(number);
  return chosen;
}

}  // namespace stampede
