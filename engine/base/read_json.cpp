#include "engine/base/read_json.h"

#include <algorithm>
#include <cctype>
#include <iterator>

#include "engine/base/error.h"
#include "engine/base/nearest.h"
#include "engine/base/read_file.h"
#include "engine/base/utf8.h"

namespace stampede {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kShown = 40;  // bytes of a text in a message

std::string shown(std::string_view text) {
  std::size_t end = 0;
  while (end < text.size() && end < kShown && static_cast<unsigned char>(text[end]) >= 0x20)
    end += std::max<std::size_t>(1, utf8_length(text, end));
  return std::string(text.substr(0, end)) + (end < text.size() && end >= kShown ? "…" : "");
}

// Where the parser is, which it does not tell: it takes byte after byte, and calls the builder when it has a token.
class Bytes {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;
  Bytes(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  Bytes& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  Bytes operator++(int) {
    const Bytes before = *this;
    ++*this;
    return before;
  }
  bool operator==(const Bytes& other) const { return at_ == other.at_; }
  bool operator!=(const Bytes& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

// Puts values together as the parser names them; throws where it must not go on.
class Builder final : public nlohmann::json_sax<Json> {
 public:
  Builder(std::string_view text, const std::string& where, const std::string& cure, const JsonLimits& limits)
      : text_(text), where_(where), cure_(cure), limits_(limits), seen_(text.data()) {}

  Bytes begin() { return {text_.data(), &seen_}; }
  Bytes end() { return {text_.data() + text_.size(), &seen_}; }
  Json take() { return std::move(root_); }

  bool null() override { return put(nullptr); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override {
    if (value > static_cast<number_unsigned_t>(std::numeric_limits<number_integer_t>::max())) too_large();
    return put(static_cast<number_integer_t>(value));
  }
  bool number_float(number_float_t value, const string_t& digits) override {
    if (digits.find_first_of(".eE") == std::string::npos) too_large();
    return put(value);
  }
  bool string(string_t& value) override {
    check_text(value);
    return put(std::move(value));
  }
  bool binary(binary_t&) override { return false; }  // JSON text has none
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    check_text(name);
    if (open_.back()->contains(name)) fail(at(), "'" + shown(name) + "' is there twice in one object", "keep one");
    key_ = std::move(name);
    return true;
  }
  bool parse_error(std::size_t position, const std::string& token, const Json::exception& error) override {
    if (error.id == kOutOfRange) not_finite(at());
    const std::size_t here = std::min(position > 0 ? position - 1 : 0, text_.size());
    if (const std::size_t bad = not_text_at(text_); bad <= here) require_text(text_, where_);
    const std::size_t last = text_.find_last_not_of(" \t\r\n");
    if (last == std::string_view::npos || here > last)
      fail(last == std::string_view::npos ? 0 : last, text_.empty() ? "this file is empty" : "this JSON ends too early",
           cut_cure());
    std::size_t begin = here;  // of the word or text that it cannot use
    if (text_[here] == '"' && text_.substr(0, here + 1).ends_with(token))
      begin = here + 1 - std::max<std::size_t>(1, token.size());
    const auto in_word = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-'; };
    while (begin > 0 && in_word(text_[begin]) && in_word(text_[begin - 1])) --begin;
    for (const char* word : {"NaN", "Infinity", "-Infinity", "nan", "inf", "-inf"})
      if (text_.substr(begin).starts_with(word)) not_finite(begin);
    fail(begin, "this is no JSON from here on: " + shown(text_.substr(begin)), cure_);
  }

 private:
  static constexpr int kOutOfRange = 406;  // of the library's exceptions: a number that no double can hold

  std::size_t at() const { return static_cast<std::size_t>(std::max(seen_ - text_.data(), std::ptrdiff_t{1})) - 1; }
  std::string cut_cure() const { return "it was cut, or a bracket is missing" + (cure_.empty() ? "" : "; " + cure_); }

  [[noreturn]] void fail(std::size_t at, const std::string& what, const std::string& cure) const {
    throw Error(where_.empty() ? "" : line_place(text_, at, where_), what, cure);
  }
  [[noreturn]] void not_finite(std::size_t at) const {
    fail(at, "a number is not finite", "leave out what is not known, or write a number");
  }
  [[noreturn]] void too_large() const {
    fail(at(), "a whole number is too large", "whole numbers have 18 digits; write others as 1.5e20");
  }
  void check_text(const std::string& text) const {
    if (text.find('\0') != std::string::npos) fail(at(), "a text holds the character 0", "remove \\u0000");
  }

  Json* add(Json value) {
    if (++values_ > limits_.values)
      fail(at(), "it holds more than " + std::to_string(limits_.values) + " values, the most that are read",
           "split it");
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& in = *open_.back();
    if (in.is_object()) return &(in[key_] = std::move(value));
    in.push_back(std::move(value));
    return &in.back();
  }
  bool put(Json value) {
    add(std::move(value));
    return true;
  }
  // What is open is the last of what is open around it, so that adding to it moves none of these.
  bool open(Json value) {
    if (static_cast<int>(open_.size()) >= limits_.depth)
      fail(at(),
           "brackets are " + std::to_string(limits_.depth + 1) + " deep, and at most " + std::to_string(limits_.depth) +
               " are read",
           cure_);
    open_.push_back(add(std::move(value)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::string_view text_;
  const std::string& where_;
  const std::string& cure_;
  const JsonLimits& limits_;
  const char* seen_;
  Json root_;
  std::vector<Json*> open_;
  std::string key_;
  std::size_t values_ = 0;
};

}  // namespace

Json json_from_text(std::string_view text, const std::string& where, const std::string& cure,
                    const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    throw Error(
        where,
        "it has " + std::to_string(text.size()) + " bytes, and at most " + std::to_string(limits.bytes) + " are read",
        "make it smaller, or split it");
  Builder builder(text, where, cure, limits);
  Json::sax_parse(builder.begin(), builder.end(), &builder);
  return builder.take();
}

Json json_from_file(const std::filesystem::path& file, const std::string& cure, const JsonLimits& limits) {
  return json_from_text(read_file(file, limits.bytes), file.string(), cure, limits);
}

std::optional<Json> json_if_any(std::string_view text, const JsonLimits& limits) {
  try {
    return json_from_text(text, "", "", limits);
  } catch (const Error&) {
    return std::nullopt;
  }
}

std::vector<std::string> texts_from_json(std::string_view text, const std::string& where) {
  const Json list = json_from_text(text, where, "make the file anew: it is damaged");
  std::vector<std::string> texts;
  bool good = list.is_array();
  for (std::size_t i = 0; good && i < list.size(); ++i) {
    good = list[i].is_string();
    if (good) texts.push_back(list[i].get<std::string>());
  }
  if (!good) throw Error(where, "a list of texts is expected", "make the file anew: it is damaged");
  return texts;
}

void require_known_fields(const Json& object, const std::vector<std::string>& known, const std::string& where) {
  for (const auto& [name, value] : object.items())
    if (std::find(known.begin(), known.end(), name) == known.end())
      throw Error(where, "there is no field '" + shown(name) + "'", did_you_mean(name, known));
}

}  // namespace stampede
