// PDDL text as nested lists with places.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace stampede::symbolic {

struct Node {
  bool is_list = false;
  std::string word;  // lower case
  std::vector<Node> items;
  std::vector<std::string> notes;  // a list's own `;@` comments, each with the number of items before it in `note_at`
  std::vector<std::size_t> note_at;
  std::string place;                // file:line:column
  const std::string& head() const;  // first word of a list, or empty
};

// The one list that the text holds. Throws Error at the place of a missing or surplus parenthesis.
Node parse_list(std::string_view text, const std::string& file);

}  // namespace stampede::symbolic
