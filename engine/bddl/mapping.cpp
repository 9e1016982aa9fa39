#include "engine/bddl/mapping.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/bddl/words.h"
#include "engine/symbolic/pddl_text.h"

namespace stampede {

std::string_view to_string(BddlMeaning meaning) {
  switch (meaning) {
    case BddlMeaning::equal:
      return "equal";
    case BddlMeaning::stronger:
      return "stronger";
    case BddlMeaning::weaker:
      return "weaker";
    case BddlMeaning::incomparable:
      return "incomparable";
  }
  return "";
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

BddlMapping default_libero_mapping() {
  using enum BddlMeaning;
  BddlMapping mapping;
  mapping.problem_name = "libero_tabletop_manipulation";
  mapping.categories = {{"table", "work_table"},         {"main_table", "work_table"},
                        {"kitchen_table", "work_table"}, {"living_room_table", "work_table"},
                        {"study_table", "work_table"},   {"coffee_table", "work_table"},
                        {"wooden_cabinet", "chest"},     {"white_cabinet", "chest"},
                        {"flat_stove", "push_button"},   {"floor", "floor"},
                        {"wooden_block", "cube"},        {"porcelain_mug", "mug"},
                        {"red_coffee_mug", "mug"},       {"white_yellow_mug", "mug"},
                        {"alphabet_soup", "soup_can"},   {"chocolate_pudding", "chocolate_jelly"},
                        {"wooden_tray", "tray"}};
  mapping.sites = {{"top_region", "top_drawer"},
                   {"middle_region", "middle_drawer"},
                   {"bottom_region", "bottom_drawer"},
                   {"top_side", ""},
                   {"cook_region", ""}};
  mapping.parts = {{"chest", {"bottom_drawer", "middle_drawer", "top_drawer"}}};
  mapping.predicates = {
      {"on",
       "on",
       false,
       {},
       weaker,
       "theirs also asks that the centres are within 3 cm horizontally, or that the object is in the region's box"},
      {"in",
       "inside",
       false,
       {},
       equal,
       "both ask that the object's centre is in the box; of an object that is no region theirs also asks for contact"},
      {"open", "open", false, {}, equal, "of a fixture with several joints theirs asks for any of them"},
      {"close", "closed", false, {}, equal, "of a fixture with several joints theirs asks for all of them"},
      {"turnon",
       "pressed",
       false,
       {},
       weaker,
       "theirs asks that the knob is on now, ours that it has been pressed once"},
      {"turnoff", "pressed", true, {}, stronger, "ours asks that it was never pressed, theirs that it is off now"},
      {"up",
       "lifted",
       false,
       {},
       incomparable,
       "theirs asks for a height of 1 m in the world, ours that the hand holds it and nothing else holds it up"},
  };
  return mapping;
}

BddlMapping default_behavior_mapping() {
  using enum BddlMeaning;
  BddlMapping mapping;
  mapping.dialect = BddlDialect::behavior;
  mapping.domain = "behavior-1k";
  mapping.categories = {{"table.n.02", "work_table"},
                        {"breakfast_table.n.01", "work_table"},
                        {"cabinet.n.01", "chest"},
                        {"chest.n.02", "chest"},
                        {"push_button.n.01", "push_button"},
                        {"floor.n.01", "floor"},
                        {"block.n.01", "cube"},
                        {"mug.n.04", "mug"},
                        {"plate.n.04", "plate"},
                        {"saucepan.n.01", "saucepan"},
                        {"chopping_board.n.01", "chopping_board"},
                        {"umbrella.n.01", "umbrella"},
                        {"tray.n.01", "tray"},
                        {"ashcan.n.01", "bin"},
                        {"agent.n.01", "hand"}};
  mapping.parts = {{"chest", {"bottom_drawer", "middle_drawer", "top_drawer"}}};
  mapping.predicates = {
      {"ontop",
       "on",
       false,
       {},
       stronger,
       "theirs asks for contact and that one is above the other, ours that the contact force carries it"},
      {"onfloor", "on", false, {}, stronger, "as for ontop; in the problems of 2021 only"},
      {"inside",
       "inside",
       false,
       {},
       incomparable,
       "theirs casts rays from the object that must meet the container, ours asks that its centre is in the inner box"},
      {"open",
       "open",
       false,
       {},
       stronger,
       "theirs asks that any joint has moved a small share of its range, ours that this one is open far enough to use"},
      {"open", "closed", true, {}, stronger, "ours asks for shut to within its play, theirs for not open"},
      {"toggled_on",
       "pressed",
       false,
       {},
       weaker,
       "theirs toggles with each press and asks for now, ours that it has been pressed once"},
      {"grasped", "holding", false, {}, equal, "theirs by an attached constraint, ours by friction between the pads"},
  };
  return mapping;
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
