// What sentences say, and what the author's own vouch for, gathered once for many candidates.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/language/reading.h"

namespace stampede {

using Texts = std::set<std::string>;

struct Claims {
  std::vector<Reading> own;
  Texts senses;                                              // of all words that tell something
  std::set<std::pair<std::string, std::string>> attributes;  // (red, mark), (wooden, box)
  std::map<std::string, std::set<int>> counts;               // of a noun, and of `noun role`
  std::set<std::vector<std::string>> segments;               // whole stretches, as content
  bool others = false;                                       // `the other cups` have a part in it
  Texts directions;                                          // up, out
  std::set<std::pair<std::string, std::string>> roles;       // (object put, cube), (to put cube, drawer): see role_key
  std::vector<Texts> elsewhere;                              // senses, by other variation
  Texts marks;                                               // those that some variation has, and another has not
};
Claims claims_of(const Meaning& meaning);

// What tells variations apart, as far as a sentence says it: the first time that it says each, in the order in which
// things come true; `skip`: words that tell of other things.
std::vector<std::string> marks_in(const Reading& reading, const Texts& marks, const std::set<std::size_t>& skip);
Texts verbs_in(const Reading& reading);  // of what is to be done
Texts colours_in(const Reading& reading);
// What is done, of pairs of opposites: open close, up down, in out, switch_on switch_off, push pull …
Texts directions_in(const Reading& reading, const Segment& segment, const English& english);
// `leave the others alone`, `keep the other two closed`
bool keeps_others(const Reading& reading, const Segment& segment);
// Numbers that belong to no noun: `three, then two, then one`.
std::vector<std::string> free_numbers(const Reading& reading, const std::set<std::size_t>& skip);
// A mention's role, with what is handled there or what it is a part of.
std::string role_key(const Reading& reading, const Mention& mention);
std::set<std::pair<std::string, std::string>> free_places(const Reading& reading);

}  // namespace stampede
