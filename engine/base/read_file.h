// The bytes of a file that somebody named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace stampede {

inline constexpr std::uintmax_t kMostFileBytes = std::uintmax_t{1} << 30;

// Throws Error for what is not there, is no plain file (a pipe would keep us waiting, a device never end), or is
// larger.
std::string read_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMostFileBytes);

}  // namespace stampede
