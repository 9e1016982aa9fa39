// All that questions about contact share: the shapes of a scene and which of them count. Immutable. Room-internal.
#pragma once

#include <memory>
#include <vector>

#include "engine/model/kinematics.h"
#include "engine/model/part_ref.h"
#include "engine/sim/convex.h"

namespace stampede {

struct CollisionModel {
  explicit CollisionModel(std::shared_ptr<const Scene> scene);

  struct Piece {  // one convex shape of a part
    Convex convex;
    PartRef part;
    Transform part_from_shape;
  };
  struct Range {
    std::size_t begin = 0, end = 0;
  };

  std::shared_ptr<const Scene> scene;
  Arm arm;
  std::vector<Piece> robot;         // in part order
  std::vector<Range> robot_parts;   // pieces of each part
  std::vector<bool> moved, hand;    // per robot part: moves with the arm; behind its last joint
  std::vector<bool> grips;          // per robot part: a finger, or of a hand that has none any part
  std::vector<int> held_partners;   // robot parts that a held body is tested against
  std::vector<int> joints;          // per robot part: how many of the arm's joints move it
  std::vector<Piece> bodies;        // of all bodies but the robot, in body and part order
  std::vector<Range> body_pieces;   // pieces of each body
  std::vector<std::size_t> part_0;  // per body: where its parts begin among those of all bodies
};

}  // namespace stampede
