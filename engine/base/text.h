// Small things that every reader of options does.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace stampede {

// One part more than there are separators: empty ones are kept, so that who reads them can complain.
std::vector<std::string> split(std::string_view text, char at);

// The inverse of `split`, where no word holds the separator.
std::string joined(const std::vector<std::string>& words, std::string_view between = ", ");

std::string trimmed(std::string_view text);  // without blanks and tabs at its ends

std::string number_text(double value);  // the shortest that reads back as the same number

}  // namespace stampede
