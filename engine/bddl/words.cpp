#include "engine/bddl/words.h"

#include <algorithm>
#include <cmath>

#include "engine/symbolic/pddl_text.h"

namespace stampede::symbolic {
namespace {

constexpr int kOneOrTwo = -1;

bool is_word(const std::string& word) {
  return !word.empty() && word != "-" && std::none_of(word.begin(), word.end(), [](unsigned char c) {
    return c <= ' ' || c == '(' || c == ')' || c == ';' || (c >= 'A' && c <= 'Z');
  });
}

std::optional<Complaint> word(const std::string& text, const char* what) {
  if (is_word(text) && text[0] != '?' && text[0] != ':') return std::nullopt;
  return Complaint{"`" + text + "` cannot be the name of " + what,
                   "use small letters, digits, `_` and `.`: their lexer knows no others apart"};
}

bool all_finite(const BddlRegion& region) {
  const auto finite = [](double x) { return std::isfinite(x); };
  for (const BddlRectangle& r : region.ranges) {
    if (!finite(r.x_min_m) || !finite(r.y_min_m) || !finite(r.x_max_m) || !finite(r.y_max_m)) return false;
  }
  return std::all_of(region.yaw_rad.begin(), region.yaw_rad.end(), finite) &&
         std::all_of(region.rgba.begin(), region.rgba.end(), finite);
}

}  // namespace

const std::map<std::string, int>& bddl_predicates(BddlDialect dialect) {
  static const std::map<std::string, int> kLibero = {
      {"true", kOneOrTwo}, {"false", kOneOrTwo}, {"in", 2},     {"on", 2},      {"up", 1},
      {"open", 1},         {"close", 1},         {"turnon", 1}, {"turnoff", 1}, {"printjointstate", 1}};
  static const std::map<std::string, int> kBehavior = [] {
    std::map<std::string, int> all;
    // Of 2021: burnt dusty perished screwed sliced soaked stained timeset onfloor; of 1K: folded … grasped.
    for (const char* unary :
         {"broken", "burnt", "cooked", "dusty", "frozen", "open", "perished", "screwed", "stained", "sliced", "soaked",
          "timeset", "toggled_on", "folded", "unfolded", "hot", "on_fire", "future", "real"}) {
      all[unary] = 1;
    }
    for (const char* binary :
         {"inside", "nextto", "ontop", "under", "onfloor", "touching", "inroom", "saturated", "covered", "filled",
          "contains", "overlaid", "attached", "draped", "insource", "grasped"}) {
      all[binary] = 2;
    }
    return all;
  }();
  return dialect == BddlDialect::libero ? kLibero : kBehavior;
}

bool is_bddl_room(const std::string& word) {
  static const std::set<std::string> kRooms = {
      "kitchen",      "dining_room",     "living_room",    "utility_room", "empty_room", "bedroom",
      "bathroom",     "garden",          "shared_office",  "corridor",     "classroom",  "grocery_store",
      "computer_lab", "playroom",        "sauna",          "childs_room",  "garage",     "closet",
      "storage_room", "entryway",        "private_office", "meeting_room", "bar",        "staircase",
      "spa",          "television_room", "lobby",          "break_room"};
  return kRooms.count(word) > 0;
}

bool is_wildcard(const std::string& name) { return name.size() > 2 && name.ends_with("_*"); }

bool is_instance_of(const std::string& name, const std::string& category) {
  if (name.size() < category.size() + 2 || !name.starts_with(category) || name[category.size()] != '_') return false;
  const std::string rest = name.substr(category.size() + 1);
  return rest == "*" || rest.find_first_not_of("0123456789") == std::string::npos;
}

BddlScope::BddlScope(const BddlProblem& problem) : problem_(problem) {
  for (const auto* groups : {&problem.fixtures, &problem.objects}) {
    for (const BddlGroup& group : *groups) things_.insert(group.names.begin(), group.names.end());
  }
  for (const BddlRegion& region : problem.regions) regions_.insert(region.key());
}

std::optional<Complaint> BddlScope::declarations() const {
  std::set<std::string> seen, categories;
  const auto twice = [&](const std::string& name) -> std::optional<Complaint> {
    if (seen.insert(name).second) return std::nullopt;
    return Complaint{"`" + name + "` is declared twice",
                     "rename one; BDDL makes all letters small, so names that differ only in case are one"};
  };
  for (const auto* groups : {&problem_.fixtures, &problem_.objects}) {
    categories.clear();
    for (const BddlGroup& group : *groups) {
      if (auto bad = word(group.category, "a type")) return bad;
      if (group.names.empty()) return Complaint{"no object stands before `- " + group.category + "`", "remove it"};
      if (!categories.insert(group.category).second) {
        return Complaint{"the type `" + group.category + "` has two lines",
                         "write all its instances on one line: their parser keeps only the last"};
      }
      for (const std::string& name : group.names) {
        if (auto bad = word(name, "an object")) return bad;
        if (auto bad = twice(name)) return bad;
        if (is_wildcard(name) && (problem_.dialect == BddlDialect::libero || &name != &group.names.back() ||
                                  !is_instance_of(name, group.category))) {
          return Complaint{"`" + name + "` stands where no wildcard may",
                           "BEHAVIOR allows `" + group.category + "_*` as the last instance of its line"};
        }
      }
    }
  }
  for (const BddlRegion& region : problem_.regions) {
    if (auto bad = word(region.name, "a region")) return bad;
    if (things_.count(region.target) == 0) {
      return Complaint{"the region `" + region.name + "` has the unknown :target `" + region.target + "`",
                       did_you_mean(region.target, {things_.begin(), things_.end()})};
    }
    if (!all_finite(region)) return Complaint{"the region `" + region.name + "` has a number without value", ""};
    if (auto bad = twice(region.key())) return bad;
  }
  return std::nullopt;
}

std::optional<Complaint> BddlScope::name(const std::string& name) const {
  if (things_.count(name) > 0 || regions_.count(name) > 0) return std::nullopt;
  for (const BddlRegion& region : problem_.regions) {
    if (region.name == name) {
      return Complaint{"the region `" + name + "` has another name here",
                       "write `" + region.key() + "`: outside :regions it carries its target's name"};
    }
  }
  std::vector<std::string> known(things_.begin(), things_.end());
  known.insert(known.end(), regions_.begin(), regions_.end());
  return Complaint{"`" + name + "` is neither an object nor a fixture nor a region", did_you_mean(name, known)};
}

const std::vector<std::string>* BddlScope::instances(const std::string& category) const {
  for (const BddlGroup& group : problem_.objects) {
    if (group.category == category) return &group.names;
  }
  return nullptr;
}

std::optional<Complaint> BddlScope::atom(const std::string& predicate, const std::vector<std::string>& arguments,
                                         const std::vector<Parameter>& bound) const {
  const auto& known = bddl_predicates(problem_.dialect);
  const auto found = known.find(predicate);
  if (found == known.end()) {
    std::vector<std::string> names;
    for (const auto& [one, arity] : known) names.push_back(one);
    return Complaint{std::string(to_string(problem_.dialect)) + " has no predicate `" + predicate + "`",
                     did_you_mean(predicate, names)};
  }
  const auto count = static_cast<int>(arguments.size());
  if (found->second == kOneOrTwo ? count < 1 || count > 2 : count != found->second) {
    const std::string wanted = found->second == kOneOrTwo ? "1 or 2" : std::to_string(found->second);
    return Complaint{"`" + predicate + "` takes " + wanted + (wanted == "1" ? " argument" : " arguments") + ", got " +
                         std::to_string(count),
                     "write (" + predicate + (found->second == 2 ? " a b)" : " a)")};
  }
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (predicate == "inroom" && i == 1) {
      if (auto bad = word(arguments[i], "a room")) return bad;
      continue;
    }
    const auto is_bound = [&](const Parameter& v) { return v.name == arguments[i]; };
    if (std::any_of(bound.begin(), bound.end(), is_bound)) continue;
    if (auto bad = name(arguments[i])) return bad;
    if ((predicate == "turnon" || predicate == "turnoff") && regions_.count(arguments[i]) > 0) {
      return Complaint{"`" + predicate + "` of the region `" + arguments[i] + "` raises AttributeError in LIBERO",
                       "name the fixture instead of its region"};
    }
  }
  return std::nullopt;
}

std::optional<Complaint> BddlScope::literal(const BddlLiteral& literal) const {
  if (literal.negated && problem_.dialect == BddlDialect::libero) {
    return Complaint{"LIBERO's :init cannot say `not`", "leave it out, or use the opposite (`close`, `turnoff`)"};
  }
  for (const std::string& argument : literal.atom.arguments) {
    if (is_wildcard(argument) && (literal.atom.predicate != "inroom" || literal.negated)) {
      return Complaint{"the wildcard `" + argument + "` in `" + literal.atom.predicate + "`",
                       "a wildcard stands in :objects and in one (inroom " + argument + " room)"};
    }
  }
  return atom(literal.atom.predicate, literal.atom.arguments, {});
}

std::optional<Complaint> BddlScope::quantifier(const BddlFormula& formula, const std::vector<Parameter>& bound) const {
  std::vector<std::size_t> sizes;
  std::vector<Parameter> seen = bound;
  for (const Parameter& variable : formula.variables) {
    if (auto bad = word(variable.name, "a variable")) return bad;
    for (const Parameter& other : seen) {
      if (other.name == variable.name) {
        return Complaint{"`?" + variable.name + "` is bound twice",
                         "their variables are told apart by name: one category cannot be nested in itself"};
      }
    }
    seen.push_back(variable);
    const auto* values = instances(variable.type);
    if (values == nullptr) {
      std::vector<std::string> known;
      for (const BddlGroup& group : problem_.objects) known.push_back(group.category);
      return Complaint{"no object is of the category `" + variable.type + "`", did_you_mean(variable.type, known)};
    }
    sizes.push_back(values->size());
  }
  const bool wild = std::any_of(formula.variables.begin(), formula.variables.end(),
                                [&](const Parameter& v) { return is_wildcard(instances(v.type)->back()); });
  if (formula.count < 0) return Complaint{"a count below 0", "count from 0"};
  if (formula.kind == BddlFormula::Kind::fornpairs && !wild &&
      static_cast<std::size_t>(formula.count) > std::min(sizes[0], sizes[1])) {
    return Complaint{"fornpairs asks for " + std::to_string(formula.count) + " pairs, there are at most " +
                         std::to_string(std::min(sizes[0], sizes[1])),
                     "their grounding asserts this: lower the number or add objects"};
  }
  return std::nullopt;
}

std::optional<Complaint> BddlScope::goal_atom(const BddlFormula& formula, const std::vector<Parameter>& bound) const {
  std::vector<std::string> arguments;
  for (const Term& term : formula.terms) {
    const auto is_bound = [&](const Parameter& v) { return v.name == term.name; };
    if (term.variable != std::any_of(bound.begin(), bound.end(), is_bound)) {
      return Complaint{"`?" + term.name + "` is bound by nothing around it", "name an object or add a quantifier"};
    }
    arguments.push_back(term.name);
  }
  for (const std::string& argument : arguments) {
    if (is_wildcard(argument)) return Complaint{"the wildcard `" + argument + "` in the goal", "name its instances"};
  }
  return atom(formula.predicate, arguments, bound);
}

std::optional<Complaint> BddlScope::node(const BddlFormula& formula, const std::vector<Parameter>& bound) const {
  using Kind = BddlFormula::Kind;
  if (formula.kind == Kind::atom) return goal_atom(formula, bound);
  if (problem_.dialect == BddlDialect::libero) {
    const std::string text = to_text(formula);
    return Complaint{
        "LIBERO reads `" + text.substr(1, text.find_first_of(" )") - 1) + "` in a goal but cannot evaluate it",
        "its goals are one `and` of atoms"};
  }
  const std::size_t wanted = formula.kind == Kind::implication ? 2 : 1;
  const bool any_number = formula.kind == Kind::conjunction || formula.kind == Kind::disjunction;
  if (any_number ? formula.parts.empty() : formula.parts.size() != wanted) {
    return Complaint{any_number ? "`" + to_text(formula) + "` says nothing" : "a part is missing or too many",
                     any_number ? "give it at least one part" : "see the grammar of goals"};
  }
  const bool pairs = formula.kind == Kind::forpairs || formula.kind == Kind::fornpairs;
  const bool quantified =
      pairs || formula.kind == Kind::forall || formula.kind == Kind::exists || formula.kind == Kind::forn;
  const std::size_t variables = pairs ? 2 : quantified ? 1 : 0;
  if (formula.variables.size() != variables) return Complaint{"a quantifier with the wrong number of variables", ""};
  return quantified ? quantifier(formula, bound) : std::nullopt;
}

}  // namespace stampede::symbolic
