#include "scripting/runtime/value.h"

#include <cstdio>

namespace stampede {
namespace {

std::string describe_kind(const Value& value) {
  switch (value.kind) {
    case Value::Kind::nothing:
      return "nothing";
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::number:
      return value.canonical();
    case Value::Kind::text:
      return "'" + value.text + "'";
    case Value::Kind::table:
      return "a table";
    case Value::Kind::pose:
      return "a pose";
  }
  return "something else";
}

}  // namespace

const Value& Value::operator[](std::string_view field) const {
  static const Value kNothing;
  const auto found = fields.find(field);
  return found == fields.end() ? kNothing : found->second;
}

std::string Value::tag() const {
  const Value& value = (*this)["tag"];
  return value.kind == Kind::text ? value.text : std::string();
}

void Value::expected(std::string_view what) const {
  throw Error(place, "expected " + std::string(what) + ", found " + describe_kind(*this));
}

double Value::as_number() const {
  if (kind != Kind::number) expected("a number");
  return number;
}

bool Value::as_boolean() const {
  if (kind != Kind::boolean) expected("true or false");
  return boolean;
}

const std::string& Value::as_text() const {
  if (kind != Kind::text) expected("a text");
  return text;
}

Vector3 Value::as_vector() const {
  if (kind != Kind::table || items.size() != 3) expected("three numbers { x, y, z }");
  return Vector3(items[0].as_number(), items[1].as_number(), items[2].as_number());
}

std::vector<double> Value::as_numbers() const {
  if (kind != Kind::table) expected("a list of numbers");
  std::vector<double> numbers;
  for (const Value& item : items) numbers.push_back(item.as_number());
  return numbers;
}

std::vector<std::string> Value::as_texts() const {
  if (kind == Kind::text) return {text};
  if (kind != Kind::table) expected("a list of texts");
  std::vector<std::string> texts;
  for (const Value& item : items) texts.push_back(item.as_text());
  return texts;
}

std::string Value::canonical() const {
  if (kind == Kind::text) return text;
  if (kind == Kind::boolean) return boolean ? "true" : "false";
  if (kind != Kind::number) expected("a plain value");
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, integer ? "%.0f" : "%.14g", number);
  return buffer;
}

double Value::number_or(std::string_view field, double otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_number() : otherwise;
}

bool Value::boolean_or(std::string_view field, bool otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_boolean() : otherwise;
}

std::string Value::text_or(std::string_view field, std::string_view otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_text() : std::string(otherwise);
}

Vector3 Value::vector_or(std::string_view field, const Vector3& otherwise) const {
  const Value& value = (*this)[field];
  return value.present() ? value.as_vector() : otherwise;
}

Transform transform_from(const Value& table) {
  const Value& at = table["at"];
  if (at.kind == Value::Kind::pose) return at.pose;
  const Vector3 origin = at.present() ? at.as_vector() : Vector3::Zero();
  Vector3 rpy = table.vector_or("rpy", Vector3::Zero());
  rpy.z() += table.number_or("yaw", 0);
  Transform pose = translation(origin) * rotation_rpy(rpy.x(), rpy.y(), rpy.z());
  if (const Value& quaternion = table["quaternion"]; quaternion.present()) {
    const std::vector<double> xyzw = quaternion.as_numbers();
    if (xyzw.size() != 4) quaternion.expected("four numbers { x, y, z, w }");
    pose = make_transform(origin, Quaternion(xyzw[3], xyzw[0], xyzw[1], xyzw[2]).normalized());
  }
  return pose;
}

}  // namespace stampede
