// Streams of grasps and placements: candidate k is a pure function of the key and k.
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/motion/looked.h"
#include "engine/motion/part_way.h"
#include "engine/motion/planner.h"
#include "engine/motion/targets.h"

namespace stampede {

// What grasps are sought for: an object, by an arm that is at `start`.
// Lifetime: refers to all but the start.
struct GraspQuery {
  const CollisionState& state;  // may hold nothing; the object itself is allowed to be touched
  const World& world;
  const Object& object;
  JointVector start;
  RandomKey key;
  std::function<bool(const GraspCandidate&)> wanted = {};  // others are skipped; empty: all
};

// Antipodal grasps of a part's shapes (parallel faces of boxes, diameters of round shapes, opposed facets of hulls)
// or the object's authored ones, in an order shuffled by key but top-down and centred ones first; those with no IK
// or whose hand touches something at grasp or approach are skipped. Result: at most `most`, empty: no_grasp.
// `follow`: how the part that is held moves then; grasps from which the arm cannot go with it are skipped too.
std::vector<GraspCandidate> grasp_candidates(const GraspQuery& query, int most,
                                             const std::optional<PartWay>& follow = {});

// What became of each grasp that would be tried, for people. As costly as looking for one; with `measure` also how near
// the first of them came, which costs ten times as much.
std::vector<Looked> look_at_grasps(const GraspQuery& query, bool measure);
// Of how many grasps each cause keeps the hand: `of 72 grasps the best: 12 touch pot; others: 60 out of reach`.
std::string why_no_grasp(std::span<const Looked> grasps);

// A level rectangle about its middle, whatever the height: m.
struct SpotWindow {
  Transform world_from_middle = Transform::Identity();
  double half_x = 0, half_y = 0;
  bool contains(const Transform& place) const {
    const Vector3 at = world_from_middle.inverse() * place.translation();
    return std::abs(at.x()) <= half_x && std::abs(at.y()) <= half_y;
  }
};

// What places are sought for: a free body, at most so many of them.
// Lifetime: refers to state, world and object.
struct SpotQuery {
  const CollisionState& state;
  const World& world;
  const Object& object;
  RandomKey key;
  int most;
  std::vector<Looked>* turned_down = nullptr;  // where somebody asks why: what was drawn and cannot be is added there
  std::optional<SpotWindow> within = {};       // free_spots: of the body's frame
};

// Places where a free body fits on top of a surface part: uniformly over the upper faces of its shapes, upright with
// random yaw, `margin` from the edge, free of all other bodies. Poses are of the body.
std::vector<Transform> free_spots(const SpotQuery& query, const Object& surface);
// The same inside a region's box (resting on its lower face, or anywhere within when `floating`).
std::vector<Transform> region_spots(const SpotQuery& query, const Region& region);
// The one pose on top of another object, centred, with a yaw symmetric to it (stacking).
std::vector<Transform> stack_spots(const SpotQuery& query, const Object& below);

// Pose of an object (body, part or region centre) in the world.
Transform world_from_object(const World& world, const Object& object);

}  // namespace stampede
