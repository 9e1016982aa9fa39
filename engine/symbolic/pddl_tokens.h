// PDDL text as nested lists with places.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"

namespace stampede::symbolic {

// Becomes `file:line:column` when a message needs it: large files have millions of nodes.
struct Place {
  std::shared_ptr<const std::string> file;
  int line = 1, column = 1;
  operator std::string() const { return *file + ":" + std::to_string(line) + ":" + std::to_string(column); }
};

// One of a list's own `;@` comments, with the number of items before it.
struct NodeNote {
  std::size_t at = 0;
  std::string text;
};

struct Node {
  bool is_list = false;
  std::string word;  // lower case
  std::vector<Node> items;
  std::vector<NodeNote> notes;
  Place place;
  const std::string& head() const;  // first word of a list, or empty
};

constexpr int kDeepestNesting = 500;  // lists in lists: what walks them by recursion then needs a bounded stack

// The one list that the text holds. Throws Error at the place of a missing or surplus parenthesis, and where lists are
// nested deeper than kDeepestNesting.
Node parse_list(std::string_view text, const std::string& file);

}  // namespace stampede::symbolic
