#include <cstdlib>

#include "engine/bddl/goal.h"
#include "engine/symbolic/pddl_formula.h"

namespace stampede::symbolic {
namespace {

// Python's `eval` of the tokens that such files hold: numbers and pi, joined by * / + -, without blanks.
class Arithmetic {
 public:
  explicit Arithmetic(const Node& node) : node_(node), text_(bddl_word(node, "a number")) {}

  double value() {
    const double result = sum();
    if (at_ != text_.size()) bad();
    return result;
  }

 private:
  [[noreturn]] void bad() const { fail(node_, "`" + text_ + "` is not a number", "write one such as 0.25 or -pi/2"); }
  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  double sum() {
    double result = product();
    while (peek() == '+' || peek() == '-') result += text_[at_++] == '+' ? product() : -product();
    return result;
  }

  double product() {
    double result = factor();
    while (peek() == '*' || peek() == '/') {
      const bool times = text_[at_++] == '*';
      const double next = factor();
      if (!times && next == 0) bad();
      result = times ? result * next : result / next;
    }
    return result;
  }

  double factor() {
    double sign = 1;
    while (peek() == '-' || peek() == '+') sign *= text_[at_++] == '-' ? -1 : 1;
    for (const char* pi : {"np.pi", "math.pi", "pi"}) {
      if (text_.compare(at_, std::string_view(pi).size(), pi) != 0) continue;
      at_ += std::string_view(pi).size();
      return sign * 3.14159265358979323846;
    }
    if (std::string_view("0123456789.").find(peek()) == std::string_view::npos || peek() == '\0') bad();
    char* end = nullptr;
    const double number = std::strtod(text_.c_str() + at_, &end);
    if (end == text_.c_str() + at_) bad();
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return sign * number;
  }

  const Node& node_;
  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

const std::string& bddl_word(const Node& node, const char* what) {
  if (node.is_list || node.word.empty()) fail(node, std::string("expected ") + what + ", not a list");
  return node.word;
}

std::vector<double> read_bddl_numbers(const Node& list, std::size_t count, const char* what) {
  if (!list.is_list || list.items.size() != count) {
    fail(list, std::string(what) + " needs " + std::to_string(count) + " numbers in parentheses");
  }
  std::vector<double> values;
  for (const Node& item : list.items) values.push_back(Arithmetic(item).value());
  return values;
}

}  // namespace stampede::symbolic
