// How a hand goes with the part of a mechanism that it holds: a drawer along its slides, a door around its hinge.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "engine/base/random.h"
#include "engine/sim/collision_state.h"

namespace stampede {

// What the part does, all in the world's frame.
struct PartWay {
  PartRef part;
  std::function<Transform(double)> moved;  // by what motion the part has left its place, at a share 0 … 1 of its way
  Transform before = Transform::Identity();  // by what motion it got to that place from where the world has it
  Vector3 axis = Vector3::UnitZ();           // it turns about, a unit vector
  double turn = 0;                           // rad about the axis in all; 0: it slides
  double opening = 0;                        // m, of the hand that holds it
  double retreat = 0;                        // m that the hand must be able to go straight back at the end
  double stop = 1;                           // share at which the part meets its stop: on from there it is pressed
  double pivot = 0;                          // rad either way that a handle may turn in the hand, about the axis
};

struct ArmWay {
  std::function<Transform(double)> world_from_tip;  // at a share: with the part and, within `pivot`, turned against it
  std::vector<JointVector> arm;                     // at equal shares, near to where it is then; the first: the start
  double reach = 1;                                 // share of the part's way that this is; shares above are of it
};

// A way that the arm can follow from `start`, where the hand holds the part, without a jump and with nothing touched
// but what `state` allows and the shapes of the part that are in the hand; the part is where it is by then. What the
// hand touches beyond the part's stop does not count. Dynamic programming over the turn of the handle in the hand, or,
// where it cannot turn, of the elbow: the least motion of the joints. Result: nothing when there is none. Repeatable.
std::optional<ArmWay> way_with_part(const CollisionState& state, const JointVector& start, const PartWay& way,
                                    RandomKey key);
// Whether there is one: sooner known than the best.
bool can_go_with_part(const CollisionState& state, const JointVector& start, const PartWay& way, RandomKey key);
// The same as far as it goes: to the end, or to where the arm cannot follow. Nothing: not even a little.
std::optional<ArmWay> furthest_with_part(const CollisionState& state, const JointVector& start, const PartWay& way,
                                         RandomKey key);

// Would the arm at `q` touch anything there, once the part is at the end of its way? What way_with_part leaves out does
// not count here either.
bool free_at_end(const CollisionState& state, const JointVector& start, const PartWay& way, const JointVector& q);

// A part and all whose joints hang on it: a door and its lever.
std::vector<PartRef> with_mounted(const Scene& scene, PartRef part);

// What is left of a way after `share` of it.
PartWay rest_of(const PartWay& way, double share);
// The first `share` of a way.
PartWay first_of(const PartWay& way, double share);
ArmWay first_of(const ArmWay& way, double share);

}  // namespace stampede
