#include "engine/sim/depth.h"

#include <BulletCollision/NarrowPhaseCollision/btGjkEpa2.h>
#include <btBulletCollisionCommon.h>

#include <algorithm>

#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

// A shape of ours in Bullet's clothes, its rounding included.
class Worn final : public btConvexInternalShape {
 public:
  explicit Worn(const Convex& convex) : convex_(convex) {
    m_shapeType = CUSTOM_CONVEX_SHAPE_TYPE;
    setMargin(0);
  }
  btVector3 localGetSupportingVertexWithoutMargin(const btVector3& direction) const override {
    const Vector3 d = from_bullet(direction);
    const double length = d.norm();
    return to_bullet(Vector3(convex_.support(d) + (length > 0 ? convex_.rounding / length : 0) * d));
  }
  void batchedUnitVectorGetSupportingVertexWithoutMargin(const btVector3* directions, btVector3* vertices,
                                                         int count) const override {
    for (int i = 0; i < count; ++i) vertices[i] = localGetSupportingVertexWithoutMargin(directions[i]);
  }
  void calculateLocalInertia(btScalar, btVector3&) const override {}
  const char* getName() const override { return "worn"; }

 private:
  const Convex& convex_;
};

}  // namespace

double depth_between(const Convex& a, const Transform& world_from_a, const Convex& b, const Transform& world_from_b) {
  const Worn one(a), other(b);
  const Vector3 between = world_from_b * b.box_centre - world_from_a * a.box_centre;
  const Vector3 guess = between.norm() > 1e-9 ? between : Vector3::UnitX();
  // Along any direction the overlap is an upper bound; the axes of boxes and cylinders give the bounds that matter.
  const auto along = [&](const Vector3& direction) {
    const Vector3 d = direction.normalized(), da = world_from_a.linear().transpose() * d,
                  db = world_from_b.linear().transpose() * d;
    return (world_from_a * a.support(da)).dot(d) - (world_from_b * b.support(Vector3(-db))).dot(d) + a.rounding +
           b.rounding;
  };
  double least = along(guess);
  for (const Transform& axes : {world_from_a, world_from_b})
    for (int axis = 0; axis < 3; ++axis) {
      const Vector3 direction = axes.linear().col(axis);
      least = std::min({least, along(direction), along(-direction)});
    }
  if (least <= 0) return 0;
  btGjkEpaSolver2::sResults results;
  if (btGjkEpaSolver2::Penetration(&one, to_bullet(world_from_a), &other, to_bullet(world_from_b), to_bullet(guess),
                                   results)) {
    // Its distance may be far too little, as of thin boxes upon one plane; along its normal the bound is sure.
    const Vector3 normal = world_from_a.linear() * from_bullet(results.normal);  // it tells it in a's frame
    if (normal.norm() < 0.5) return least;
    return std::max(0.0, std::min({least, along(normal), along(-normal)}));
  }
  return closer_than(a, world_from_a, b, world_from_b, 0) ? least : 0;
}

}  // namespace stampede
