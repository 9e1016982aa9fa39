// What the author's own sentences vouch for, gathered once for many candidates.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "scripting/language/reference_parser.h"

namespace stampede {

// What tells variations apart: senses that some variation's sentences have and another's have not.
struct Marks {
  std::set<std::string> telling;
  std::set<std::string> ours;                 // of these, said of this variation
  std::vector<std::vector<std::string>> own;  // by sentence: in the order in which they come true
  std::vector<std::set<std::string>> theirs;  // by variation
};
// Those that a sentence says, the first time that it says each.
// `skip`: words that tell of other things.
std::vector<std::string> marks_in(const Reading& reading, const std::set<std::string>& telling,
                                  const std::set<std::size_t>& skip = {});

struct Claims {
  std::vector<Reading> own;
  std::set<std::string> senses;                              // of all content words
  std::set<std::string> verbs;                               // that begin a stretch
  std::vector<std::set<std::string>> done;                   // by sentence: all verbs of what is to be done
  std::set<std::pair<std::string, std::string>> attributes;  // (red, mark), (wooden, box)
  std::map<std::string, std::set<int>> counts;               // of a noun, and of `noun role`
  std::set<std::vector<std::string>> segments;               // whole stretches, as content
  std::vector<std::set<std::string>> colours;                // by sentence
  std::set<std::pair<std::string, std::string>> places;      // that belong to no noun, with the word before: (the, top)
  bool others = false;                                       // `the other cups` have a part in it
  std::set<std::string> relations, directions;               // behind; up, out
  std::set<std::pair<std::string, std::string>> roles;       // (object put, cube), (to put cube, drawer): see role_key
  std::vector<std::vector<std::string>> numbers;  // by sentence: those that count no thing, with what follows
  std::vector<std::vector<Mention>> wanted;       // by sentence: mentions of wanted things
  Marks marks;
};
Claims claims_of(const Meaning& meaning);

std::set<std::string> verbs_in(const Reading& reading, const std::function<bool(const Segment&)>& skip);

// Where things are put that `on` and `in` do not say: behind, under, beside …
std::set<std::string> relations_in(const Reading& reading);
// What is done, of pairs of opposites: open close, up down, in out, switch_on switch_off, push pull …
// Not of what is to stay as it is: `leave the others shut`.
std::set<std::string> directions_in(const Reading& reading, const std::function<bool(const Segment&)>& skip = {});
// `leave the others alone`, `keep the other two closed`
bool keeps_others(const Reading& reading, const Segment& segment);
// The second number of `two of the three cups`.
std::set<std::size_t> totals_in(const Reading& reading);
// `close the fingers on it`, `open the hand`
bool moves_fingers(const Reading& reading, std::size_t verb);
std::string opposite_of(const std::string& direction);  // empty: none

// Numbers that belong to no noun: `three, then two, then one`.
std::vector<std::string> free_numbers(const Reading& reading, const std::set<std::size_t>& skip = {});

// A mention's role, with what is handled there or what it is a part of.
std::string role_key(const Reading& reading, const Mention& mention);
std::set<std::string> colours_in(const Reading& reading);
std::set<std::pair<std::string, std::string>> free_places(const Reading& reading);

// Any of the things that a mention may be; with `of_kind` one of them is such.
bool may_be(const Mention& mention, const Meaning& meaning, bool SpokenThing::*of_kind);

}  // namespace stampede
