// Whole files as text.
#pragma once

#include <filesystem>
#include <string>

namespace stampede {

std::string read_text_file(const std::filesystem::path& path);                // throws Error where it cannot be read
bool holds_text(const std::filesystem::path& path, const std::string& text);  // false: another, or no file
// Whole or not at all; makes its folder too. Throws Error where it cannot be written, and for links.
void write_text_file(const std::filesystem::path& path, const std::string& text);

}  // namespace stampede
