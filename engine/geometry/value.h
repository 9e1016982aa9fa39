// What a file says, as a plain tree in which each value knows its place: of a Lua definition, or of JSON.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/transform.h"

namespace stampede {

// A table has items (1, 2, …) and fields (text keys), both may be present: { "cube", colour = "red" }.
// Throws (all as_… and …_or): Error that names the place and what was expected there.
struct Value {
  enum class Kind { nothing, boolean, number, text, table, pose, function, other };
  Kind kind = Kind::nothing;
  bool boolean = false;
  bool integer = false;
  bool odd_keys = false;  // table: it has keys that are neither (0, 2.5, true …)
  double number = 0;
  std::string text;  // text; other: Lua's name of its type
  Transform pose = Transform::Identity();
  std::vector<Value> items;
  std::map<std::string, Value, std::less<>> fields;
  std::string place;  // `tasks/stack.lua: objects.block.colour`; empty in a value read as it is written

  bool present() const { return kind != Kind::nothing; }
  bool is_text() const { return kind == Kind::text; }
  bool is_table() const { return kind == Kind::table; }
  bool is_number() const { return kind == Kind::number; }
  double plain_number(double otherwise) const { return is_number() ? number : otherwise; }  // drawn ones are none
  bool is_function() const { return kind == Kind::function; }
  const Value& operator[](std::string_view field) const;  // absent: nothing
  std::string tag() const;                                // field `tag` when it is text
  int line() const;                                       // field `line`, 0: none
  std::string type_name() const;                          // for people: `a table`, `the text "x"` …

  double as_number() const;
  bool as_boolean() const;
  const std::string& as_text() const;
  Vector3 as_vector() const;  // { x, y, z }
  std::vector<double> as_numbers() const;
  std::vector<std::string> as_texts() const;  // a list, or one text

  double number_or(std::string_view field, double otherwise) const;
  bool boolean_or(std::string_view field, bool otherwise) const;
  std::string text_or(std::string_view field, std::string_view otherwise) const;
  Vector3 vector_or(std::string_view field, const Vector3& otherwise) const;

  [[noreturn]] void expected(std::string_view what) const;
};

// Numbers and texts as people write them: 2, 0.25, red. Tables: {1,2}.
std::string plain_text(const Value& value);

}  // namespace stampede
