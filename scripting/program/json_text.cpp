#include "scripting/program/json_text.h"

#include <charconv>
#include <cmath>

#include "db/table_text.h"

namespace stampede::program {

void JsonText::new_line() { text_ += "\n" + std::string(2 * open_.size(), ' '); }

void JsonText::before_value() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (open_.empty()) return;
  if (has_items_.back()) text_ += ',';
  has_items_.back() = true;
  new_line();
}

JsonText& JsonText::open(char bracket) {
  before_value();
  text_ += bracket;
  open_.push_back(bracket == '{' ? '}' : ']');
  has_items_.push_back(false);
  return *this;
}

JsonText& JsonText::end() {
  const char bracket = open_.back();
  const bool items = has_items_.back();
  open_.pop_back();
  has_items_.pop_back();
  if (items) new_line();
  text_ += bracket;
  return *this;
}

JsonText& JsonText::key(std::string_view name) {
  before_value();
  text_ += json_text(name) + ": ";
  after_key_ = true;
  return *this;
}

JsonText& JsonText::value(std::string_view text) {
  before_value();
  text_ += json_text(text);
  return *this;
}

JsonText& JsonText::value(double number) {
  if (!std::isfinite(number)) return null();
  before_value();
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof buffer, number);
  text_.append(buffer, result.ptr);
  return *this;
}

JsonText& JsonText::value(std::int64_t number) {
  before_value();
  text_ += std::to_string(number);
  return *this;
}

JsonText& JsonText::value(bool truth) {
  before_value();
  text_ += truth ? "true" : "false";
  return *this;
}

JsonText& JsonText::null() {
  before_value();
  text_ += "null";
  return *this;
}

}  // namespace stampede::program
