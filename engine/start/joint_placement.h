// Where to put a thing of which a start asks more than one thing: on a table and inside a zone, apart from another, in
// reach, …
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "engine/start/predicates.h"
#include "engine/start/task.h"
#include "engine/start/world_view.h"

namespace stampede {

class CollisionState;

// What is asked of one free body, its other arguments being placed.
struct PlacementAsked {
  std::string object;
  std::vector<Literal> literals;     // that name it
  std::set<std::string> conditions;  // predicates of these that are only asked of starts
  std::function<void(const Placement&)> put;
  std::function<const WorldView&()> view;  // the world as it is by then
  const CollisionState* state = nullptr;   // likewise
};

// A place that meets all that can be tested before anything is simulated; or else what most places failed of.
struct JointPlacement {
  std::optional<Placement> way;
  std::optional<Literal> unmet;  // nothing: a way was found, or there is nothing to test, or nowhere to test it
  std::optional<Placement> at;   // the last place that met all that was tested before this
};

// Conditions that ask what the arm can do, which takes long.
struct ArmQuestions {
  std::set<std::string> predicates;  // as they are seen to
  int in_vain = 0;                   // places of which they were asked in vain since they last held
};

// The first of `ways`, which were sampled for `first`, of more ways that its literals propose, those of small places
// before those of what it only rests on, and of places inside one thing put down on another. The order of literals does
// not matter to whether there is one. Of each place the arm is asked last, and only so often: where that was in vain
// all along, once.
JointPlacement joint_placement(const PlacementAsked& asked, const Literal& first, const std::vector<Placement>& ways,
                               Symbols& symbols, RandomKey key, ArmQuestions& questions);

// Does its foot come to the top of the other one, its middle above it?
bool comes_to_rest_on(const WorldView& view, const std::string& thing, const std::string& below);

}  // namespace stampede
