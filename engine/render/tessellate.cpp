#include "engine/render/tessellate.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/geometry/hull.h"

namespace stampede {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMinSides = 12, kMaxSides = 64;

std::array<float, 3> to_float(const Vector3& v) {
  return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

std::uint32_t add(DrawnMesh& mesh, const Vector3& position, const Vector3& normal) {
  mesh.positions.push_back(to_float(position));
  mesh.normals.push_back(to_float(normal.normalized()));
  return static_cast<std::uint32_t>(mesh.positions.size() - 1);
}

// A multiple of 4, so that the shape's extremes along x and y lie on corners.
int sides_of(double radius) {
  const double half_angle = std::acos(std::clamp(1 - 2 * kRoundTolerance / radius, -1.0, 1.0));
  const int sides = static_cast<int>(std::ceil(kPi / half_angle / 4)) * 4;
  return std::clamp(sides, kMinSides, kMaxSides);
}

// Of the corners, so that edges stray inwards as far as corners stray outwards. `shrink`: middle over corner.
double balanced(double radius, double shrink) { return radius * 2 / (1 + shrink); }

struct Ring {  // of a surface of revolution
  double radius, z;
  double normal_out, normal_up;
};

// The strip between two rings, from the lower to the upper.
void strip(DrawnMesh& mesh, const Ring& lower, const Ring& upper, int sides) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  const auto count = static_cast<std::uint32_t>(sides);
  for (const Ring& ring : {lower, upper})
    for (int i = 0; i < sides; ++i) {
      const double angle = 2 * kPi * i / sides, c = std::cos(angle), s = std::sin(angle);
      add(mesh, {ring.radius * c, ring.radius * s, ring.z}, {ring.normal_out * c, ring.normal_out * s, ring.normal_up});
    }
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t j = (i + 1) % count, up = first + count;
    if (lower.radius > 0) mesh.triangles.push_back({first + i, first + j, up + j});
    if (upper.radius > 0) mesh.triangles.push_back({first + i, up + j, up + i});
  }
}

void disc(DrawnMesh& mesh, double radius, double z, int sides, bool up) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (int i = 0; i < sides; ++i) {
    const double angle = 2 * kPi * i / sides;
    add(mesh, {radius * std::cos(angle), radius * std::sin(angle), z}, {0, 0, up ? 1.0 : -1.0});
  }
  for (std::uint32_t i = 1; i + 1 < static_cast<std::uint32_t>(sides); ++i) {
    if (up)
      mesh.triangles.push_back({first, first + i, first + i + 1});
    else
      mesh.triangles.push_back({first, first + i + 1, first + i});
  }
}

DrawnMesh box(const Vector3& size) {
  DrawnMesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      Vector3 normal = Vector3::Zero(), u = Vector3::Zero(), v = Vector3::Zero();
      normal[axis] = sign;
      u[(axis + 1) % 3] = sign;
      v[(axis + 2) % 3] = 1;
      const auto corner = [&](double a, double b) {
        return add(mesh, (normal + a * u + b * v).cwiseProduct(size) / 2, normal);
      };
      const std::uint32_t p = corner(-1, -1), q = corner(1, -1), r = corner(1, 1), s = corner(-1, 1);
      mesh.triangles.push_back({p, q, r});
      mesh.triangles.push_back({p, r, s});
    }
  return mesh;
}

DrawnMesh cylinder(double radius, double length) {
  const int sides = sides_of(radius);
  const double corner = balanced(radius, std::cos(kPi / sides));
  DrawnMesh mesh;
  strip(mesh, {corner, -length / 2, 1, 0}, {corner, length / 2, 1, 0}, sides);
  disc(mesh, corner, -length / 2, sides, false);
  disc(mesh, corner, length / 2, sides, true);
  return mesh;
}

DrawnMesh cone(double radius, double length) {
  const int sides = sides_of(radius);
  const double corner = balanced(radius, std::cos(kPi / sides));
  DrawnMesh mesh;
  strip(mesh, {corner, -length / 2, length, radius}, {0, length / 2, length, radius}, sides);
  disc(mesh, corner, -length / 2, sides, false);
  return mesh;
}

// A sphere, cut at its equator and drawn apart by `length`.
DrawnMesh capsule(double radius, double length) {
  const int sides = sides_of(radius), rings = sides / 4;  // from the equator to a pole
  const double corner = balanced(radius, std::cos(kPi / sides) * std::cos(kPi / 4 / rings));
  DrawnMesh mesh;
  std::vector<Ring> profile;
  for (int i = -rings; i <= rings; ++i) {
    const double angle = kPi / 2 * i / rings;
    const bool pole = std::abs(i) == rings;
    const Ring ring{pole ? 0 : corner * std::cos(angle), corner * std::sin(angle), std::cos(angle), std::sin(angle)};
    const auto moved = [&](double z) { return Ring{ring.radius, ring.z + z, ring.normal_out, ring.normal_up}; };
    if (i <= 0) profile.push_back(moved(-length / 2));
    if (i > 0 || (i == 0 && length > 0)) profile.push_back(moved(length / 2));
  }
  for (std::size_t i = 1; i < profile.size(); ++i) strip(mesh, profile[i - 1], profile[i], sides);
  return mesh;
}

DrawnMesh hull(const std::vector<Vector3>& points) {
  const std::optional<Hull> solid = convex_hull(points);
  if (!solid)
    throw Error("scene", "the points of a hull span no volume", "give four or more that are not in one plane");
  DrawnMesh mesh;
  for (const auto& [a, b, c] : solid->triangles) {
    const Vector3 &p = solid->points[static_cast<std::size_t>(a)], &q = solid->points[static_cast<std::size_t>(b)],
                  &r = solid->points[static_cast<std::size_t>(c)];
    const Vector3 normal = (q - p).cross(r - p);
    const std::uint32_t i = add(mesh, p, normal), j = add(mesh, q, normal), k = add(mesh, r, normal);
    mesh.triangles.push_back({i, j, k});
  }
  return mesh;
}

const DrawnMesh& looked_up(const std::string& name, const Scene& scene) {
  const auto found = scene.meshes.find(name);
  if (found == scene.meshes.end() || found->second == nullptr)
    throw Error("scene", "the drawn mesh '" + name + "' is missing", "put it into Scene::meshes");
  const DrawnMesh& mesh = *found->second;
  const std::size_t count = mesh.positions.size();
  const auto broken = [&](const std::string& what) {
    throw Error("scene", "the drawn mesh '" + name + "' " + what, "load it again from its file");
  };
  if (mesh.normals.size() != count) broken("has another number of normals than positions");
  if (!mesh.coordinates.empty() && mesh.coordinates.size() != count)
    broken("lacks texture coordinates for some corners");
  for (const auto& triangle : mesh.triangles)
    if (std::max({triangle[0], triangle[1], triangle[2]}) >= count) broken("names corners that it does not have");
  for (const auto& [x, y, z] : mesh.positions)
    if (!std::isfinite(x) || !std::isfinite(y) || !std::isfinite(z)) broken("has a corner that is nowhere");
  return mesh;
}

void demand(bool good, const std::string& what) {
  if (!good) throw Error("scene", "a visible " + what, "give it a positive size");
}

}  // namespace

DrawnMesh tessellate(const Shape& shape, const Scene& scene) {
  const bool round = shape.radius > 0 && std::isfinite(shape.radius);
  const bool tall = shape.length > 0 && std::isfinite(shape.length);
  switch (shape.kind) {
    case ShapeKind::box:
      demand(shape.size.minCoeff() > 0 && shape.size.allFinite(), "box has no volume");
      return box(shape.size);
    case ShapeKind::sphere:
      demand(round, "sphere has no radius");
      return capsule(shape.radius, 0);
    case ShapeKind::cylinder:
      demand(round && tall, "cylinder has no volume");
      return cylinder(shape.radius, shape.length);
    case ShapeKind::capsule:
      demand(round && shape.length >= 0, "capsule has no volume");
      return capsule(shape.radius, shape.length);
    case ShapeKind::cone:
      demand(round && tall, "cone has no volume");
      return cone(shape.radius, shape.length);
    case ShapeKind::hull:
      return hull(shape.points);
    case ShapeKind::mesh:
      return looked_up(shape.mesh, scene);
  }
  throw Error("scene", "a shape is of no known kind");
}

bool is_closed(const DrawnMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size()), place(mesh.positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<std::uint32_t>(i);
  const auto& at = mesh.positions;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return at[a] < at[b]; });
  for (std::size_t i = 0; i < order.size(); ++i)  // corners at one place are one: normals may part there
    place[order[i]] = i > 0 && at[order[i]] == at[order[i - 1]] ? place[order[i - 1]] : order[i];
  std::vector<std::array<std::uint32_t, 2>> forth, back;
  for (const auto& triangle : mesh.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = place[triangle[i]], b = place[triangle[(i + 1) % 3]];
      if (a == b) continue;
      forth.push_back({a, b});
      back.push_back({b, a});
    }
  std::sort(forth.begin(), forth.end());
  std::sort(back.begin(), back.end());
  double volume = 0;
  const auto corner = [&](std::uint32_t i) { return Vector3(at[i][0], at[i][1], at[i][2]); };
  for (const auto& [a, b, c] : mesh.triangles) volume += corner(a).dot(corner(b).cross(corner(c)));
  return volume > 0 && forth == back;
}

std::string tessellation_key(const Shape& shape, const Scene& scene) {
  Hasher hasher;
  hasher.number(static_cast<int>(shape.kind));
  switch (shape.kind) {
    case ShapeKind::mesh: {
      const DrawnMesh& mesh = looked_up(shape.mesh, scene);
      const auto whole = [&](const auto& items) {
        hasher.number(items.size()).bytes(items.data(), items.size() * sizeof(items[0]));
      };
      whole(mesh.positions);
      whole(mesh.normals);
      whole(mesh.coordinates);
      whole(mesh.triangles);
      break;
    }
    case ShapeKind::hull:
      for (const Vector3& point : shape.points) hasher.bytes(point.data(), 3 * sizeof(double));
      break;
    default:
      hasher.bytes(shape.size.data(), 3 * sizeof(double)).number(shape.radius).number(shape.length);
  }
  return hasher.digest();
}

}  // namespace stampede
