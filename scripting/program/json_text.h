// Writes JSON as text, piece by piece; nothing is kept in memory but the text.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace stampede::program {

// Numbers are written shortest, such that reading gives the same double; not-a-number and infinities as null.
class JsonText {
 public:
  JsonText& object() { return open('{'); }
  JsonText& array() { return open('['); }
  JsonText& end();
  JsonText& key(std::string_view name);
  JsonText& value(std::string_view text);
  JsonText& value(const char* text) { return value(std::string_view(text)); }
  JsonText& value(const std::string& text) { return value(std::string_view(text)); }
  JsonText& value(double number);
  JsonText& value(std::int64_t number);
  JsonText& value(int number) { return value(static_cast<std::int64_t>(number)); }
  JsonText& value(bool truth);
  JsonText& null();
  template <typename Value>
  JsonText& field(std::string_view name, const Value& content) {
    return key(name).value(content);
  }
  std::string text() const { return text_ + "\n"; }

 private:
  JsonText& open(char bracket);
  void before_value();
  void new_line();
  std::string text_;
  std::vector<char> open_;  // closing brackets awaited
  std::vector<bool> has_items_;
  bool after_key_ = false;
};

}  // namespace stampede::program
