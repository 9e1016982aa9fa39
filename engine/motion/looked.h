// Grasps and places that were looked at, and what kept them from being used: collected only for people who ask why.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/geometry/transform.h"
#include "engine/model/kinematics.h"
#include "engine/model/part_ref.h"
#include "engine/model/scene.h"

namespace stampede {

class CollisionState;

struct Looked {
  // crowded: it would leave no room for a hand beside it. no_way: both ends are free, what is between is not.
  // no_follow: the arm could hold the part, but not go with it as far as it must.
  enum class Fate { usable, touches, out_of_reach, no_way, no_room, crowded, no_follow };
  Fate fate = Fate::usable;
  Transform pose = Transform::Identity();  // of a grasp, world_from_tip; of a place, world_from_body
  double opening = 0;                      // of a grasp's hand, m
  bool best = true;                        // of a grasp: among the first that would be taken
  bool approach = false;                   // it is so on the approach
  std::string touched = {};                // touches: what
  double missed_m = -1;   // touches, out_of_reach: moved by this it would do; else what is too wide. Negative: unknown
  double missed_rad = 0;  // out_of_reach: instead, how far `joint` would have to go beyond its limit
  std::string joint = {};
};

std::string cause_of(const Looked& looked);   // of many, for counts: `touch pot`, `out of reach on the approach`
std::string miss_of(const Looked& looked);    // `touches pot by 2 mm`, `0.40 rad beyond panda_joint6's limit`
std::string amount_of(const Looked& looked);  // `2 mm`, `0.40 rad beyond panda_joint6's limit`; empty: not measured
// The one that came closest to being usable, a radian taken for 0.3 m; null: nobody knows.
const Looked* nearest_miss(std::span<const Looked> looked);
// Of those that cannot be, and of these of the best where there are such: the nearest miss of the commonest cause, the
// first of it where none was measured; null: there is none.
const Looked* commonest_miss(std::span<const Looked> looked);

// Counts by cause, most frequent first: `12 out of reach, 3 touch chest.top_drawer`.
class Causes {
 public:
  void add(const std::string& cause, int times = 1) { counts_[cause] += times; }
  bool empty() const { return counts_.empty(); }
  std::string text() const;

 private:
  std::map<std::string, int> counts_;
};
Causes causes_of(std::span<const Looked> looked);

// What the arm touches in all of these configurations, in the first: its name, or nothing where one of them is free.
std::string touched_in_all(const CollisionState& state, const std::vector<JointVector>& configurations);
// What people call a part: `chest.top_drawer`, `panda.link5`.
std::string name_of_part(const Scene& scene, PartRef part);

// The least way along one of the directions (unit vectors, world) that makes a pose free, to a millimetre; negative:
// 64 mm are not enough.
double way_to_free(const Transform& pose, std::span<const Vector3> directions,
                   const std::function<bool(const Transform&)>& free);
const std::vector<Vector3>& level_directions();
// What is missing of a pose of the tip that is out of reach: what Arm::shortfall, which is costly, says of it.
void note_shortfall(const std::optional<Shortfall>& missing, const Robot& robot, Looked& looked);

}  // namespace stampede
