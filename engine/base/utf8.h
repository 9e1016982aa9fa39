// Whether bytes are UTF-8 text: all that is stored is, so that all that is stored can be written again.
#pragma once

#include <string>
#include <string_view>

namespace stampede {

// The length of the sequence that begins at `i`; 0 where it is not well formed (RFC 3629).
std::size_t utf8_length(std::string_view text, std::size_t i);

// The first byte that is no UTF-8, or the character 0, which ends texts in many programs; npos: none.
std::size_t not_text_at(std::string_view text);

// Throws Error for such a byte, at `where:LINE`.
void require_text(std::string_view text, const std::string& where);

// `where:LINE` of a byte.
std::string line_place(std::string_view text, std::size_t at, const std::string& where);

}  // namespace stampede
