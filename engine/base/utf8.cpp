#include "engine/base/utf8.h"

#include <algorithm>
#include <cstdio>

#include "engine/base/error.h"

namespace stampede {

std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const auto follows = [&](std::size_t k) { return (byte(k) & 0xC0U) == 0x80U; };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first <= 0xDF) return follows(i + 1) ? 2 : 0;
  if (first >= 0xE0 && first <= 0xEF) {
    if (first == 0xE0 && byte(i + 1) < 0xA0) return 0;
    if (first == 0xED && byte(i + 1) > 0x9F) return 0;
    return follows(i + 1) && follows(i + 2) ? 3 : 0;
  }
  if (first >= 0xF0 && first <= 0xF4) {
    if (first == 0xF0 && byte(i + 1) < 0x90) return 0;
    if (first == 0xF4 && byte(i + 1) > 0x8F) return 0;
    return follows(i + 1) && follows(i + 2) && follows(i + 3) ? 4 : 0;
  }
  return 0;
}

std::size_t not_text_at(std::string_view text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = text[i] == '\0' ? 0 : utf8_length(text, i);
    if (length == 0) return i;
    i += length;
  }
  return std::string_view::npos;
}

void require_text(std::string_view text, const std::string& where) {
  const std::size_t at = not_text_at(text);
  if (at == std::string_view::npos) return;
  char byte[8];
  std::snprintf(byte, sizeof byte, "0x%02X", static_cast<unsigned char>(text[at]));
  const bool wide = text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff");
  throw Error(line_place(text, at, where),
              wide ? "this is UTF-16, no UTF-8" : "the byte " + std::string(byte) + " here is no UTF-8 text",
              text[at] == '\0' ? "remove it: texts hold no character 0" : "save the file as UTF-8");
}

std::string line_place(std::string_view text, std::size_t at, const std::string& where) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  return where + ":" + std::to_string(1 + std::count(before.begin(), before.end(), '\n'));
}

}  // namespace stampede
