// Catalogues of every release whose schema says anything.
#pragma once

#include <filesystem>
#include <string_view>

namespace stampede::fuzz {

// Makes such a catalogue in `folder`, which it has for itself, opens it, asks some of all questions, and every
// sixteenth time migrates and merges it. Throws std::logic_error where something else in the folder changes, or a file
// appears that nobody asked for.
void use_altered_schema(const std::filesystem::path& folder, std::string_view changes);

}  // namespace stampede::fuzz
