#include "scripting/library/source_lines.h"

#include <cctype>
#include <vector>

namespace stampede {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  std::map<std::string, int> lines() {
    while (at_ < source_.size()) step();
    return std::move(lines_);
  }

 private:
  char peek(std::size_t ahead = 0) const { return at_ + ahead < source_.size() ? source_[at_ + ahead] : '\0'; }

  void advance() {
    if (peek() == '\n') ++line_;
    ++at_;
  }

  // [[ … ]] or [=[ … ]=] at the current place; false when there is none.
  bool long_bracket() {
    std::size_t level = 0;
    while (peek(1 + level) == '=') ++level;
    if (peek() != '[' || peek(1 + level) != '[') return false;
    const std::string close = "]" + std::string(level, '=') + "]";
    const std::size_t end = source_.find(close, at_);
    const std::size_t stop = end == std::string_view::npos ? source_.size() : end + close.size();
    while (at_ < stop) advance();
    return true;
  }

  void text(char quote) {
    advance();
    while (at_ < source_.size() && peek() != quote && peek() != '\n') {
      if (peek() == '\\') advance();
      advance();
    }
    advance();
  }

  void word() {
    const std::size_t start = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '_') ++at_;
    last_word_ = source_.substr(start, at_ - start);
    word_line_ = line_;
    if (last_word_ == "return" && depth_ == 0) lines_[""] = line_;
  }

  std::string path() const {
    std::string result;
    for (const std::string& key : keys_) {
      if (key.empty()) continue;
      result += (result.empty() ? "" : ".") + key;
    }
    return result;
  }

  void step() {
    const char c = peek();
    if (c == '-' && peek(1) == '-') {
      at_ += 2;
      if (!(peek() == '[' && long_bracket())) {
        while (at_ < source_.size() && peek() != '\n') ++at_;
      }
    } else if (c == '"' || c == '\'') {
      text(c);
    } else if (c == '[' && (peek(1) == '[' || peek(1) == '=')) {
      if (!long_bracket()) advance();
    } else if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') {
      word();
      return;
    } else if (c == '{') {
      keys_.push_back(pending_);
      pending_.clear();
      ++depth_;
      advance();
    } else if (c == '}') {
      if (!keys_.empty()) keys_.pop_back();
      if (depth_ > 0) --depth_;
      if (!keys_.empty()) pending_.clear();
      advance();
    } else if (c == '=' && peek(1) != '=' && !last_word_.empty() && depth_ > 0) {
      pending_ = std::string(last_word_);
      const std::string around = path();
      lines_.emplace((around.empty() ? "" : around + ".") + pending_, word_line_);
      advance();
    } else if (std::isspace(static_cast<unsigned char>(c)) != 0) {
      advance();
      return;  // `name =` has space between
    } else {
      advance();
    }
    last_word_ = {};
  }

  std::string_view source_;
  std::size_t at_ = 0;
  int line_ = 1, word_line_ = 1, depth_ = 0;
  std::string_view last_word_;
  std::string pending_;            // the key whose value begins
  std::vector<std::string> keys_;  // of the tables around
  std::map<std::string, int> lines_;
};

}  // namespace

std::map<std::string, int> field_lines(std::string_view source) { return Scanner(source).lines(); }

int line_of(const std::map<std::string, int>& lines, std::string path) {
  for (;;) {
    if (const auto found = lines.find(path); found != lines.end()) return found->second;
    if (path.empty()) return 1;
    const std::size_t dot = path.rfind('.');
    path = dot == std::string::npos ? std::string() : path.substr(0, dot);
  }
}

}  // namespace stampede
