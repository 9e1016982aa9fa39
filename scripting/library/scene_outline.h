// Which things a scene will have, as far as files tell: nothing of it is built here. Room-internal.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scripting/library/draft.h"

namespace stampede {

inline constexpr std::array kMovingJoints{"slider", "hinge", "screw"};

struct OutlinedThing {
  std::string type;
  std::vector<std::string> traits;
  bool free = false;        // must be placed
  bool positioned = false;  // its entry says where it is
  bool known = true;        // its file has been read
};

struct SceneOutline {
  std::string hand;  // `panda.hand`
  std::map<std::string, OutlinedThing> things;
  std::map<std::string, std::vector<std::string>> groups = {};  // `block*`: its members

  // With its parts (name.part) and regions (name.region, name.part.region).
  void add(const std::string& name, const Value& entry, const LibraryDraft& draft);
};

// Of a world, without what a task adds.
SceneOutline outline_of(const std::string& world, const LibraryDraft& draft);
std::string hand_of(const std::string& world, const LibraryDraft& draft);

// What an object's file names within it: `lid`, `lid.top`, `tip`.
std::vector<std::string> things_in(const Value& object);

}  // namespace stampede
