// Whole files as text.
#pragma once

#include <filesystem>
#include <string>

#include "engine/base/read_file.h"

namespace stampede {

// Without a byte order mark. Throws Error as read_file does.
std::string read_text_file(const std::filesystem::path& path, std::uintmax_t most_bytes = kMostFileBytes);
bool holds_text(const std::filesystem::path& path, const std::string& text);  // false: another, or no file
// Whole or not at all; makes its folder too. Throws Error where it cannot be written, and for links.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace stampede
