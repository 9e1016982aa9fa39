#include "engine/geometry/value.h"

#include <cstdio>

#include "engine/base/error.h"

namespace stampede {
namespace {

std::string shown_text(const std::string& text) {
  const bool long_one = text.size() > 40;
  std::string said = "the text \"";  // piece by piece: GCC 12 warns of a sum where there is nothing wrong
  said.append(text, 0, long_one ? 37 : text.size());
  if (long_one) said += "...";
  said += '"';
  return said;
}

}  // namespace

const Value& Value::operator[](std::string_view field) const {
  static const Value kNothing;
  const auto found = fields.find(field);
  return found == fields.end() ? kNothing : found->second;
}

std::string Value::tag() const {
  const Value& value = (*this)["tag"];
  return value.is_text() ? value.text : std::string();
}

int Value::line() const { return static_cast<int>((*this)["line"].number); }

std::string Value::type_name() const {
  switch (kind) {
    case Kind::nothing:
      return "nothing";
    case Kind::boolean:
      return boolean ? "true" : "false";
    case Kind::number:
      return "the number " + plain_text(*this);
    case Kind::text:
      return shown_text(text);
    case Kind::table:
      return tag().empty() ? "a table" : "a " + tag();
    case Kind::pose:
      return "a pose";
    case Kind::function:
      return "a function";
    case Kind::other:
      return "a " + text;
  }
  return {};
}

void Value::expected(std::string_view what) const {
  throw Error(place, "expected " + std::string(what) + ", found " + type_name());
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

std::string plain_text(const Value& value) {
  switch (value.kind) {
    case Value::Kind::boolean:
      return value.boolean ? "true" : "false";
    case Value::Kind::text:
      return value.text;
    case Value::Kind::number: {
      char text[40];
      if (value.integer) {
        std::snprintf(text, sizeof text, "%.0f", value.number);
        return text;
      }
      for (int digits = 6; digits <= 17; ++digits) {  // the shortest that reads back as the same number
        std::snprintf(text, sizeof text, "%.*g", digits, value.number);
        double back = 0;
        std::sscanf(text, "%lf", &back);
        if (back == value.number) break;
      }
      return text;
    }
    case Value::Kind::table: {
      std::string text = "{";
      for (const Value& item : value.items) text += (text.size() > 1 ? "," : "") + plain_text(item);
      for (const auto& [key, field] : value.fields)
        text += (text.size() > 1 ? "," : "") + key + "=" + plain_text(field);
      return text + "}";
    }
    default:
      return {};
  }
}

}  // namespace stampede
