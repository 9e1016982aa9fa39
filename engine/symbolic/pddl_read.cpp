#include <algorithm>
#include <map>
#include <set>
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
  for (const NodeNote& note : list.notes) {
    if (note.at == items_before) return read_note(note.text);
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
    std::sort(domain_.functions.begin(), domain_.functions.end(),
              [](const Predicate& a, const Predicate& b) { return a.name < b.name; });
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
    if (node.head() == ":requirements") check_requirements(node);
  }

  void declare(const Node& node) {
    if (node.head() == ":types") {
      for (const Parameter& one : read_typed(node, 1, false, nullptr)) {
        parents_[one.name].insert(one.type.empty() ? "object" : one.type);
        domain_.types.try_emplace(one.name, "object");
      }
      for (std::size_t i = 1; i < node.items.size(); ++i) {
        const std::string name = name_from_pddl(node.items[i].word);
        if (name != "-" && name != "object" && !domain_.types.contains(name)) domain_.types[name] = "object";
      }
      domain_.types.erase("object");
      parents_.erase("object");
      for (const auto& [type, parents] : parents_) choose_parent(node, type, parents);
    } else if (node.head() == ":constants") {
      for (const Parameter& one : read_typed(node, 1, false, &domain_)) {
        for (const TypedObject& other : domain_.constants) {
          if (other.name == one.name)
            fail(node, "constant `" + one.name + "` is declared twice", "remove one of the two");
        }
        domain_.constants.push_back({one.name, one.type.empty() ? "object" : one.type});
      }
      std::sort(domain_.constants.begin(), domain_.constants.end());
    } else {
      for (std::size_t i = 1; i < node.items.size(); ++i) predicate(node.items[i], note_after(node, i + 1));
      const auto by_name = [](const auto& a, const auto& b) { return a.name < b.name; };
      std::sort(domain_.predicates.begin(), domain_.predicates.end(), by_name);
    }
  }

  // What a type descends from on any of its lines, itself left out.
  std::set<std::string> all_above(const Node& node, const std::string& type) const {
    std::set<std::string> above;
    std::vector<std::string> open = {type};
    while (!open.empty()) {
      const auto found = parents_.find(open.back());
      open.pop_back();
      if (found == parents_.end()) continue;
      for (const std::string& parent : found->second) {
        if (parent == type) {
          fail(node, "type `" + type + "` descends from itself", "give one type of the circle another parent");
        }
        if (above.insert(parent).second) open.push_back(parent);
      }
    }
    return above;
  }

  // A type on several lines (`area - object`, then `area - surface`): the parent that lies below all others.
  void choose_parent(const Node& node, const std::string& type, const std::set<std::string>& parents) {
    all_above(node, type);
    for (const std::string& parent : parents) {
      const std::set<std::string> above = all_above(node, parent);
      const auto is_above = [&](const std::string& other) {
        return other == parent || other == "object" || above.contains(other);
      };
      if (!std::all_of(parents.begin(), parents.end(), is_above)) continue;
      if (parent == "object" && parents.size() > 1) continue;
      domain_.types[type] = parent;
      return;
    }
    std::string list;
    for (const std::string& parent : parents) list += (list.empty() ? "`" : ", `") + parent + "`";
    fail(node, "type `" + type + "` has parents of which none descends from the others: " + list,
         "give it one; what crosses the tree is a static predicate");
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
    result.parameters = read_typed(node, 1, true, &domain_, Repeats::renamed);
    add_traits(result.parameters, note);
    result.label = note.label;
    if (note.fixed) result.kind = PredicateKind::fixed;
    domain_.predicates.push_back(std::move(result));
  }

  void functions(const Node& node) {
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      const Node& item = node.items[i];
      if (!item.is_list) {  // - number
        if (item.word == "-" || item.word == "number") continue;
        fail(item, "a function is a number, got `" + item.word + "`", "use a predicate for a function to objects");
      }
      if (item.head().empty()) fail(item, "expected (NAME ?x - type …)");
      if (item.head() == "total-cost" && item.items.size() == 1) {
        has_costs_ = true;
        continue;
      }
      Predicate function;
      function.name = name_from_pddl(item.head());
      function.parameters = read_typed(item, 1, true, &domain_, Repeats::renamed);
      for (const Predicate& one : domain_.functions) {
        if (one.name == function.name) fail(item, "function `" + one.name + "` is declared twice");
      }
      domain_.functions.push_back(std::move(function));
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
    std::set<std::string> seen;
    for (std::size_t i = 2; i < node.items.size(); i += 2) {
      const std::string& key = node.items[i].word;
      if (node.items[i].is_list) fail(node.items[i], "expected :parameters, :precondition or :effect");
      if (!seen.insert(key).second) fail(node.items[i], "a second `" + key + "` in one action", "join the two");
      if (i + 1 >= node.items.size()) fail(node.items[i], "`" + key + "` has no value after it");
      const Node& value = node.items[i + 1];
      if (key == ":parameters") {
        if (!value.is_list) fail(value, "expected (?x - type …)");
        if (i > 2) fail(node.items[i], "`:parameters` comes after what uses them", "put it behind the action's name");
        result.parameters = read_typed(value, 0, true, &domain_);
      } else if (key == ":precondition") {
        result.precondition = without_guards(read_formula(value, result.parameters, vocabulary_), note.guards);
      } else if (key == ":effect") {
        read_effects(value, result.parameters, vocabulary_, result);
      } else {
        fail(node.items[i], "unknown field `" + key + "`",
             did_you_mean(key, {":parameters", ":precondition", ":effect"}));
      }
    }
    add_traits(result.parameters, note);
    domain_.actions.push_back(std::move(result));
  }

  // Fast Downward and VAL do not check these against what is used, and neither does this: only what cannot be
  // understood here is refused.
  void check_requirements(const Node& node) const {
    static const std::vector<std::string> kKnown = {":action-costs",
                                                    ":adl",
                                                    ":conditional-effects",
                                                    ":derived-predicates",
                                                    ":disjunctive-preconditions",
                                                    ":equality",
                                                    ":existential-preconditions",
                                                    ":negation",
                                                    ":negative-preconditions",
                                                    ":quantified-preconditions",
                                                    ":strips",
                                                    ":typing",
                                                    ":universal-preconditions"};
    for (std::size_t i = 1; i < node.items.size(); ++i) {
      const Node& key = node.items[i];
      for (const char* unsupported :
           {":durative-actions", ":duration-inequalities", ":continuous-effects", ":fluents", ":numeric-fluents",
            ":object-fluents", ":preferences", ":constraints", ":timed-initial-literals", ":time"}) {
        if (key.word != unsupported) continue;
        fail(key, "`" + key.word + "` is not supported", "leave time and numbers to the skills");
      }
      if (key.is_list || std::find(kKnown.begin(), kKnown.end(), key.word) == kKnown.end()) {
        fail(key, "unknown requirement `" + key.word + "`", did_you_mean(key.word, kKnown));
      }
    }
  }

  const Node& top_;
  Domain domain_;
  Vocabulary vocabulary_;
  std::map<std::string, std::set<std::string>> parents_;  // of each type, on all its lines
  bool has_costs_ = false;
};

}  // namespace

Domain domain_from_pddl(std::string_view text, const std::string& file) {
  return DomainReader(parse_list(text, file)).run();
}

}  // namespace stampede
