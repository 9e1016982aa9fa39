// "did you mean": the cure in most messages about names.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// The name with the smallest edit distance (at most a third of the word), or empty.
std::string nearest(std::string_view word, const std::vector<std::string>& names);
// "did you mean 'objects'?", or the first few names there are, or empty.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& names);

}  // namespace stampede
