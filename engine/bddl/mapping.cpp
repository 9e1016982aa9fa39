#include "engine/bddl/mapping.h"

#include <algorithm>

#include "engine/base/enum_names.h"
#include "engine/base/error.h"
#include "engine/bddl/words.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {

std::string_view to_string(BddlMeaning meaning) {
  constexpr std::array<std::string_view, 4> kNames{"equal", "stronger", "weaker", "incomparable"};
  return enum_name(kNames, meaning);
}

BddlMeaning opposite(BddlMeaning meaning) {
  if (meaning == BddlMeaning::stronger) return BddlMeaning::weaker;
  return meaning == BddlMeaning::weaker ? BddlMeaning::stronger : meaning;
}

namespace {

const BddlPredicateRule* best_rule(const std::vector<BddlPredicateRule>& rules, std::string BddlPredicateRule::*side,
                                   const std::string& predicate, bool negated) {
  const BddlPredicateRule* first = nullptr;
  for (const BddlPredicateRule& rule : rules) {
    if (rule.*side != predicate) continue;
    if (rule.negated == negated) return &rule;  // its counterpart is a plain atom
    if (first == nullptr) first = &rule;
  }
  return first;
}

}  // namespace

const BddlPredicateRule* BddlMapping::from_theirs(const std::string& predicate, bool negated) const {
  return best_rule(predicates, &BddlPredicateRule::theirs, predicate, negated);
}

const BddlPredicateRule* BddlMapping::from_ours(const std::string& predicate, bool negated) const {
  return best_rule(predicates, &BddlPredicateRule::ours, predicate, negated);
}

const std::string* BddlMapping::category(const std::string& class_name, const std::string& type) const {
  for (const std::string* wanted : {&class_name, &type}) {
    for (const BddlPair& pair : categories) {
      if (!wanted->empty() && pair.ours == *wanted) return &pair.theirs;
    }
  }
  return nullptr;
}

const std::string* BddlMapping::class_of(const std::string& category) const {
  for (const BddlPair& pair : categories) {
    if (pair.theirs == category) return &pair.ours;
  }
  return nullptr;
}

void BddlMapping::add_namesakes(const BddlProblem& problem, const std::function<bool(const std::string&)>& is_ours) {
  for (const auto* groups : {&problem.fixtures, &problem.objects}) {
    for (const BddlGroup& group : *groups) {
      if (class_of(group.category) == nullptr && is_ours(group.category)) {
        categories.push_back({group.category, group.category});
      }
    }
  }
}

void check_mapping(const BddlMapping& mapping, const std::string& where) {
  const auto& known = symbolic::bddl_predicates(mapping.dialect);
  for (const BddlPredicateRule& rule : mapping.predicates) {
    const auto found = known.find(rule.theirs);
    if (found == known.end()) {
      std::vector<std::string> names;
      for (const auto& [name, arity] : known) names.push_back(name);
      throw Error(where, std::string(to_string(mapping.dialect)) + " has no predicate `" + rule.theirs + "`",
                  symbolic::did_you_mean(rule.theirs, names));
    }
    if (rule.ours.empty()) throw Error(where, "`" + rule.theirs + "` is mapped to nothing", "name our predicate");
    std::vector<int> sorted = rule.order;
    std::sort(sorted.begin(), sorted.end());
    bool permutation = rule.order.empty() || found->second < 0 || static_cast<int>(sorted.size()) == found->second;
    for (std::size_t i = 0; i < sorted.size(); ++i) permutation = permutation && sorted[i] == static_cast<int>(i);
    if (!permutation) {
      throw Error(where, "the order of arguments of `" + rule.theirs + "` is no permutation",
                  "their argument i is our argument order[i], counted from 0: {1, 0} swaps two");
    }
  }
  for (const BddlPair& pair : mapping.categories) {
    if (pair.theirs.empty() || pair.ours.empty()) throw Error(where, "a category without name", "name both sides");
  }
}

std::string to_text(const BddlNote& note) {
  const std::string relation = note.meaning == BddlMeaning::equal ? "equal"
                               : note.meaning == BddlMeaning::incomparable
                                   ? "neither stronger nor weaker"
                                   : std::string(to_string(note.meaning)) + " than theirs";
  return "ours `" + note.ours + "`, theirs `" + note.theirs + "`: " + relation +
         (note.why.empty() ? "" : ": " + note.why);
}

}  // namespace stampede
