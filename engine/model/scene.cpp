#include "engine/model/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/base/enum_names.h"
#include "engine/base/error.h"
#include "engine/geometry/hull.h"
#include "engine/model/inertials.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 4> kObjectKinds{"body", "part", "region", "hand"};

template <typename Named>
int index_of(const std::vector<Named>& list, std::string_view name) {
  const auto found = std::find_if(list.begin(), list.end(), [&](const Named& item) { return item.name == name; });
  return found == list.end() ? -1 : static_cast<int>(found - list.begin());
}

// Of density 1, in the shape's frame. `transverse` and `axial` are about the centre.
MassProperties round_solid(double volume, double centre_z, double transverse, double axial) {
  MassProperties result;
  result.volume = volume;
  result.centre = {0, 0, centre_z};
  result.inertia = Vector3(transverse, transverse, axial).asDiagonal();
  return result;
}

MassProperties box_solid(const Vector3& size) {
  MassProperties result;
  result.volume = size.prod();
  const Vector3 square = size.cwiseAbs2();
  result.inertia =
      (result.volume / 12.0 * Vector3(square.y() + square.z(), square.z() + square.x(), square.x() + square.y()))
          .asDiagonal();
  return result;
}

MassProperties capsule_solid(double r, double h) {
  constexpr double pi = std::numbers::pi;
  const double cylinder = pi * r * r * h, caps = 4.0 / 3.0 * pi * r * r * r;
  const double axial = cylinder * r * r / 2.0 + caps * 0.4 * r * r;
  // The caps' centres lie 3/8 r beyond the ends; a sphere's inertia plus what moving its halves apart adds.
  const double transverse =
      cylinder * (r * r / 4.0 + h * h / 12.0) + caps * (0.4 * r * r + h * h / 4.0 + 3.0 / 8.0 * h * r);
  return round_solid(cylinder + caps, 0, transverse, axial);
}

MassProperties solid(const Shape& shape) {
  constexpr double pi = std::numbers::pi;
  const double r = shape.radius, h = shape.length;
  switch (shape.kind) {
    case ShapeKind::box:
      return box_solid(shape.size);
    case ShapeKind::sphere: {
      const double volume = 4.0 / 3.0 * pi * r * r * r;
      return round_solid(volume, 0, volume * 0.4 * r * r, volume * 0.4 * r * r);
    }
    case ShapeKind::cylinder: {
      const double volume = pi * r * r * h;
      return round_solid(volume, 0, volume * (3 * r * r + h * h) / 12.0, volume * r * r / 2.0);
    }
    case ShapeKind::capsule:
      return capsule_solid(r, h);
    case ShapeKind::cone: {
      const double volume = pi * r * r * h / 3.0;
      return round_solid(volume, -h / 4.0, volume * (3.0 / 20.0 * r * r + 3.0 / 80.0 * h * h), volume * 0.3 * r * r);
    }
    case ShapeKind::hull: {
      const std::optional<Hull> hull = convex_hull(shape.points);
      return hull ? mass_properties(*hull) : MassProperties{};
    }
    case ShapeKind::mesh:
      break;  // drawn only
  }
  return {};
}

void grow(std::array<Vector3, 2>& bounds, const Vector3& low, const Vector3& high) {
  bounds[0] = bounds[0].cwiseMin(low);
  bounds[1] = bounds[1].cwiseMax(high);
}

// Exact for the round kinds too: a disc of radius r with normal n reaches r sqrt(1 - n_i^2) along axis i.
void grow_by_shape(std::array<Vector3, 2>& bounds, const Shape& shape) {
  const Transform& pose = shape.part_from_shape;
  const Vector3 centre = pose.translation();
  const Vector3 z = pose.linear().col(2);
  const Vector3 rim = shape.radius * (Vector3::Ones() - z.cwiseAbs2()).cwiseMax(0.0).cwiseSqrt();
  const Vector3 half = shape.length / 2.0 * z;
  switch (shape.kind) {
    case ShapeKind::hull:
      for (const Vector3& point : shape.points) grow(bounds, pose * point, pose * point);
      return;
    case ShapeKind::cylinder:
      return grow(bounds, centre - half.cwiseAbs() - rim, centre + half.cwiseAbs() + rim);
    case ShapeKind::cone:
      grow(bounds, centre + half, centre + half);
      return grow(bounds, centre - half - rim, centre - half + rim);
    case ShapeKind::capsule: {
      const Vector3 reach = half.cwiseAbs() + Vector3::Constant(shape.radius);
      return grow(bounds, centre - reach, centre + reach);
    }
    case ShapeKind::sphere:
      return grow(bounds, centre - Vector3::Constant(shape.radius), centre + Vector3::Constant(shape.radius));
    case ShapeKind::box: {
      const Vector3 reach = pose.linear().cwiseAbs() * (shape.size / 2.0);
      return grow(bounds, centre - reach, centre + reach);
    }
    case ShapeKind::mesh:
      return;  // drawn only
  }
}

}  // namespace

std::string_view to_string(ObjectKind kind) { return enum_name(kObjectKinds, kind); }
std::optional<ObjectKind> object_kind_from(std::string_view name) { return enum_from<ObjectKind>(kObjectKinds, name); }

int Body::part_index(std::string_view part_name) const { return index_of(parts, part_name); }
int Scene::body_index(std::string_view body) const { return index_of(bodies, body); }
const Body& Scene::body_at(int index) const {
  return index < 0 ? robot.body : bodies.at(static_cast<std::size_t>(index));
}
int Scene::region_index(std::string_view region) const { return index_of(regions, region); }

const Object* Scene::object(std::string_view object_name) const {
  const int index = index_of(objects, object_name);
  return index < 0 ? nullptr : &objects[static_cast<std::size_t>(index)];
}

std::string part_name_of(std::string_view name) {
  std::string result;
  for (const char c : name) result += c == '.' ? "--" : std::string(1, c);
  return result;
}

double enclosed_volume(const Part& part) {
  const bool any =
      std::any_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) { return shape.collides; });
  double volume = 0;
  for (const Shape& shape : part.shapes)
    if (shape.collides || !any) volume += solid(shape).volume;
  return volume;
}

void set_uniform_mass(Part& part, double mass) {
  if (!std::isfinite(mass) || mass <= 0)
    throw Error(part.name, "a mass must be a finite number above 0", "give it in kg");
  const bool any_collides =
      std::any_of(part.shapes.begin(), part.shapes.end(), [](const Shape& shape) { return shape.collides; });
  double volume = 0;
  Vector3 moment = Vector3::Zero();
  std::vector<MassProperties> solids;  // in the part's frame
  for (const Shape& shape : part.shapes) {
    if (any_collides && !shape.collides) continue;
    MassProperties properties = solid(shape);
    const Matrix3 rotation = shape.part_from_shape.linear();
    properties.centre = shape.part_from_shape * properties.centre;
    properties.inertia = (rotation * properties.inertia * rotation.transpose()).eval();
    volume += properties.volume;
    moment += properties.volume * properties.centre;
    solids.push_back(properties);
  }
  if (!std::isfinite(volume) || volume <= 0)
    throw Error(part.name, "its shapes enclose no volume, so a mass cannot be spread over them",
                "give it a shape with positive sizes");
  part.mass = mass;
  part.centre_of_mass = moment / volume;
  part.inertia.setZero();
  for (const MassProperties& properties : solids) {
    const Vector3 arm = properties.centre - part.centre_of_mass;
    part.inertia +=
        properties.inertia + properties.volume * (arm.squaredNorm() * Matrix3::Identity() - arm * arm.transpose());
  }
  part.inertia *= mass / volume;
  part.inertia = (0.5 * (part.inertia + part.inertia.transpose())).eval();
}

std::array<Vector3, 2> bounding_box(const Part& part) {
  if (part.shapes.empty()) return {Vector3::Zero(), Vector3::Zero()};
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<Vector3, 2> bounds{Vector3::Constant(infinity), Vector3::Constant(-infinity)};
  for (const Shape& shape : part.shapes) grow_by_shape(bounds, shape);
  return bounds;
}

std::vector<std::string> arm_joints(const Robot& robot) {
  std::vector<std::string> names;
  for (const int part : robot.arm) names.push_back(robot.body.parts[static_cast<std::size_t>(part)].joint.name);
  return names;
}

}  // namespace stampede
