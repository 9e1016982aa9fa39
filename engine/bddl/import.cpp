#include "engine/bddl/import.h"

#include <algorithm>
#include <cctype>

#include "engine/base/error.h"
#include "engine/bddl/translate.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {
namespace symbolic {
namespace {

// Letters, digits and single underscores: `can__of__soda.n.01` -> `can_of_soda`.
std::string plain_word(const std::string& text) {
  std::string word;
  const std::size_t synset = text.find(".n.");
  for (const char c : text.substr(0, synset)) {
    const bool good = std::isalnum(static_cast<unsigned char>(c)) != 0;
    if (good) word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (!good && !word.empty() && word.back() != '_') word += '_';
  }
  while (!word.empty() && word.back() == '_') word.pop_back();
  if (word.empty() || std::isdigit(static_cast<unsigned char>(word[0])) != 0) word = "thing_" + word;
  static const std::set<std::string> kTaken = {
      "and",   "break", "do",     "else",   "elseif", "end",    "false",  "for",    "function", "goto",
      "if",    "in",    "local",  "nil",    "not",    "or",     "repeat", "return", "then",     "true",
      "until", "while", "object", "number", "either", "define", "when",   "forall", "exists"};
  return kTaken.count(word) > 0 ? word + "_thing" : word;
}

class Importer {
 public:
  Importer(const BddlProblem& problem, const BddlMapping& mapping)
      : problem_(problem), mapping_(mapping), translator_(problem_, mapping_, task_) {}

  BddlTask run() {
    task_.name = plain_word(problem_.name);
    task_.instruction = problem_.language;
    try {
      name_objects();
      name_regions();
      for (const BddlLiteral& literal : problem_.init) read_init(literal);
      for (const BddlFormula& part : problem_.goal) task_.goal_parts.push_back(translator_.formula(part));
      task_.goal = conjunction(task_.goal_parts);
      check_goal();
      for (const std::string& name : problem_.interest) task_.interest.push_back(task_.names.at(name));
    } catch (const Refusal& refusal) {
      task_.refusal = refusal.why;
    }
    std::erase_if(task_.regions, [&](const BddlMadeRegion& region) { return !uses(region); });
    for (const BddlMadeRegion& region : task_.regions) {
      if (!region.ranges.empty()) continue;
      task_.warnings.push_back("`" + region.theirs + "` is a site of their model and no part of ours: make `" +
                               region.name + "`, or add it to the mapping's sites and parts");
    }
    return std::move(task_);
  }

 private:
  void name_objects() {
    std::string unknown;
    for (const auto* groups : {&problem_.fixtures, &problem_.objects}) {
      for (const BddlGroup& group : *groups) {
        const std::string* ours = mapping_.class_of(group.category);
        if (ours == nullptr) unknown += (unknown.empty() ? "`" : ", `") + group.category + "`";
        for (const std::string& name : group.names) {
          if (ours != nullptr) add_object(name, group.category, *ours, groups == &problem_.fixtures);
        }
      }
    }
    if (!unknown.empty())
      throw Refusal{"no object of ours stands for " + unknown + "; add it to the mapping's categories"};
  }

  void add_object(const std::string& theirs, const std::string& category, const std::string& ours, bool fixture) {
    if (is_wildcard(theirs)) {
      task_.warnings.push_back("`" + theirs + "` is left out: say how many the room has to have it expanded");
      return;
    }
    if (ours == "hand") {
      task_.names[theirs] = mapping_.hand;
      return;
    }
    BddlObject object{unique(own_name(theirs, category)), theirs, category, ours, plain_word(category)};
    for (const BddlLiteral& literal : problem_.init) {
      fixture = fixture || (literal.atom.predicate == "inroom" && literal.atom.arguments.at(0) == theirs);
    }
    task_.names[theirs] = object.name;
    (fixture ? task_.fixtures : task_.objects).push_back(std::move(object));
  }

  static std::string own_name(const std::string& theirs, const std::string& category) {
    if (category.find(".n.") == std::string::npos || !is_instance_of(theirs, category)) return plain_word(theirs);
    return plain_word(category) + "_" + theirs.substr(category.size() + 1);
  }

  std::string unique(const std::string& name) {
    std::string result = name;
    for (int i = 2; !taken_.insert(result).second; ++i) result = name + "_" + std::to_string(i);
    return result;
  }

  bool has_part(const std::string& theirs, const std::string& part) const {
    if (part.empty()) return true;
    for (const auto* things : {&task_.fixtures, &task_.objects}) {
      for (const BddlObject& thing : *things) {
        const auto parts = mapping_.parts.find(thing.class_name);
        if (thing.theirs != theirs || parts == mapping_.parts.end()) continue;
        return std::find(parts->second.begin(), parts->second.end(), part) != parts->second.end();
      }
    }
    return false;
  }

  // A site that the fixture has here too becomes our part; the rest are regions to be made.
  void name_regions() {
    for (const BddlRegion& region : problem_.regions) {
      const std::string& target = task_.names.at(region.target);
      const auto site = std::find_if(mapping_.sites.begin(), mapping_.sites.end(), [&](const BddlPair& pair) {
        return region.ranges.empty() && region.name.ends_with(pair.theirs) && has_part(region.target, pair.ours);
      });
      if (site != mapping_.sites.end()) {
        task_.names[region.key()] = site->ours.empty() ? target : target + "." + site->ours;
        continue;
      }
      const std::string name = target + "." + plain_word(region.name);
      task_.names[region.key()] = name;
      task_.regions.push_back({name, region.key(), target, region.ranges});
    }
  }

  void read_init(const BddlLiteral& literal) {
    const Fact& atom = literal.atom;
    const bool wild = std::any_of(atom.arguments.begin(), atom.arguments.end(), is_wildcard);
    if (atom.predicate == "inroom") {
      if (!wild && !literal.negated) task_.rooms[task_.names.at(atom.arguments.at(0))] = atom.arguments.at(1);
      return;
    }
    const auto is_hand = [&](const std::string& name) { return task_.names.at(name) == mapping_.hand; };
    if (atom.arguments.size() == 2 && is_hand(atom.arguments[0]) && atom.predicate != "grasped") {
      task_.warnings.push_back(to_text(atom) + " is left out: the robot stands where our world has it");
      return;
    }
    if (place(literal)) return;
    try {
      add_init(translator_.literal(atom, literal.negated));
    } catch (const Refusal& refusal) {
      task_.warnings.push_back("left out of the start: " + refusal.why);
    }
  }

  // `on` a region with rectangles says where the object is put; it then is on the region's target.
  bool place(const BddlLiteral& literal) {
    const Fact& atom = literal.atom;
    const BddlPredicateRule* rule = mapping_.from_theirs(atom.predicate, literal.negated);
    if (literal.negated || rule == nullptr || rule->ours != mapping_.support || atom.arguments.size() != 2)
      return false;
    for (const BddlRegion& region : problem_.regions) {
      if (region.key() != atom.arguments[1] || region.ranges.empty()) continue;
      const std::string &object = task_.names.at(atom.arguments[0]), &on = task_.names.at(region.target);
      task_.placements.push_back({object, on, region.ranges, region.yaw_rad});
      const auto is_object = [&](const BddlObject& thing) { return thing.name == object; };
      const bool fixture = std::any_of(task_.fixtures.begin(), task_.fixtures.end(), is_object);
      if (!fixture) task_.init.push_back({{rule->ours, {object, on}}, false});  // fixtures stand; nothing carries them
      return true;
    }
    return false;
  }

  void add_init(const Formula& formula) {
    if (formula.kind == Formula::Kind::conjunction) {
      for (const Formula& part : formula.parts) add_init(part);
      return;
    }
    if (formula.kind == Formula::Kind::disjunction) {  // any part will do
      task_.warnings.push_back("the start leaves a choice; taken: " + formula_text(formula.parts.at(0), Names::plain));
      add_init(formula.parts.at(0));
      return;
    }
    const bool negated = formula.kind == Formula::Kind::negation;
    const Formula& one = negated ? formula.parts.at(0) : formula;
    if (one.kind != Formula::Kind::atom) return;  // true, or a denied `on` a region, which no start can be made from
    Fact fact{one.predicate, {}};
    for (const Term& term : one.terms) fact.arguments.push_back(term.name);
    task_.init.push_back({fact, negated});
  }

  void check_goal() const {
    if (task_.goal.kind == Formula::Kind::always) throw Refusal{"the goal always holds: name what must become true"};
    const auto never = [](const Formula& part) { return part.kind == Formula::Kind::never; };
    if (std::any_of(task_.goal_parts.begin(), task_.goal_parts.end(), never)) {
      throw Refusal{"the goal can never hold: it counts more objects than there are, or asks for `false`"};
    }
  }

  static bool names(const Formula& formula, const std::string& name) {
    const auto is = [&](const Term& term) { return term.name == name; };
    const auto in = [&](const Formula& part) { return names(part, name); };
    return std::any_of(formula.terms.begin(), formula.terms.end(), is) ||
           std::any_of(formula.parts.begin(), formula.parts.end(), in);
  }

  bool uses(const BddlMadeRegion& region) const {
    const auto in_init = [&](const BddlLiteral& literal) {
      const auto& all = literal.atom.arguments;
      return std::find(all.begin(), all.end(), region.name) != all.end();
    };
    const auto in_goal = [&](const Formula& part) { return names(part, region.name); };
    return std::any_of(task_.init.begin(), task_.init.end(), in_init) ||
           std::any_of(task_.goal_parts.begin(), task_.goal_parts.end(), in_goal);
  }

  const BddlProblem& problem_;
  const BddlMapping& mapping_;
  BddlTask task_;
  BddlTranslator translator_;
  std::set<std::string> taken_;
};

}  // namespace
}  // namespace symbolic

BddlTask from_bddl(const BddlProblem& problem, const BddlMapping& mapping) {
  check_bddl(problem);
  check_mapping(mapping, "BDDL mapping");
  if (mapping.dialect != problem.dialect) {
    throw Error("BDDL mapping",
                "is for " + std::string(to_string(mapping.dialect)) + ", the problem is of " +
                    std::string(to_string(problem.dialect)),
                "take the mapping of the problem's dialect");
  }
  return symbolic::Importer(problem, mapping).run();
}

namespace {

std::string literal_text(const Fact& atom, bool negated) {
  return negated ? "(not " + to_text(atom) + ")" : to_text(atom);
}

const char* yes_no(bool verdict) { return verdict ? "yes" : "no"; }

// The predicates of one part, to list only the literals that it is made of.
bool mentions(const BddlFormula& formula, const std::string& predicate) {
  return formula.predicate == predicate || std::any_of(formula.parts.begin(), formula.parts.end(),
                                                       [&](const BddlFormula& p) { return mentions(p, predicate); });
}

}  // namespace

BddlVerdicts judge_both(const BddlProblem& problem, const BddlValues& values, const BddlTask& task,
                        const symbolic::View& ours) {
  if (!task.refusal.empty() || task.goal_parts.size() != problem.goal.size()) {
    throw Error(task.name, "has no goal of ours to judge by: " + task.refusal, "judge by theirs alone");
  }
  const auto holds_here = [&](const Formula& formula) { return holds(formula, ours.facts, ours.domain, ours.objects); };
  BddlVerdicts verdicts{true, true, {}};
  std::set<std::string> literals;
  for (std::size_t i = 0; i < problem.goal.size(); ++i) {
    const bool by_them = judge(problem.goal[i], problem, values), by_us = holds_here(task.goal_parts[i]);
    verdicts.theirs = verdicts.theirs && by_them;
    verdicts.ours = verdicts.ours && by_us;
    if (by_them == by_us) continue;
    const std::size_t before = literals.size();
    for (const auto& [literal, formula] : task.literals) {
      const auto& [atom, negated] = literal;
      if (!mentions(problem.goal[i], atom.predicate)) continue;
      const bool to_them = values.value(atom) != negated, to_us = holds_here(formula);
      if (to_them == to_us) continue;
      literals.insert(literal_text(atom, negated) + ": " + std::string(to_string(problem.dialect)) + " says " +
                      yes_no(to_them) + ", we say " + yes_no(to_us));
    }
    verdicts.disagreements.push_back(
        to_text(problem.goal[i]) + ": " + std::string(to_string(problem.dialect)) + " says " + yes_no(by_them) +
        ", we say " + yes_no(by_us) +
        (literals.size() == before ? "; the atoms are the same, pairs are counted otherwise" : ""));
  }
  verdicts.disagreements.insert(verdicts.disagreements.end(), literals.begin(), literals.end());
  return verdicts;
}

}  // namespace stampede
