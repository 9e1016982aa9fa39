#include "scripting/library/source_lines.h"

#include <algorithm>
#include <cctype>
#include <utility>
#include <vector>

namespace stampede {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view source) : source_(source) {}

  void scan() {
    while (at_ < source_.size()) step();
  }

  std::map<std::string, int> lines_;
  Mentions mentions_;

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
    if (!comment_) note_text(source_.substr(at_ + close.size(), end - at_ - close.size()));
    while (at_ < stop) advance();
    return true;
  }

  void text(char quote) {
    advance();
    const std::size_t start = at_;
    while (at_ < source_.size() && peek() != quote && peek() != '\n') {
      if (peek() == '\\') advance();
      advance();
    }
    const std::string_view found = source_.substr(start, at_ - start);
    note_text(found);
    advance();
    const std::size_t next = source_.find_first_not_of(" \n", at_);
    const bool whole = next != std::string_view::npos && (source_[next] == ')' || source_[next] == ',');
    if (std::exchange(number_, 0) > 0 && whole) mentions_.numbers.emplace(found, line_);
  }

  void note_text(std::string_view text) {
    mentions_.texts.emplace(text);
    if (policy_) mentions_.policies.emplace(text);
    policy_ = false;
  }

  void word() {
    const std::size_t start = at_;
    while (std::isalnum(static_cast<unsigned char>(peek())) != 0 || peek() == '_') ++at_;
    last_word_ = source_.substr(start, at_ - start);
    word_line_ = line_;
    if (before_dot_ == "is" || before_dot_ == "is_not") mentions_.after_is.emplace(last_word_);
    if (before_dot_ == "act") mentions_.after_act.emplace(last_word_);
    before_dot_ = {};
    policy_ = last_word_ == "policy";
    const char before = start > 0 ? source_[start - 1] : ' ';
    of_number_ = last_word_ == "number" && before == ':';
    number_ = 0;
    if (before == ':' && !owner_.empty()) mentions_.methods.emplace(std::pair(owner_, last_word_), line_);
    if (before == '.' && !owner_.empty()) mentions_.members.emplace(std::pair(owner_, last_word_), line_);
    alone_ = before != '.' && before != ':';
    owner_ = {};
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

  // The second argument of w:number( … ) that begins here is a text perhaps.
  void brackets(char c) {
    if (c == '(' && of_number_) call_ = round_ + 1;
    of_number_ = false;
    round_ += c == '(' ? 1 : c == ')' ? -1 : 0;
    number_ = c == ',' && round_ == call_ ? round_ : 0;
    if (number_ > 0 || round_ < call_) call_ = -1;
  }

  void comment() {
    at_ += 2;
    comment_ = true;
    if (!(peek() == '[' && long_bracket())) {
      while (at_ < source_.size() && peek() != '\n') ++at_;
    }
    comment_ = false;
  }

  void open_table() {
    keys_.push_back(pending_);
    pending_.clear();
    ++depth_;
    advance();
  }

  void close_table() {
    if (!keys_.empty()) keys_.pop_back();
    if (depth_ > 0) --depth_;
    if (!keys_.empty()) pending_.clear();
    advance();
  }

  // The last word is a field of the table around.
  void key() {
    pending_ = std::string(last_word_);
    const std::string around = path();
    lines_.emplace((around.empty() ? "" : around + ".") + pending_, word_line_);
    advance();
  }

  void sign(char c) {
    before_dot_ = c == '.' ? last_word_ : std::string_view{};
    owner_ = alone_ && (c == '.' || c == ':') ? last_word_ : std::string_view{};
    policy_ = policy_ && c == '(';
    brackets(c);
    advance();
  }

  bool begins_word(char c) const { return std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_'; }
  bool gives_value(char c) const { return c == '=' && peek(1) != '=' && !last_word_.empty() && depth_ > 0; }

  void step() {
    const char c = peek();
    if (begins_word(c)) return word();
    if (std::isspace(static_cast<unsigned char>(c)) != 0) return advance();  // `name =` has space between
    if (c == '-' && peek(1) == '-') {
      comment();
    } else if (c == '"' || c == '\'') {
      text(c);
    } else if (c == '[' && (peek(1) == '[' || peek(1) == '=')) {
      if (!long_bracket()) advance();
    } else if (c == '{') {
      open_table();
    } else if (c == '}') {
      close_table();
    } else if (gives_value(c)) {
      key();
    } else {
      sign(c);
    }
    last_word_ = {};
  }

  std::string_view source_;
  std::size_t at_ = 0;
  int line_ = 1, word_line_ = 1, depth_ = 0;
  bool comment_ = false, policy_ = false;   // policy_: a text that follows is a policy's name
  bool of_number_ = false;                  // the word before is the method `number`
  int round_ = 0, call_ = -1, number_ = 0;  // depth in ( ); of the call of `number`; where its second argument begins
  std::string_view last_word_, before_dot_;
  bool alone_ = true;              // the last word: nothing and a dot or colon before it
  std::string_view owner_;         // such a word before the dot or colon here
  std::string pending_;            // the key whose value begins
  std::vector<std::string> keys_;  // of the tables around
};

}  // namespace

std::map<std::string, int> field_lines(std::string_view source) {
  Scanner scanner(source);
  scanner.scan();
  return std::move(scanner.lines_);
}

Mentions mentions_in(std::string_view source) {
  Scanner scanner(source);
  scanner.scan();
  for (const auto& [path, line] : scanner.lines_) scanner.mentions_.fields.insert(path);
  return std::move(scanner.mentions_);
}

int line_of_atom(std::string_view source, std::string_view predicate, const std::vector<std::string>& arguments) {
  const std::string name(predicate);
  const auto speaks = [&](std::string_view text) {
    for (const std::string& form : {"is." + name + "(", "is_not." + name + "(", "(" + name + " "})
      if (text.find(form) != std::string_view::npos) return true;
    return false;
  };
  int line = 0, found = 0;
  std::ptrdiff_t most = -1;
  while (!source.empty()) {
    const std::size_t end = std::min(source.find('\n'), source.size());
    const std::string_view text = source.substr(0, end);
    source.remove_prefix(std::min(end + 1, source.size()));
    ++line;
    if (!speaks(text)) continue;
    const auto named = std::count_if(arguments.begin(), arguments.end(), [&](const std::string& argument) {
      const std::string group = argument.substr(0, argument.find_last_not_of("0123456789") + 1) + "*";
      return text.find("\"" + argument + "\"") != std::string_view::npos || text.find(group) != std::string_view::npos;
    });
    if (named <= most) continue;
    most = named;
    found = line;
  }
  return found;
}

int line_of(const std::map<std::string, int>& lines, std::string path) {
  for (;;) {
    if (const auto found = lines.find(path); found != lines.end()) return found->second;
    if (path.empty()) return 1;
    const std::size_t dot = path.rfind('.');
    path = dot == std::string::npos ? std::string() : path.substr(0, dot);
  }
}

}  // namespace stampede
