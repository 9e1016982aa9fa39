#include <algorithm>
#include <set>

#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/search.h"

namespace stampede::symbolic {
namespace {

// Follows what nothing can make true from the goal down to an action or fact that is missing.
class Explainer {
 public:
  explicit Explainer(const GroundTask& task) : task_(task), lifted_(task.lifted) {
    for (const LiftedAtom& atom : task.reachable) reachable_.insert(task.fact(atom));
  }

  std::string impossible(const LiftedAtom& goal) {
    const std::string name = text(goal);
    if (lifted_.predicates[goal.predicate].starts_with("one of "))
      return "no part of the goal's choice can become true: " + why(goal, 0);
    return name + " cannot become true: " + why(goal, 0);
  }

 private:
  std::string text(const LiftedAtom& atom) const {
    if (lifted_.predicates[atom.predicate].starts_with("one of ")) return "one of several conditions";
    return to_text(task_.fact(atom));
  }

  // A schema's positive literal with the head's or effect's objects put in; unbound variables stay.
  static bool match(const LiftedAtom& pattern, const LiftedAtom& wanted, const Schema& schema,
                    std::vector<int>& binding) {
    binding.assign(schema.domains.size(), -1);
    for (std::size_t i = 0; i < pattern.terms.size(); ++i) {
      const LiftedTerm& term = pattern.terms[i];
      const int value = wanted.terms[i].id;
      if (!term.variable) {
        if (term.id != value) return false;
        continue;
      }
      const std::vector<int>& domain = schema.domains[term.id];
      if (std::find(domain.begin(), domain.end(), value) == domain.end()) return false;
      if (binding[term.id] >= 0 && binding[term.id] != value) return false;
      binding[term.id] = value;
    }
    return true;
  }

  bool is_reachable(const LiftedAtom& pattern, const std::vector<int>& binding) const {
    for (const LiftedAtom& one : task_.reachable) {
      if (one.predicate != pattern.predicate) continue;
      bool same = true;
      for (std::size_t i = 0; i < one.terms.size() && same; ++i) {
        const LiftedTerm& term = pattern.terms[i];
        const int value = term.variable ? binding[term.id] : term.id;
        same = value < 0 || value == one.terms[i].id;
      }
      if (same) return true;
    }
    return false;
  }

  std::string pattern_text(const LiftedAtom& pattern, const Schema& schema, const std::vector<int>& binding) const {
    if (lifted_.predicates[pattern.predicate].starts_with("one of ")) return "one of several conditions";
    std::string result = "(" + lifted_.predicates[pattern.predicate];
    for (const LiftedTerm& term : pattern.terms) {
      const int value = term.variable ? binding[term.id] : term.id;
      if (value >= 0) {
        result += " " + lifted_.objects[value].name;
      } else if (schema.action >= 0 && term.id < schema.parameters) {
        result += " ?" + lifted_.domain->actions[schema.action].parameters[term.id].name;
      } else {
        result += " ?";
      }
    }
    return result + ")";
  }

  struct Achiever {
    const Schema* schema;
    std::vector<int> binding;
  };

  std::vector<Achiever> achievers(const LiftedAtom& wanted, bool& any_of_predicate) const {
    std::vector<Achiever> result;
    any_of_predicate = false;
    std::vector<int> binding;
    for (const Schema& schema : lifted_.schemas) {
      if (schema.action < 0) {
        if (schema.head.predicate != wanted.predicate) continue;
        any_of_predicate = true;
        if (match(schema.head, wanted, schema, binding)) result.push_back({&schema, binding});
        continue;
      }
      for (const LiftedEffect& effect : schema.effects) {
        if (effect.negated || effect.atom.predicate != wanted.predicate) continue;
        any_of_predicate = true;
        if (match(effect.atom, wanted, schema, binding)) result.push_back({&schema, binding});
      }
    }
    return result;
  }

  std::string why(const LiftedAtom& wanted, int depth) {
    const std::string& predicate = lifted_.predicates[wanted.predicate];
    bool any = false;
    const std::vector<Achiever> found = achievers(wanted, any);
    if (!any) {
      return lifted_.derived[wanted.predicate] ? "its definition is never true" : "no action adds `" + predicate + "`";
    }
    if (found.empty()) return "the actions that add `" + predicate + "` do not accept these objects";
    std::string result;
    for (const Achiever& one : found) {
      const std::string reason = obstacle(one, depth);
      if (result.find(reason) != std::string::npos) continue;
      result += (result.empty() ? "" : "; ") + reason;
    }
    return result;
  }

  std::string obstacle(const Achiever& achiever, int depth) {
    const Schema& schema = *achiever.schema;
    const std::string who =
        schema.action >= 0 ? "`" + lifted_.domain->actions[schema.action].name + "` " : std::string("it ");
    for (const LiftedAtom& pattern : schema.body.positive) {
      if (is_reachable(pattern, achiever.binding)) continue;
      const std::string literal = pattern_text(pattern, schema, achiever.binding);
      std::string result = who + "needs " + literal;
      if (!lifted_.fluent[pattern.predicate]) return result + ", which is not a fact and which no action adds";
      const bool ground = std::all_of(pattern.terms.begin(), pattern.terms.end(), [&](const LiftedTerm& term) {
        return !term.variable || achiever.binding[term.id] >= 0;
      });
      result += ", which nothing achieves";
      if (!ground || depth >= 4 || !seen_.insert(literal).second) return result;
      LiftedAtom deeper{pattern.predicate, {}};
      for (const LiftedTerm& term : pattern.terms) {
        deeper.terms.push_back({false, term.variable ? achiever.binding[term.id] : term.id});
      }
      return result + " because " + why(deeper, depth + 1);
    }
    for (std::size_t i = 0; i < schema.domains.size(); ++i) {
      if (!schema.domains[i].empty()) continue;
      if (schema.action < 0 || static_cast<int>(i) >= schema.parameters) continue;
      const Parameter& parameter = lifted_.domain->actions[schema.action].parameters[i];
      std::string what = parameter.type.empty() ? "object" : parameter.type;
      for (const std::string& trait : parameter.traits) what = trait + " " + what;
      return who + "finds no " + what + " for ?" + parameter.name;
    }
    return who + "finds no objects for which all its conditions can hold together";
  }

  const GroundTask& task_;
  const LiftedTask& lifted_;
  std::set<Fact> reachable_;
  std::set<std::string> seen_;
};

}  // namespace

std::string explain_unsolvable(const GroundTask& task, const SearchResult& result, const PlanLimits& limits) {
  if (!task.impossible.empty()) return Explainer(task).impossible(task.impossible.front());
  if (!task.undeniable.empty()) {
    const Fact fact = task.fact(task.undeniable.front());
    return "(not " + to_text(fact) + ") cannot become true: it holds from the start and no possible action removes `" +
           fact.predicate + "`";
  }
  const auto literal_text = [&](Literal one) {
    const std::string text = to_text(task.fact(task.atoms[one >> 1]));
    return (one & 1) != 0 ? "(not " + text + ")" : text;
  };
  const Semantics semantics(task);
  Heuristic heuristic(task);
  const Words start = semantics.initial();
  if (heuristic.evaluate(start) == Heuristic::kDeadEnd) {
    const Literals unreached = heuristic.unreached_goal();
    if (!unreached.empty()) {
      return literal_text(unreached.front()) + " cannot become true: its conditions cannot all be met from the start";
    }
  }
  std::string open;
  for (const Literal one : task.goal) {
    if (!literal_holds(start.data(), one)) open += (open.empty() ? "" : " ") + literal_text(one);
  }
  if (result.exhausted) {
    return "the goal's parts exclude each other: all " + std::to_string(result.evaluated) +
           " states were searched and none has " + open + " together";
  }
  const bool out_of_expansions = result.evaluated >= limits.expansions;
  return "no plan within the limit of " +
         (out_of_expansions ? std::to_string(limits.expansions) + " expansions"
                            : std::to_string(limits.memory_bytes) + " bytes") +
         "; still open at the start: " + open;
}

}  // namespace stampede::symbolic
