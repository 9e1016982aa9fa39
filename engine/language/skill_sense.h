// What a skill does with its arguments, as sentences tell it: read once from its effects, its label and `moves`.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "engine/language/lexicon.h"
#include "engine/start/declared.h"

namespace stampede {

struct SkillSense {
  bool takes = false, puts = false;  // what it is about is in the hand then, or no longer
  bool raises = false;               // it ends in the air
  bool of_parts = false;             // it may be about a part of what is named: open the fridge
  int handled = 0;                   // the parameter that it is about
  int tool = -1;                     // that it handles it with: held before and after, or put down to serve
  std::set<int> moved, places;
  std::string verb;                           // the sense of its first
  std::map<int, std::set<std::string>> ways;  // how sentences say that it is at a parameter's place: in, on
  bool leaves = false;                        // it is taken out of something, or off it
  std::set<std::string> directions;           // in which something moves: up, out, open …
};

// Of the skill's first action. `held`: predicates of what the pads grasp.
SkillSense skill_sense(const SkillInfo& skill, const Domain& domain, const std::set<std::string>& held,
                       std::shared_ptr<const English> english);

}  // namespace stampede
