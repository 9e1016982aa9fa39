// What sentences say, and what the author's own vouch for, gathered once for many candidates.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "engine/language/reading.h"

namespace stampede {

using Texts = std::set<std::string>;

// What tells variations apart: senses that some variation's sentences have and another's have not.
struct Marks {
  Texts telling;
  Texts ours;                                 // of these, said of this variation
  std::vector<std::vector<std::string>> own;  // by sentence: in the order in which they come true
  std::vector<Texts> theirs;                  // by variation
};
// Those that a sentence says, the first time that it says each; `skip`: words that tell of other things.
std::vector<std::string> marks_in(const Reading& reading, const Texts& telling, const std::set<std::size_t>& skip = {});

struct Claims {
  std::vector<Reading> own;
  Texts senses;                                              // of all content words
  Texts verbs;                                               // that begin a stretch
  std::vector<Texts> done;                                   // by sentence: all verbs of what is to be done
  std::set<std::pair<std::string, std::string>> attributes;  // (red, mark), (wooden, box)
  std::map<std::string, std::set<int>> counts;               // of a noun, and of `noun role`
  std::set<std::vector<std::string>> segments;               // whole stretches, as content
  std::vector<Texts> colours;                                // by sentence
  std::set<std::pair<std::string, std::string>> places;      // that belong to no noun, with the word before: (the, top)
  bool others = false;                                       // `the other cups` have a part in it
  Texts directions;                                          // up, out
  std::set<std::pair<std::string, std::string>> roles;       // (object put, cube), (to put cube, drawer): see role_key
  std::vector<std::vector<std::string>> numbers;  // by sentence: those that count no thing, with what follows
  Marks marks;
};
Claims claims_of(const Meaning& meaning);

// The verbs of what is to be done, those of any stretch that `skip` is true of left out.
using SegmentTest = std::function<bool(const Segment&)>;
Texts verbs_in(const Reading& reading, const SegmentTest& skip);

Texts colours_in(const Reading& reading);
// What is done, of pairs of opposites: open close, up down, in out, switch_on switch_off, push pull …
Texts directions_in(const Reading& reading, const English& english, const SegmentTest& skip = {});
// `leave the others alone`, `keep the other two closed`
bool keeps_others(const Reading& reading, const Segment& segment);
// The second number of `two of the three cups`.
std::set<std::size_t> totals_in(const Reading& reading);
// `close the fingers on it`, `open the hand`
bool moves_fingers(const Reading& reading, std::size_t verb);
// Numbers that belong to no noun: `three, then two, then one`; with the noun that follows.
std::vector<std::string> free_numbers(const Reading& reading, const std::set<std::size_t>& skip = {});
// A mention's role, with what is handled there or what it is a part of.
std::string role_key(const Reading& reading, const Mention& mention);
std::set<std::pair<std::string, std::string>> free_places(const Reading& reading);

}  // namespace stampede
