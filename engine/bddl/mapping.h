// Which of our words stand for which of theirs, and how far they mean the same.
#pragma once

#include <array>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "engine/bddl/bddl.h"

namespace stampede {

// Of ours relative to theirs. stronger: whenever ours holds, theirs does; weaker: the other way round.
enum class BddlMeaning { equal, stronger, weaker, incomparable };
std::string_view to_string(BddlMeaning meaning);
BddlMeaning opposite(BddlMeaning meaning);  // that of the negations

struct BddlPredicateRule {
  std::string theirs, ours;
  bool negated = false;    // `ours` stands for `not theirs`; `meaning` is then of ours relative to that
  std::vector<int> order;  // their argument i is our argument order[i]; empty: the same order
  BddlMeaning meaning = BddlMeaning::equal;
  std::string why;       // a sentence on the difference
  bool toggles = false;  // `ours` says that it has changed since the start: of what is on there, the other way round
};

struct BddlPair {
  std::string theirs, ours;
};

// Where imported furniture stands: drawn from these ranges.
struct BddlStand {
  std::array<double, 2> x_m = {0, 0}, y_m = {0, 0};
  double z_m = 0;
};

// All words of both sides come from files (worlds/bddl): none is built in here.
struct BddlMapping {
  BddlDialect dialect = BddlDialect::libero;
  std::string domain;        // robosuite
  std::string problem_name;  // LIBERO: the Python class of the arena; BEHAVIOR: empty, the task's name serves
  // Their category or synset, and our class or type of objects. The first that fits is taken, in either direction.
  std::vector<BddlPair> categories;
  std::map<std::string, std::string> instances;  // LIBERO: category -> the name of the only thing of it
  std::vector<std::string> unsaid;               // our classes that are not written: their arena has them anyway
  std::vector<std::string> unknown;              // categories that their own library of objects lacks
  // LIBERO: sites of fixtures by the end of their name (`top_region`), and our parts (`top_drawer`), for classes that
  // have them in `parts`; ours empty: the fixture itself (`top_side`).
  std::vector<BddlPair> sites;
  // Our class -> its parts with a joint. Of such a thing as a whole, theirs `open` and `in` are any part, `close` all.
  std::map<std::string, std::vector<std::string>> parts;
  // Our class, a predicate of ours, which of its arguments: the parts of which it can be said, where it cannot be said
  // of the whole. In no file: who has the classes fills it in. Of several any will do, of `close` all.
  std::map<std::tuple<std::string, std::string, std::size_t>, std::vector<std::string>> choices;
  std::vector<BddlPredicateRule> predicates;  // the first that fits is taken
  std::string support;                        // ours; with a LIBERO region of a surface it becomes `within` as well
  std::string within;
  std::string hand;                          // BEHAVIOR: what their agent is here
  std::string zone;                          // our class of regions that are made
  std::map<std::string, BddlStand> stands;   // our class -> where it stands
  std::string room;                          // BEHAVIOR: where scene objects stand, unless `rooms` says otherwise
  std::map<std::string, std::string> rooms;  // our class or type -> room

  // The first rule for a literal of theirs (ours) whose counterpart is not negated, else the first rule; or null.
  const BddlPredicateRule* from_theirs(const std::string& predicate, bool negated) const;
  const BddlPredicateRule* from_ours(const std::string& predicate, bool negated) const;
  const std::string* category(const std::string& class_name, const std::string& type) const;  // theirs, or null
  const std::string* class_of(const std::string& category) const;                             // ours, or null
  // Categories of the problem that the mapping does not have, but that we have a class of: they stand for themselves.
  void add_namesakes(const BddlProblem& problem, const std::function<bool(const std::string& class_name)>& is_ours);
};

// Throws Error for predicates that the dialect does not have and orders that are no permutation of its arguments.
// `where`: the file it comes from.
void check_mapping(const BddlMapping& mapping, const std::string& where);

// Where an object is put at the start: in one of the rectangles, in the frame of what it is put on.
struct BddlPlacement {
  std::string object, on;
  std::vector<BddlRectangle> ranges;
  std::array<double, 2> yaw_rad = {0, 0};
  friend bool operator==(const BddlPlacement&, const BddlPlacement&) = default;
};

// How one predicate of a problem was translated.
struct BddlNote {
  std::string theirs, ours;  // with a leading `not ` where the counterpart is negated
  BddlMeaning meaning = BddlMeaning::equal;
  std::string why;
  friend auto operator<=>(const BddlNote&, const BddlNote&) = default;
};
std::string to_text(const BddlNote& note);  // on -> ontop: stronger than theirs: …

}  // namespace stampede
