// A Lua value as a plain tree, so that checks run on C++ values that no script can change or fail.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

struct lua_State;

namespace stampede {

struct Node {
  enum class Kind { nothing, boolean, number, text, table, function, other };
  Kind kind = Kind::nothing;
  bool boolean = false;
  bool integer = false;
  double number = 0;
  std::string text;                                 // text; other: Lua's name of its type
  std::vector<Node> items;                          // table: 1 … n
  std::map<std::string, Node, std::less<>> fields;  // table: text keys
  bool odd_keys = false;                            // table: keys that are neither (0, 2.5, true …)

  bool present() const { return kind != Kind::nothing; }
  bool is_text() const { return kind == Kind::text; }
  bool is_table() const { return kind == Kind::table; }
  bool is_number() const { return kind == Kind::number; }
  bool is_function() const { return kind == Kind::function; }
  const Node& operator[](std::string_view field) const;  // absent: nothing
  std::string tag() const;                               // field `tag` when it is text
  int line() const;                                      // field `line`, 0: none
  std::string type_name() const;                         // for people: `a table`, `the text "x"` …
};

// The value at `index`; the stack is left as it was. Throws Error for trees deeper than 24 or larger than 200,000
// values.
Node read_node(lua_State* state, int index, const std::string& place);

// Numbers and texts as people write them: 2, 0.25, red. Tables: {1,2}.
std::string plain_text(const Node& node);

}  // namespace stampede
