#include "engine/sim/shapes.h"

#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <LinearMath/btConvexHullComputer.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/error.h"
#include "engine/sim/bullet_convert.h"

namespace stampede {
namespace {

constexpr double kHullMargin = 0.001;    // m
constexpr double kBoxMargin = 0.0015;    // m, at most
constexpr double kMarginOfInside = 0.2;  // of the greatest ball inside: thin hulls keep their shape
constexpr double kMarginOfThickness = kMarginOfInside / 2;
constexpr double kNoRotation = 1e-12;

template <typename S>
struct Roomy final : S {
  template <typename... Arguments>
  explicit Roomy(const double& room, Arguments&&... arguments)
      : S(std::forward<Arguments>(arguments)...), room_(room) {}
  void getAabb(const btTransform& pose, btVector3& lower, btVector3& upper) const override {
    S::getAabb(pose, lower, upper);
    const btVector3 room(room_, room_, room_);
    lower -= room;
    upper += room;
  }

 private:
  const double& room_;  // the store's
};

template <typename S, typename... Arguments>
S* keep(ShapeStore& store, Arguments&&... arguments) {
  auto shape = std::make_unique<S>(std::forward<Arguments>(arguments)...);
  S* result = shape.get();
  store.shapes.push_back(std::move(shape));
  return result;
}

template <typename S, typename... Arguments>
Roomy<S>* keep_roomy(ShapeStore& store, Arguments&&... arguments) {
  return keep<Roomy<S>>(store, store.room, std::forward<Arguments>(arguments)...);
}

// Bullet adds a hull's margin outside its points, so the faces are first moved inwards by as much; without this,
// bodies that should just touch start in penetration and stacks burst.
btCollisionShape* make_hull(const std::vector<Vector3>& points, const Transform& link_from_shape, ShapeStore& store) {
  std::vector<btVector3> moved;
  for (const Vector3& point : points) moved.push_back(to_bullet(Vector3(link_from_shape * point)));
  btConvexHullComputer computer;
  const btScalar shrunk =
      computer.compute(&moved[0].x(), sizeof(btVector3), static_cast<int>(moved.size()), kHullMargin, kMarginOfInside);
  auto* hull = keep_roomy<btConvexHullShape>(store);
  if (shrunk < 0 || computer.vertices.size() < 4) {  // flat: Bullet's hull code cannot shrink it
    for (const btVector3& point : moved) hull->addPoint(point, false);
    hull->setMargin(1e-4);
  } else {
    for (int i = 0; i < computer.vertices.size(); ++i) hull->addPoint(computer.vertices[i], false);
    hull->setMargin(shrunk);
  }
  hull->recalcLocalAabb();
  return hull;
}

// Bullet's cone wears its margin outside too: the cone inside it at that distance, and how far its centre moves.
btCollisionShape* make_cone(const Shape& shape, ShapeStore& store, Transform& link_from_shape) {
  const double margin = std::min(kHullMargin, kMarginOfThickness * std::min(shape.radius, shape.length));
  const double sine = shape.radius / std::hypot(shape.radius, shape.length);
  const double length = shape.length - margin - margin / sine;
  auto* cone = keep_roomy<btConeShapeZ>(store, shape.radius * length / shape.length, length);
  cone->setMargin(margin);
  link_from_shape = link_from_shape * translation(0, 0, -shape.length / 2 + margin + length / 2);
  return cone;
}

// Bullet rounds a box's edges by a tenth of its least half size, where it has no better way than GJK: a handle would be
// a millimetre inside the back of a hand before they touch.
btCollisionShape* make_box(const Shape& shape, ShapeStore& store) {
  auto* box = keep_roomy<btBoxShape>(store, to_bullet(Vector3(shape.size / 2)));
  box->setMargin(std::min(box->getMargin(), btScalar(kBoxMargin)));
  return box;
}

// May change the transform: hulls bake it into their points.
btCollisionShape* make_shape(const Shape& shape, ShapeStore& store, Transform& link_from_shape) {
  switch (shape.kind) {
    case ShapeKind::box:
      return make_box(shape, store);
    case ShapeKind::sphere:
      return keep_roomy<btSphereShape>(store, shape.radius);
    case ShapeKind::cylinder:
      return keep_roomy<btCylinderShapeZ>(store, btVector3(shape.radius, shape.radius, shape.length / 2));
    case ShapeKind::capsule:
      return keep_roomy<btCapsuleShapeZ>(store, shape.radius, shape.length);
    case ShapeKind::cone:
      return make_cone(shape, store, link_from_shape);
    case ShapeKind::hull:
    case ShapeKind::mesh:
      break;
  }
  if (shape.points.size() < 4) throw Error("shape", "a hull needs at least 4 points", "give the corners of a solid");
  btCollisionShape* hull = make_hull(shape.points, link_from_shape, store);
  link_from_shape = Transform::Identity();
  return hull;
}

bool is_identity(const Transform& t) {
  return (t.matrix() - Eigen::Matrix4d::Identity()).cwiseAbs().maxCoeff() < kNoRotation;
}

}  // namespace

bool has_collision(const Part& part) {
  return std::any_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) { return shape.collides; });
}

btCollisionShape* make_part_shape(const Part& part, const Transform& link_from_part, ShapeStore& store) {
  std::vector<std::pair<btCollisionShape*, Transform>> shapes;
  for (const Shape& shape : part.shapes) {
    if (!shape.collides) continue;
    Transform link_from_shape = link_from_part * shape.part_from_shape;
    btCollisionShape* made = make_shape(shape, store, link_from_shape);
    shapes.emplace_back(made, link_from_shape);
  }
  if (shapes.empty()) return keep<btEmptyShape>(store);
  if (shapes.size() == 1 && is_identity(shapes[0].second)) return shapes[0].first;
  auto* compound = keep<btCompoundShape>(store, shapes.size() > 4, static_cast<int>(shapes.size()));
  for (const auto& [shape, link_from_shape] : shapes) compound->addChildShape(to_bullet(link_from_shape), shape);
  return compound;
}

double least_thickness(const btCollisionShape& shape) {
  switch (shape.getShapeType()) {
    case COMPOUND_SHAPE_PROXYTYPE: {
      const auto& compound = static_cast<const btCompoundShape&>(shape);
      double least = std::numeric_limits<double>::infinity();
      for (int i = 0; i < compound.getNumChildShapes(); ++i)
        least = std::min(least, least_thickness(*compound.getChildShape(i)));
      return least;
    }
    case BOX_SHAPE_PROXYTYPE:
      return 2 * from_bullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin()).minCoeff();
    case CYLINDER_SHAPE_PROXYTYPE:
      return 2 * from_bullet(static_cast<const btCylinderShape&>(shape).getHalfExtentsWithMargin()).minCoeff();
    case SPHERE_SHAPE_PROXYTYPE:
      return 2 * static_cast<const btSphereShape&>(shape).getRadius();
    case CAPSULE_SHAPE_PROXYTYPE:
      return 2 * static_cast<const btCapsuleShape&>(shape).getRadius();
    case EMPTY_SHAPE_PROXYTYPE:
      return std::numeric_limits<double>::infinity();
    default:
      return static_cast<const btConvexShape&>(shape).getMargin() / kMarginOfThickness;
  }
}

}  // namespace stampede
