#include "engine/base/printable.h"

#include <cstdint>

#include "engine/base/utf8.h"

namespace stampede {
namespace {

// The value of a character at the start, and its length; 0: there is none.
std::size_t decode(std::string_view text, std::uint32_t& value) {
  const std::size_t length = utf8_length(text, 0);
  value = static_cast<unsigned char>(text[0]);
  if (length > 1) value &= 0xFFU >> (length + 1);
  for (std::size_t i = 1; i < length; ++i) value = value << 6 | (static_cast<unsigned char>(text[i]) & 0x3FU);
  return length;
}

// Controls of both sets, line and paragraph ends, joiners and what turns the direction of writing (Unicode's Cc, Zl,
// Zp, Cf), tags, private and unassigned ends of planes.
bool obeyed(std::uint32_t c) {
  return c < 0x20 || (c >= 0x7F && c <= 0x9F) || c == 0xAD || c == 0x61C || c == 0x180E ||
         (c >= 0x200B && c <= 0x200F) || (c >= 0x2028 && c <= 0x202E) || (c >= 0x2060 && c <= 0x206F) || c == 0xFEFF ||
         (c >= 0xFFF9 && c <= 0xFFFB) || (c & 0xFFFE) == 0xFFFE || (c >= 0xE0000 && c <= 0xE0FFF);
}

std::string hexadecimal(std::uint32_t value, int digits) {
  std::string text;
  for (int shift = 4 * (digits - 1); shift >= 0; shift -= 4) text += "0123456789abcdef"[value >> shift & 15];
  return text;
}

std::string escape_of(std::string_view bytes) {
  std::uint32_t value = 0;
  const std::size_t length = decode(bytes, value);
  if (length <= 1) return "\\x" + hexadecimal(static_cast<unsigned char>(bytes[0]), 2);
  return value > 0xFFFF ? "\\U" + hexadecimal(value, 8) : "\\u" + hexadecimal(value, 4);
}

std::string without_orders(std::string_view text, bool lines) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const CodePoint point = code_point(text);
    const char c = point.bytes[0];
    if (point.printable || (lines && (c == '\n' || c == '\t')))
      result += point.bytes;
    else if (c == '\n' || c == '\t' || c == '\r')
      result += c == '\n' ? "\\n" : c == '\t' ? "\\t" : "\\r";
    else
      result += escape_of(point.bytes);
    text.remove_prefix(point.bytes.size());
  }
  return result;
}

}  // namespace

CodePoint code_point(std::string_view text) {
  std::uint32_t value = 0;
  const std::size_t length = decode(text, value);
  return length == 0 ? CodePoint{text.substr(0, 1), false} : CodePoint{text.substr(0, length), !obeyed(value)};
}

std::string printable(std::string_view text) { return without_orders(text, true); }
std::string printable_line(std::string_view text) { return without_orders(text, false); }

}  // namespace stampede
