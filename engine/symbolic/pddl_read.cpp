#include <algorithm>
#include <sstream>

#include "engine/symbolic/pddl.h"
#include "engine/symbolic/pddl_formula.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {
namespace {

using namespace symbolic;

// What a `;@` comment says; see pddl_write.cpp.
struct Note {
  std::string skill, case_name, label;
  std::vector<std::pair<std::string, std::string>> may_equal, traits;
  bool distinct = false, fixed = false, trait = false;
  std::size_t guards = 0;
};

Note read_note(const std::string& text) {
  Note note;
  std::istringstream words(text);
  bool in_traits = false;
  for (std::string word; words >> word;) {
    const std::size_t colon = word.find(':');
    if (in_traits && colon != std::string::npos) {
      note.traits.emplace_back(name_from_pddl(word.substr(0, colon)), name_from_pddl(word.substr(colon + 1)));
      continue;
    }
    in_traits = word == "traits";
    if (word == "skill") words >> note.skill;
    if (word == "case") words >> note.case_name;
    if (word == "distinct") note.distinct = true;
    if (word == "fixed") note.fixed = true;
    if (word == "trait") note.trait = true;
    if (word == "guards") words >> note.guards;
    if (word == "may_equal") {
      std::string a, b;
      words >> a >> b;
      note.may_equal.emplace_back(name_from_pddl(a), name_from_pddl(b));
    }
    if (word == "label") {
      std::getline(words >> std::ws, note.label);
      break;
    }
  }
  note.skill = name_from_pddl(note.skill);
  note.case_name = name_from_pddl(note.case_name);
  return note;
}

Note note_after(const Node& list, std::size_t items_before) {
  for (std::size_t i = 0; i < list.notes.size(); ++i) {
    if (list.note_at[i] == items_before) return read_note(list.notes[i]);
  }
  return {};
}

void add_traits(std::vector<Parameter>& parameters, const Note& note) {
  for (const auto& [name, trait] : note.traits) {
    for (Parameter& one : parameters) {
      if (one.name == name) one.traits.push_back(trait);
    }
  }
}

// Drops generated conjuncts from the front.
Formula without_guards(const Formula& formula, std::size_t guards) {
  if (guards == 0) return formula;
  if (formula.kind != Formula::Kind::conjunction) return {};
  const std::size_t dropped = std::min(guards, formula.parts.size());
  return conjunction({formula.parts.begin() + static_cast<std::ptrdiff_t>(dropped), formula.parts.end()});
}

void rename(Formula& formula, const std::map<std::string, std::string>& names) {
  std::map<std::string, std::string> inner = names;
  for (const Parameter& variable : formula.variables) inner.erase(variable.name);
  for (Term& term : formula.terms) {
    const auto found = term.variable ? inner.find(term.name) : inner.end();
    if (found != inner.end()) term.name = found->second;
  }
  for (Formula& part : formula.parts) rename(part, inner);
}

class DomainReader {
 public:
  explicit DomainReader(const Node& top) : top_(top) {}

  Domain run() {
    if (top_.head() != "define" || top_.items.size() < 2 || top_.items[1].head() != "domain" ||
        top_.items[1].items.size() != 2) {
      fail(top_, "expected (define (domain NAME) …)");
    }
    domain_.name = name_from_pddl(top_.items[1].items[1].word);
    for (const char* wanted : {":types", ":predicates", ":constants"}) each(wanted, [&](const Node& n) { declare(n); });
    each(":functions", [&](const Node& node) { functions(node); });
    vocabulary_ = {&domain_, &domain_.constants};
    each(":derived", [&](const Node& node) { derived(node); });
    each(":action", [&](const Node& node) { action(node); });
    for (std::size_t i = 2; i < top_.items.size(); ++i) check_section(top_.items[i]);
    const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
    std::sort(domain_.actions.begin(), domain_.actions.end(), by_name);
    return std::move(domain_);
  }

 private:
  template <typename Visit>
  void each(std::string_view section, Visit&& visit) {
    for (std::size_t i = 2; i < top_.items.size(); ++i) {
      if (top_.items[i].head() == section) visit(top_.items[i]);
    }
  }

  void check_section(const Node& node) {
    const std::vector<std::string> known = {":action",     ":constants",    ":derived", ":functions",
                                            ":predicates", ":requirements", ":types"};
    if (std::find(known.begin(), known.end(), node.head()) == known.end()) {
      fail(node, "unknown section `" + node.head() + "`", did_you_mean(node.head(), known));
    }
    if (node.head() != ":requirements") return;
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      for (const char* unsupported : {":durative-actions", ":fluents", ":numeric-fluents", ":preferences",
                                      ":constraints", ":timed-initial-literals", ":object-fluents"}) {
        if (node.items[i].word == unsupported) {
          fail(node.items[i], "`" + node.items[i].word + "` is not supported", "leave time and numbers to the skills");
        }
      }
    }
  }

  void declare(const Node& node) {
    if (node.head() == ":types") {
      for (const Parameter& one : read_typed(node, 1, false, nullptr)) {
        domain_.types[one.name] = one.type.empty() ? "object" : one.type;
      }
      for (std::size_t i = 1; i < node.items.size(); ++i) {
        const std::string name = name_from_pddl(node.items[i].word);
        if (name != "-" && name != "object" && !domain_.types.contains(name)) domain_.types[name] = "object";
      }
      domain_.types.erase("object");
      check_types(node);
    } else if (node.head() == ":constants") {
      for (const Parameter& one : read_typed(node, 1, false, &domain_)) {
        domain_.constants.push_back({one.name, one.type.empty() ? "object" : one.type});
      }
      std::sort(domain_.constants.begin(), domain_.constants.end());
    } else {
      for (std::size_t i = 1; i < node.items.size(); ++i) predicate(node.items[i], note_after(node, i + 1));
      const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
      std::sort(domain_.predicates.begin(), domain_.predicates.end(), by_name);
    }
  }

  void check_types(const Node& node) const {
    for (const auto& [type, parent] : domain_.types) {
      std::string at = parent;
      for (std::size_t i = 0; at != "object"; ++i) {
        if (i > domain_.types.size()) {
          fail(node, "type `" + type + "` descends from itself", "give one type of the circle another parent");
        }
        at = domain_.types.at(at);
      }
    }
  }

  void predicate(const Node& node, const Note& note) {
    if (node.head().empty()) fail(node, "expected (NAME ?x - type …)");
    Predicate result;
    result.name = name_from_pddl(node.head());
    const bool is_twice = domain_.predicate(result.name) != nullptr ||
                          std::find(domain_.traits.begin(), domain_.traits.end(), result.name) != domain_.traits.end();
    if (is_twice) fail(node, "predicate `" + result.name + "` is declared twice", "remove one of the two");
    if (note.trait) {
      domain_.traits.push_back(result.name);
      return;
    }
    result.parameters = read_typed(node, 1, true, &domain_);
    add_traits(result.parameters, note);
    result.label = note.label;
    if (note.fixed) result.kind = PredicateKind::fixed;
    domain_.predicates.push_back(std::move(result));
  }

  void functions(const Node& node) {
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      if (!node.items[i].is_list) continue;  // - number
      if (node.items[i].head() != "total-cost") {
        fail(node.items[i], "only the function (total-cost) is supported", "give each action a constant cost");
      }
      has_costs_ = true;
    }
  }

  void derived(const Node& node) {
    if (node.items.size() != 3 || node.items[1].head().empty()) fail(node, "expected (:derived (NAME ?x …) formula)");
    const std::string name = name_from_pddl(node.items[1].head());
    std::vector<Parameter> parameters = read_typed(node.items[1], 1, true, &domain_);
    Predicate* found = nullptr;
    for (Predicate& one : domain_.predicates) {
      if (one.name == name) found = &one;
    }
    if (found == nullptr) fail(node.items[1], "`" + name + "` is not among the predicates", "declare it there");
    if (found->parameters.size() != parameters.size()) fail(node.items[1], "`" + name + "` has another arity");
    Formula formula = read_formula(node.items[2], parameters, vocabulary_);
    std::map<std::string, std::string> names;
    for (std::size_t i = 0; i < parameters.size(); ++i) names[parameters[i].name] = found->parameters[i].name;
    rename(formula, names);
    std::size_t guards = 0;
    for (const Parameter& one : found->parameters) guards += one.traits.size();
    formula = without_guards(formula, guards);
    const bool is_first = found->kind != PredicateKind::derived;
    found->kind = PredicateKind::derived;
    found->derived = is_first ? formula : disjunction({found->derived, formula});
  }

  void action(const Node& node) {
    if (node.items.size() < 2 || node.items[1].is_list) fail(node, "an action needs a name");
    const Note note = note_after(node, 2);
    Action result;
    result.name = name_from_pddl(node.items[1].word);
    if (domain_.action(result.name) != nullptr) fail(node, "action `" + result.name + "` is defined twice");
    result.skill = note.skill;
    result.case_name = note.case_name;
    result.distinct = note.distinct;
    result.may_equal = note.may_equal;
    result.cost = has_costs_ ? 0 : 1;
    for (std::size_t i = 2; i < node.items.size(); i += 2) {
      const std::string& key = node.items[i].word;
      if (i + 1 >= node.items.size()) fail(node.items[i], "`" + key + "` has no value after it");
      const Node& value = node.items[i + 1];
      if (key == ":parameters") {
        if (!value.is_list) fail(value, "expected (?x - type …)");
        result.parameters = read_typed(value, 0, true, &domain_);
      } else if (key == ":precondition") {
        result.precondition = without_guards(read_formula(value, result.parameters, vocabulary_), note.guards);
      } else if (key == ":effect") {
        read_effects(value, result.parameters, vocabulary_, {}, result.effects, result.cost);
      } else {
        fail(node.items[i], "unknown field `" + key + "`",
             did_you_mean(key, {":parameters", ":precondition", ":effect"}));
      }
    }
    add_traits(result.parameters, note);
    domain_.actions.push_back(std::move(result));
  }

  const Node& top_;
  Domain domain_;
  Vocabulary vocabulary_;
  bool has_costs_ = false;
};

void read_init(const Node& node, const Vocabulary& vocabulary, Facts& init) {
  for (std::size_t i = 1; i < node.items.size(); ++i) {
    const Node& item = node.items[i];
    if (item.head() == "=") continue;    // (= (total-cost) 0)
    if (item.head() == "not") continue;  // closed world: what is not said is false
    const Formula read = read_formula(item, {}, vocabulary);
    if (read.kind != Formula::Kind::atom) fail(item, "init holds facts only", "write (NAME object …)");
    Fact fact{read.predicate, {}};
    for (const Term& term : read.terms) fact.arguments.push_back(term.name);
    init.insert(std::move(fact));
  }
}

}  // namespace

Domain domain_from_pddl(std::string_view text, const std::string& file) {
  return DomainReader(parse_list(text, file)).run();
}

Problem problem_from_pddl(std::string_view text, const std::string& file, const Domain& domain) {
  const Node top = parse_list(text, file);
  if (top.head() != "define" || top.items.size() < 2 || top.items[1].head() != "problem" ||
      top.items[1].items.size() != 2) {
    fail(top, "expected (define (problem NAME) …)");
  }
  Problem problem;
  problem.name = name_from_pddl(top.items[1].items[1].word);
  problem.objects = domain.constants;
  const std::vector<std::string> known = {":domain", ":goal", ":init", ":metric", ":objects", ":requirements"};
  for (std::size_t i = 2; i < top.items.size(); ++i) {
    const Node& node = top.items[i];
    if (std::find(known.begin(), known.end(), node.head()) == known.end()) {
      fail(node, "unknown section `" + node.head() + "`", did_you_mean(node.head(), known));
    }
    if (node.head() == ":domain" && (node.items.size() != 2 || name_from_pddl(node.items[1].word) != domain.name)) {
      fail(node, "the problem is for another domain", "the domain at hand is `" + domain.name + "`");
    }
    if (node.head() != ":objects") continue;
    for (const Parameter& one : read_typed(node, 1, false, &domain)) {
      const bool twice = std::any_of(problem.objects.begin(), problem.objects.end(),
                                     [&](const TypedObject& other) { return other.name == one.name; });
      if (twice) fail(node, "object `" + one.name + "` is declared twice", "remove one of the two");
      problem.objects.push_back({one.name, one.type.empty() ? "object" : one.type});
    }
  }
  std::sort(problem.objects.begin(), problem.objects.end());
  const Vocabulary vocabulary{&domain, &problem.objects};
  for (const Node& node : top.items) {
    if (node.head() == ":init") read_init(node, vocabulary, problem.init);
    if (node.head() != ":goal") continue;
    if (node.items.size() != 2) fail(node, "expected (:goal formula)");
    problem.goal = read_formula(node.items[1], {}, vocabulary);
  }
  return problem;
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
