#include <algorithm>
#include <set>
#include <sstream>

#include "engine/symbolic/pddl.h"
#include "engine/symbolic/pddl_formula.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {
namespace {

using namespace symbolic;

class ProblemReader {
 public:
  ProblemReader(Node& top, const Domain& domain)
      : top_(top), domain_(domain), vocabulary_{&domain, &problem_.objects} {}

  Problem run() {
    if (top_.head() != "define" || top_.items.size() < 2 || top_.items[1].head() != "problem" ||
        top_.items[1].items.size() != 2) {
      fail(top_, "expected (define (problem NAME) …)");
    }
    problem_.name = name_from_pddl(top_.items[1].items[1].word);
    problem_.objects = domain_.constants;
    for (std::size_t i = 2; i < top_.items.size(); ++i) check_section(top_.items[i]);
    for (const char* section : {":objects", ":init", ":goal", ":metric"}) {
      for (std::size_t i = 2; i < top_.items.size(); ++i) {
        if (top_.items[i].head() == section) read_section(top_.items[i]);
      }
    }
    if (!has_goal_) fail(top_, "the problem has no goal", "add (:goal formula); (:goal (and)) asks for nothing");
    return std::move(problem_);
  }

 private:
  void check_section(const Node& node) const {
    const std::vector<std::string> known = {":domain", ":goal", ":init", ":metric", ":objects", ":requirements"};
    if (std::find(known.begin(), known.end(), node.head()) == known.end()) {
      fail(node, "unknown section `" + node.head() + "`", did_you_mean(node.head(), known));
    }
    if (node.head() == ":domain" && (node.items.size() != 2 || name_from_pddl(node.items[1].word) != domain_.name)) {
      fail(node, "the problem is for another domain", "the domain at hand is `" + domain_.name + "`");
    }
  }

  void read_section(Node& node) {
    if (node.head() == ":objects") return read_objects(node);
    if (node.head() == ":init") return read_init(node);
    if (node.head() == ":metric") return check_metric(node);
    if (has_goal_) fail(node, "a second goal", "join the two with `and`");
    has_goal_ = true;
    if (node.items.size() != 2 || (node.items[1].is_list && node.items[1].items.empty())) {
      fail(node, node.items.size() > 2 ? "a goal is one formula" : "the goal is empty",
           node.items.size() > 2 ? "join the parts with `and`" : "write (:goal (and)) where nothing is asked for");
    }
    problem_.goal = read_formula(node.items[1], {}, vocabulary_);
  }

  void read_objects(const Node& node) {
    std::map<std::string, std::string> known;
    for (const TypedObject& one : problem_.objects) known[one.name] = one.type;
    std::set<std::string> declared;
    for (const Parameter& one : read_typed(node, 1, false, &domain_)) {
      const std::string type = one.type.empty() ? "object" : one.type;
      const auto [other, is_new] = known.try_emplace(one.name, type);
      const bool is_constant_again =
          !is_new && other->second == type && !declared.contains(one.name) &&
          std::binary_search(domain_.constants.begin(), domain_.constants.end(), TypedObject{one.name, type});
      declared.insert(one.name);
      if (is_constant_again) continue;
      if (!is_new) {
        fail(node, "object `" + one.name + "` is declared twice",
             "remove one of the two; PDDL does not tell capital letters from small ones");
      }
      problem_.objects.push_back({one.name, type});
    }
    std::sort(problem_.objects.begin(), problem_.objects.end());
  }

  // Frees what it has read: the text of a large problem and its facts need not be in memory together.
  void read_init(Node& node) {
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      Node item = std::move(node.items[i]);
      if (item.head() == "=") {
        read_value(item);
        continue;
      }
      const bool is_denied = item.head() == "not";  // closed world: what is not said is false
      if (is_denied && item.items.size() != 2) fail(item, "`not` takes 1 part");
      const Node& said = is_denied ? item.items[1] : item;
      if (!said.is_list || said.head().empty()) fail(said, "init holds facts only", "write (NAME object …)");
      for (const char* word : {"and", "or", "imply", "exists", "forall", "when", "not"}) {
        if (said.head() == word) fail(said, "init holds facts only", "write (NAME object …)");
      }
      Formula read = read_atom(said, {}, vocabulary_);
      const Predicate* predicate = domain_.predicate(read.predicate);
      if (predicate != nullptr && predicate->kind == PredicateKind::derived) {
        fail(said, "`" + read.predicate + "` is derived and cannot be in init",
             "leave it out: it follows from the rest");
      }
      if (is_denied) continue;
      Fact fact{std::move(read.predicate), {}};
      fact.arguments.reserve(read.terms.size());
      for (Term& term : read.terms) fact.arguments.push_back(std::move(term.name));
      problem_.init.insert(std::move(fact));
    }
  }

  void read_value(const Node& node) {
    if (node.items.size() != 3 || node.items[1].head().empty() || node.items[2].is_list) {
      fail(node, "expected (= (FUNCTION object …) N)");
    }
    const Node &left = node.items[1], &right = node.items[2];
    const std::string name = name_from_pddl(left.head());
    const bool is_whole = !right.word.empty() && right.word.size() <= 9 &&
                          right.word.find_first_not_of("0123456789") == std::string::npos;
    if (left.head() == "total-cost" && left.items.size() == 1) {
      if (!is_whole || std::stoi(right.word) != 0) fail(right, "the total cost begins at 0");
      return;
    }
    const Predicate* function = nullptr;
    std::vector<std::string> known;
    for (const Predicate& one : domain_.functions) {
      known.push_back(one.name);
      if (one.name == name) function = &one;
    }
    if (function == nullptr) fail(left, "unknown function `" + left.head() + "`", did_you_mean(name, known));
    if (!is_whole) {
      fail(right, "a cost is a whole number, got `" + right.word + "`",
           "scale the costs: neither Fast Downward nor this planner takes fractions or negative ones");
    }
    if (left.items.size() != function->parameters.size() + 1) {
      fail(left, "`" + name + "` takes " + std::to_string(function->parameters.size()) + " arguments, got " +
                     std::to_string(left.items.size() - 1));
    }
    Fact of{name, {}};
    for (std::size_t i = 1; i < left.items.size(); ++i) {
      const Term term = read_term(left.items[i], {}, vocabulary_);
      check_type(left.items[i], term, {function->parameters[i - 1], name}, {}, vocabulary_);
      of.arguments.push_back(term.name);
    }
    const int value = std::stoi(right.word);
    const auto [other, is_new] = problem_.values.try_emplace(std::move(of), value);
    if (!is_new && other->second != value) fail(node, "a second value of " + to_text(other->first));
  }

  void check_metric(const Node& node) const {
    const bool is_cost = node.items.size() == 3 && node.items[1].word == "minimize" &&
                         (node.items[2].head() == "total-cost" || node.items[2].word == "total-cost");
    if (!is_cost) {
      fail(node, "only (:metric minimize (total-cost)) is supported", "leave the section out to have short plans");
    }
  }

  Node& top_;
  const Domain& domain_;
  Problem problem_;
  Vocabulary vocabulary_;
  bool has_goal_ = false;
};

}  // namespace

Problem problem_from_pddl(std::string_view text, const std::string& file, const Domain& domain) {
  Node top = parse_list(text, file);
  return ProblemReader(top, domain).run();
}

Formula formula_from_pddl(std::string_view text, const std::string& place) {
  return read_formula(parse_list(text, place), {}, {});
}

Plan plan_from_text(std::string_view text, const std::string& file) {
  Plan plan;
  std::istringstream lines{std::string(text)};
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    line = line.substr(0, line.find(';'));
    const std::size_t begin = line.find('('), end = line.rfind(')');
    if (begin == std::string::npos && line.find_first_not_of(" \t\r") == std::string::npos) continue;
    const std::string place = file + ":" + std::to_string(number);
    if (begin == std::string::npos || end == std::string::npos || end < begin) {
      throw Error(place + ":1", "expected one (action argument …)", "one step a line, in parentheses");
    }
    const std::size_t before = line.find_first_not_of(" \t0123456789.:");
    if (before != begin) {
      throw Error(place + ":" + std::to_string(before + 1), "only a time may stand before a step",
                  "such as `0.0: (pick cup table)`");
    }
    const Node node = parse_list(line.substr(begin, end - begin + 1), place);
    PlanStep step;
    for (const Node& item : node.items) {
      if (item.is_list) throw Error(item.place, "a step holds names only");
      (step.action.empty() ? step.action : step.arguments.emplace_back()) = name_from_pddl(item.word);
    }
    if (step.action.empty()) throw Error(place + ":1", "a step needs an action");
    plan.push_back(std::move(step));
  }
  return plan;
}

}  // namespace stampede
