// How far the arm can take a part, and with which grasps: what starts, skills and predicates ask of a world as it
// stands.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/motion/part_way.h"
#include "engine/start/world_view.h"

namespace stampede {

class CollisionState;
struct GraspCandidate;
struct GraspQuery;
struct Looked;

// Grasps of an object by the arm from where plans start. Lifetime: refers to the world and `space`.
GraspQuery grasp_query(const WorldView& view, const CollisionState& space, const std::string& object, RandomKey key);

// How a part goes, and the positions of its joint at the ends of that way.
struct PartMove {
  PartWay way;
  double from = 0, to = 0;
};

// Grasps of an object, best first, at most `most`. `follow`: only those from which the arm can go with the part the
// whole way; where there are none, those from which it can go 3/4 of it, or 1/2, 1/4, 1/8. Each then says its `reach`.
std::vector<GraspCandidate> grasps_to_go(const GraspQuery& query, int most, const std::optional<PartMove>& follow = {});

// Could the arm, from where it is, take the body or part with two of its grasps at least, nothing in the way, however
// they are drawn? With `before`, a part that it is behind, open. As costly as looking for grasps: some milliseconds.
// `turned_down`: where it cannot, each grasp and what keeps the arm from it are added there, which costs ten times
// that.
bool can_grasp(const WorldView& view, const std::string& object, const std::string& before = {},
               std::vector<Looked>* turned_down = nullptr);
// Could the arm, from where it is, take the part with two of its grasps at least and go with it, nothing in its way,
// towards where its number `to` says, and with one grip after another, from wherever the last one ends, at least as
// far as its number `enough` (by default `to`)? With `before`, a part that the way is behind, open. As costly as
// looking for such grasps: up to a second each where there is none. `turned_down`: as of can_grasp.
bool can_move(const WorldView& view, const std::string& part, const std::string& to, const std::string& before = {},
              const std::string& enough = {}, std::vector<Looked>* turned_down = nullptr);

// How a part moves from where its joint is to where its number `to` says, and is then let go; nothing: it has none.
std::optional<PartMove> part_move_to(const WorldView& view, const std::string& name, const std::string& to);

// How a part goes from where its joint is to `position`, its handle free to turn in the hand by `pivot` rad.
PartWay way_of_part(const WorldView& view, const std::string& name, double position, double pivot);

// Where plans start: the reference, or the arm itself where contact keeps it away from its reference.
JointVector planning_start(const World& world, int robot = 0);

}  // namespace stampede
