#include "engine/symbolic/pddl_tokens.h"

#include <cctype>

namespace stampede::symbolic {
namespace {

class Scanner {
 public:
  Scanner(std::string_view text, const std::string& file)
      : text_(text), file_(std::make_shared<const std::string>(file)) {}

  Node run() {
    Node top;
    skip(top);
    if (at_ >= text_.size()) throw Error(place(), "the text is empty", "begin with (define");
    if (text_[at_] != '(') throw Error(place(), "expected `(`", "begin with (define");
    Node result = list();
    skip(top);
    if (at_ < text_.size()) {
      throw Error(place(), "text after the last closing parenthesis", "remove it, or a `)` too many before it");
    }
    return result;
  }

 private:
  Place place() const { return {file_, line_, column_}; }

  void step() {
    if (text_[at_++] == '\n') {
      ++line_;
      column_ = 1;
    } else {
      ++column_;
    }
  }

  // Blanks and comments; the `;@` ones are kept with the list around them.
  void skip(Node& around) {
    while (at_ < text_.size()) {
      if (text_[at_] == ';') {
        const std::size_t begin = at_;
        while (at_ < text_.size() && text_[at_] != '\n') step();
        const std::string_view comment = text_.substr(begin, at_ - begin);
        if (comment.starts_with(";@ ")) {
          around.notes.push_back({around.items.size(), std::string(comment.substr(3))});
        }
      } else if (std::isspace(static_cast<unsigned char>(text_[at_])) != 0) {
        step();
      } else {
        return;
      }
    }
  }

  Node list() {
    Node result;
    result.is_list = true;
    result.place = place();
    if (++depth_ > kDeepestNesting) {
      throw Error(result.place, "lists are nested deeper than " + std::to_string(kDeepestNesting),
                  "name the inner parts with derived predicates");
    }
    step();
    while (true) {
      skip(result);
      if (at_ >= text_.size()) throw Error(result.place, "this `(` is never closed", "add the missing `)`");
      if (text_[at_] == ')') {
        step();
        --depth_;
        return result;
      }
      result.items.push_back(text_[at_] == '(' ? list() : word());
    }
  }

  Node word() {
    Node result;
    result.place = place();
    while (at_ < text_.size() && text_[at_] != '(' && text_[at_] != ')' && text_[at_] != ';' &&
           std::isspace(static_cast<unsigned char>(text_[at_])) == 0) {
      if (text_[at_] == '?' && !result.word.empty()) break;  // `(at?x)` is `(at ?x)`
      result.word += static_cast<char>(std::tolower(static_cast<unsigned char>(text_[at_])));
      step();
    }
    return result;
  }

  std::string_view text_;
  std::shared_ptr<const std::string> file_;
  std::size_t at_ = 0;
  int line_ = 1, column_ = 1, depth_ = 0;
};

}  // namespace

const std::string& Node::head() const {
  static const std::string kNone;
  return is_list && !items.empty() && !items.front().is_list ? items.front().word : kNone;
}

Node parse_list(std::string_view text, const std::string& file) { return Scanner(text, file).run(); }

}  // namespace stampede::symbolic
