// "did you mean": the cure in most messages about names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// Edit distance that counts a swap of neighbours once (Damerau 1964, doi:10.1145/363958.363994, restricted form).
int edit_distance(std::string_view a, std::string_view b);

// The nearest of `known` in edit distance, when near enough to be meant (ties: first in alphabetical order).
std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known);

// `did you mean 'objects'?`, or `known: a, b, c` when nothing is near and the list is short, or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& known);

}  // namespace stampede
