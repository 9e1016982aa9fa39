// A sound catalogue, a few cells of which are others.
#pragma once

#include <filesystem>
#include <string_view>

namespace stampede::fuzz {

// Writes a catalogue of an episode in which every table has rows. Each change takes some bytes: which cell, which row,
// and what becomes of it: NULL, a number, a text, gone with its row; or bytes of the file itself are overwritten.
void write_altered_catalogue(const std::filesystem::path& file, std::string_view changes);

}  // namespace stampede::fuzz
