// Bytes as text (RFC 4648, section 4).
#pragma once

#include <string>
#include <string_view>

namespace stampede {

std::string to_base64(std::string_view bytes);
std::string from_base64(std::string_view text);  // throws Error for anything that to_base64 does not write

}  // namespace stampede
