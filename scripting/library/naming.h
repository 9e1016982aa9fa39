// Which names are allowed, and which one was probably meant.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// Edit distance that counts a swap of neighbours once (Damerau 1964, doi:10.1145/363958.363994, restricted form).
int edit_distance(std::string_view a, std::string_view b);

// The nearest of `known`, when near enough to be meant (ties: first in alphabetical order).
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known);

// `did you mean 'objects'?`, or `known: a, b, c` when nothing is near and the list is short, or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

// Lua's keywords and PDDL's reserved words.
bool is_reserved(std::string_view word);

// What is wrong with a name of ours (`[a-z][a-z0-9_]*`, not reserved), or nothing.
std::optional<std::string> name_fault(std::string_view name);

// A sound name near a faulty one, not in `taken`.
std::string proposed_name(std::string_view name, const std::vector<std::string>& taken = {});

}  // namespace stampede
