// Values of definition files as plain C++: everything drawn, every function of the variation called.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/geometry/transform.h"

namespace stampede {

// A table has items (1, 2, …) and fields (string keys), both may be present: { "cube", colour = "red" }.
// Throws (all readers): Error that names the place and what was expected there.
struct Value {
  enum class Kind { nothing, boolean, number, text, table, pose };
  Kind kind = Kind::nothing;
  bool boolean = false;
  double number = 0;
  bool integer = false;
  std::string text;
  Transform pose = Transform::Identity();
  std::vector<Value> items;
  std::map<std::string, Value, std::less<>> fields;
  std::string place;  // `tasks/stack.lua: objects.block.colour`

  bool present() const { return kind != Kind::nothing; }
  const Value& operator[](std::string_view field) const;  // absent: a value of kind nothing
  std::string tag() const;                                // field `tag`, or empty

  double as_number() const;
  bool as_boolean() const;
  const std::string& as_text() const;
  Vector3 as_vector() const;  // { x, y, z }
  std::vector<double> as_numbers() const;
  std::vector<std::string> as_texts() const;  // a list, or one text
  std::string canonical() const;              // plain values: how a variation's text writes them

  double number_or(std::string_view field, double otherwise) const;
  bool boolean_or(std::string_view field, bool otherwise) const;
  std::string text_or(std::string_view field, std::string_view otherwise) const;
  Vector3 vector_or(std::string_view field, const Vector3& otherwise) const;

  [[noreturn]] void expected(std::string_view what) const;
};

// A pose written as fields: at = { x, y, z } and one of yaw = rad, rpy = { r, p, y }, quaternion = { x, y, z, w }.
Transform transform_from(const Value& table);

}  // namespace stampede
