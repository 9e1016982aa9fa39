// Bytes made shorter, and back (zlib, RFC 1950).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace stampede {

// The same bytes for the same bytes.
std::string deflated(std::string_view bytes);

// Throws Error for what is damaged, or was not of this size.
std::string inflated(std::string_view bytes, std::size_t size);

}  // namespace stampede
