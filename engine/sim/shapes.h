// Shapes of the model as Bullet's collision shapes.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "engine/model/scene.h"

namespace stampede {

// Owns every Bullet shape of a world; they are freed after the bodies that use them.
struct ShapeStore {
  // m, around the boxes along the axes around shapes. Bullet forgets where two children of compounds touch as soon as
  // these do not: a steady grasp would lose all its points when it comes to lie along an axis with a hair's breadth
  // between pad and thing.
  static constexpr double kRoom = 0.001;
  double room = kRoom;
  std::vector<std::unique_ptr<btCollisionShape>> shapes;
};

// One shape for all colliding shapes of a part, in the frame of its link. A lone shape that needs no transform is
// used bare: Bullet's compounds cost time. Lifetime: the store's.
btCollisionShape* make_part_shape(const Part& part, const Transform& link_from_part, ShapeStore& store);

bool has_collision(const Part& part);

// Of a shape made here, or of the thinnest of its pieces, m: what lies half as deep in it may be nearer its other side.
// Of hulls and cones it is a lower bound.
double least_thickness(const btCollisionShape& shape);

}  // namespace stampede
