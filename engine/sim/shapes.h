// Shapes of the model as Bullet's collision shapes.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "engine/model/scene.h"

namespace stampede {

// Owns every Bullet shape of a world; they are freed after the bodies that use them.
using ShapeStore = std::vector<std::unique_ptr<btCollisionShape>>;

// One shape for all colliding shapes of a part, in the frame of its link. A lone shape that needs no transform is
// used bare: Bullet's compounds cost time. Lifetime: the store's.
btCollisionShape* make_part_shape(const Part& part, const Transform& link_from_part, ShapeStore& store);

bool has_collision(const Part& part);

}  // namespace stampede
