// Where to put a thing of which a start asks more than one thing: on a table and inside a zone, apart from another, …
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/start/interfaces.h"

namespace stampede {

// What is asked of one free body, its other arguments being placed.
struct PlacementAsked {
  std::string object;
  std::vector<Literal> literals;     // that name it
  std::set<std::string> conditions;  // predicates of these that are only asked of starts
  std::function<void(const Placement&)> put;
  std::function<const WorldView&()> view;  // the world as it is by then
  const CollisionState* state = nullptr;   // likewise
};

// The first of `ways`, of more ways that its literals propose, and of places inside one thing put down on another, that
// meets all that can be tested before anything is simulated. Nothing: none does, or there is nothing to test. The order
// of literals does not matter to whether there is one.
std::optional<Placement> joint_placement(const PlacementAsked& asked, const std::vector<Placement>& ways,
                                         Symbols& symbols, RandomKey key);

}  // namespace stampede
