#include <algorithm>

#include "engine/bddl/goal.h"
#include "engine/bddl/words.h"
#include "engine/symbolic/pddl_formula.h"
#include "engine/symbolic/pddl_text.h"
#include "engine/symbolic/pddl_tokens.h"

namespace stampede {
namespace symbolic {
namespace {

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "`" : " ") + name;
  return text + "`";
}

class ProblemReader {
 public:
  explicit ProblemReader(const Node& top) : top_(top) {}

  BddlReading run() {
    if (top_.head() != "define") fail(top_, "a BDDL problem begins with (define (problem NAME) …)");
    read_heading();
    for (std::size_t i = 1; i < top_.items.size(); ++i) read_names(top_.items[i]);
    drop_dangling_regions();
    const BddlScope scope(problem());
    if (const auto bad = scope.declarations()) fail(top_, bad->what, bad->hint);
    for (std::size_t i = 1; i < top_.items.size(); ++i) read_atoms(top_.items[i], scope);
    if (problem().goal.empty()) fail(top_, "there is no (:goal …)", "without one the task has no end");
    check_wildcards();
    return std::move(reading_);
  }

 private:
  BddlProblem& problem() { return reading_.problem; }
  void warn(const Node& node, const std::string& what) {
    reading_.warnings.push_back(std::string(node.place) + ": " + what);
  }
  bool libero() { return problem().dialect == BddlDialect::libero; }

  const Node* only(const char* head) {
    const Node* found = nullptr;
    for (const Node& section : top_.items) {
      if (section.head() != head) continue;
      if (found != nullptr) fail(section, std::string("a second (") + head + " …)", "keep one");
      if (section.items.size() != 2) fail(section, std::string("(") + head + " …) takes one name");
      found = &section;
    }
    if (found == nullptr) fail(top_, std::string("there is no (") + head + " …)", "add it after `define`");
    return found;
  }

  void read_heading() {
    for (std::size_t i = 1; i < top_.items.size(); ++i) {
      if (top_.items[i].head().empty()) fail(top_.items[i], "expected a section such as (:objects …)");
    }
    problem().name = bddl_word(only("problem")->items[1], "the problem's name");
    const Node& domain = only(":domain")->items[1];
    problem().domain = bddl_word(domain, "the domain's name");
    const std::vector<std::string> behavior = {"igibson", "omnigibson", "behavior-1k"};
    if (problem().domain == "robosuite") {
      problem().dialect = BddlDialect::libero;
    } else if (std::find(behavior.begin(), behavior.end(), problem().domain) != behavior.end()) {
      problem().dialect = BddlDialect::behavior;
    } else {
      fail(domain, "the domain `" + problem().domain + "` belongs to no known dialect",
           "LIBERO's is robosuite; BEHAVIOR's are igibson, omnigibson, behavior-1k");
    }
  }

  void read_names(const Node& section) {
    const std::string& head = section.head();
    if (head == ":objects") read_groups(section, problem().objects);
    if (!libero()) return;
    if (head == ":fixtures") read_groups(section, problem().fixtures);
    if (head == ":regions") read_regions(section);
    if (head == ":language") read_language(section);
    if (head == ":scene_properties") {
      if (section.items.size() > 1) {
        fail(section, ":scene_properties makes LIBERO's parser raise NameError", "remove the section");
      }
      warn(section, "an empty :scene_properties is left out");
    }
  }

  void read_groups(const Node& section, std::vector<BddlGroup>& groups) {
    std::vector<std::string> names, before;
    for (const BddlGroup& group : groups) before.push_back(group.category);
    for (std::size_t i = 1; i < section.items.size(); ++i) {
      const std::string& word = bddl_word(section.items[i], "a name");
      if (word != "-") {
        names.push_back(word);
        continue;
      }
      if (i + 1 == section.items.size()) fail(section.items[i], "a type must follow `-`");
      if (names.empty()) fail(section.items[i], "no object stands before `-`", "write `cup_1 cup_2 - cup`");
      const Node& type = section.items[++i];
      add_group(type, bddl_word(type, "a type"), names, before, groups);
      names.clear();
    }
    if (!names.empty()) {
      fail(section, quoted_list(names) + " without a type", "write `" + names.back() + " - TYPE`");
    }
  }

  void add_group(const Node& place, const std::string& type, const std::vector<std::string>& names,
                 const std::vector<std::string>& of_earlier_section, std::vector<BddlGroup>& groups) {
    const auto found =
        std::find_if(groups.begin(), groups.end(), [&](const BddlGroup& g) { return g.category == type; });
    if (!libero()) check_instances(place, type, names);
    if (found == groups.end()) {
      groups.push_back({type, names});
      return;
    }
    // Sections are consumed backwards and lines forwards, so which one survives depends on where the second is.
    const bool earlier =
        std::find(of_earlier_section.begin(), of_earlier_section.end(), type) != of_earlier_section.end();
    warn(place, "a second line of the type `" + type + "` is joined to the first; their parser would keep only " +
                    quoted_list(earlier ? found->names : names));
    found->names.insert(found->names.end(), names.begin(), names.end());
  }

  void check_instances(const Node& place, const std::string& type, const std::vector<std::string>& names) {
    for (const std::string& name : names) {
      if (is_instance_of(name, type)) continue;
      warn(place, "`" + name + "` is not `" + type + "_` and a number: BEHAVIOR's linter refuses it");
    }
  }

  void read_language(const Node& section) {
    if (!problem().language.empty()) {
      warn(section, "a second :language is left out, as their parser does");
      return;
    }
    for (std::size_t i = 1; i < section.items.size(); ++i) {
      if (section.items[i].is_list) fail(section.items[i], "parentheses in :language", "write plain words");
      problem().language += (i > 1 ? " " : "") + section.items[i].word;
    }
  }

  void read_regions(const Node& section) {
    for (std::size_t i = 1; i < section.items.size(); ++i) {
      const Node& node = section.items[i];
      if (node.head().empty()) fail(node, "expected (NAME (:target OBJECT) …)");
      BddlRegion region;
      region.name = node.head();
      for (std::size_t k = 1; k < node.items.size(); ++k) read_attribute(node.items[k], region);
      if (region.target.empty()) {
        fail(node, "the region `" + region.name + "` has no (:target OBJECT)", "name what it belongs to");
      }
      problem().regions.push_back(region);
    }
  }

  // Files that LIBERO ships have regions of objects that are not there.
  void drop_dangling_regions() {
    std::set<std::string> things;
    for (const auto* groups : {&problem().fixtures, &problem().objects}) {
      for (const BddlGroup& group : *groups) things.insert(group.names.begin(), group.names.end());
    }
    std::erase_if(problem().regions, [&](const BddlRegion& region) {
      if (things.count(region.target) > 0) return false;
      warn(top_, "the region `" + region.key() + "` is left out: its :target is not declared (" +
                     did_you_mean(region.target, {things.begin(), things.end()}) + ")");
      return true;
    });
  }

  void read_attribute(const Node& node, BddlRegion& region) {
    const std::string& head = node.head();
    const std::vector<std::string> known = {":target", ":ranges", ":yaw_rotation", ":rgba"};
    if (std::find(known.begin(), known.end(), head) == known.end()) {
      fail(node, "a region has no attribute `" + head + "`", did_you_mean(head, known));
    }
    if (node.items.size() != 2) fail(node, "(" + head + " …) takes one value");
    const Node& value = node.items[1];
    if (head == ":target") {
      region.target = bddl_word(value, "the name of an object");
    } else if (head == ":rgba") {
      const std::vector<double> rgba = read_bddl_numbers(value, 4, ":rgba");
      std::copy(rgba.begin(), rgba.end(), region.rgba.begin());
    } else if (!value.is_list) {
      fail(value, "(" + head + " …) takes a list of lists of numbers");
    } else if (head == ":ranges") {
      for (const Node& item : value.items) {
        const std::vector<double> r = read_bddl_numbers(item, 4, "a rectangle");
        region.ranges.push_back({r[0], r[1], r[2], r[3]});
        if (r[0] > r[2] || r[1] > r[3]) warn(item, "the rectangle's least corner is not before its greatest");
      }
    } else {
      if (value.items.size() > 1) warn(value, "of several yaw ranges their parser keeps the last");
      for (const Node& item : value.items) {
        const std::vector<double> yaw = read_bddl_numbers(item, 2, ":yaw_rotation");
        region.yaw_rad = {yaw[0], yaw[1]};
      }
    }
  }

  void read_atoms(const Node& section, const BddlScope& scope) {
    const std::string& head = section.head();
    static const std::set<std::string> kShared = {"problem", ":domain", ":objects", ":requirements"};
    static const std::set<std::string> kLibero = {":fixtures", ":regions", ":language", ":scene_properties"};
    if (kShared.count(head) > 0 || (libero() && kLibero.count(head) > 0)) return;
    if (head == ":init") {
      read_init(section, scope);
    } else if (head == ":goal") {
      if (!problem().goal.empty()) warn(section, "a second :goal is joined to the first, as their parser does");
      const std::vector<BddlFormula> parts = read_bddl_goal(section, scope, problem().dialect);
      problem().goal.insert(problem().goal.end(), parts.begin(), parts.end());
    } else if (libero() && head == ":obj_of_interest") {
      for (std::size_t i = 1; i < section.items.size(); ++i) {
        const std::string& name = bddl_word(section.items[i], "a name");
        if (const auto bad = scope.name(name)) fail(section.items[i], bad->what, bad->hint);
        problem().interest.push_back(name);
      }
    } else {
      warn(section, "the section `" + head + "` is unknown and left out, as their parser does");
    }
  }

  void read_init(const Node& section, const BddlScope& scope) {
    if (seen_init_) {
      warn(section, "a second :init is joined to the first; their parser would drop this one");
    }
    seen_init_ = true;
    for (std::size_t i = 1; i < section.items.size(); ++i) {
      const Node& node = section.items[i];
      BddlLiteral literal;
      literal.negated = node.head() == "not";
      if (literal.negated && node.items.size() != 2) fail(node, "`not` takes one atom");
      literal.atom = read_bddl_fact(literal.negated ? node.items[1] : node);
      if (const auto bad = scope.literal(literal)) fail(node, bad->what, bad->hint);
      if (literal.atom.predicate == "inroom" && !is_bddl_room(literal.atom.arguments[1])) {
        warn(node, "`" + literal.atom.arguments[1] + "` is not among the rooms of BEHAVIOR-1K");
      }
      const auto [known, fresh] = value_.emplace(literal.atom, literal.negated);
      if (!fresh && known->second != literal.negated) {
        fail(node, to_text(literal.atom) + " is both true and false in :init", "keep one of the two");
      }
      problem().init.push_back(literal);
    }
  }

  void check_wildcards() {
    try {
      check_bddl(problem());
    } catch (const Error& error) {
      fail(top_, error.message(), error.hint());
    }
  }

  const Node& top_;
  BddlReading reading_;
  bool seen_init_ = false;
  std::map<Fact, bool> value_;  // of the literals of :init: negated
};

}  // namespace
}  // namespace symbolic

BddlReading read_bddl(std::string_view text, const std::string& file) {
  return symbolic::ProblemReader(symbolic::parse_list(text, file)).run();
}

}  // namespace stampede
