#include "engine/base/utf8.h"

#include <algorithm>
#include <cstdio>

#include "engine/base/error.h"

namespace stampede {

std::size_t utf8_length(std::string_view text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0U; };
  const unsigned first = byte(i);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
  // The second byte tells what is in more bytes than it takes, a surrogate, or beyond the last code point.
  const unsigned least = first == 0xE0 ? 0xA0 : first == 0xF0 ? 0x90 : 0x80;
  const unsigned most = first == 0xED ? 0x9F : first == 0xF4 ? 0x8F : 0xBF;
  if (byte(i + 1) < least || byte(i + 1) > most) return 0;
  for (std::size_t k = 2; k < length; ++k)
    if ((byte(i + k) & 0xC0U) != 0x80U) return 0;
  return length;
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
