#include "engine/geometry/smooth.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>
#include <unordered_map>

#include "engine/base/hash.h"

namespace stampede {
namespace {

Vector3 vector(const std::array<float, 3>& a) { return {a[0], a[1], a[2]}; }

Vector3 face(const Corners& corners, std::size_t triangle) {  // twice its area long
  const Vector3 a = vector(corners.positions[3 * triangle]);
  return (vector(corners.positions[3 * triangle + 1]) - a).cross(vector(corners.positions[3 * triangle + 2]) - a);
}

double angle_at(const Corners& corners, std::size_t corner) {
  const std::size_t first = corner / 3 * 3;
  const Vector3 at = vector(corners.positions[corner]);
  const Vector3 a = vector(corners.positions[first + (corner + 1) % 3]) - at;
  const Vector3 b = vector(corners.positions[first + (corner + 2) % 3]) - at;
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

template <typename Item>
void keep(std::vector<Item>& list, const std::vector<std::size_t>& triangles) {
  if (list.empty()) return;
  std::vector<Item> kept;
  for (const std::size_t triangle : triangles)
    for (std::size_t k = 0; k < 3; ++k) kept.push_back(list[3 * triangle + k]);
  list = std::move(kept);
}

// Everything that tells a corner from another. -0 and 0 are equal numbers and become equal bits.
using Key = std::array<float, 8>;
struct KeyHash {
  std::size_t operator()(const Key& key) const {
    return hash64(std::string_view(reinterpret_cast<const char*>(key.data()), sizeof key));
  }
};

Key key_of(const Corners& corners, std::size_t i) {
  Key key{};
  for (std::size_t k = 0; k < 3; ++k) key[k] = corners.positions[i][k] + 0.0F;
  for (std::size_t k = 0; k < 3; ++k) key[3 + k] = corners.normals[i][k] + 0.0F;
  if (!corners.coordinates.empty())
    for (std::size_t k = 0; k < 2; ++k) key[6 + k] = corners.coordinates[i][k] + 0.0F;
  return key;
}

// Corners in groups of one position each.
std::vector<std::size_t> by_position(const Corners& corners) {
  std::vector<std::size_t> order(corners.positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return corners.positions[a] < corners.positions[b]; });
  return order;
}

}  // namespace

void drop_flat(Corners& corners) {
  std::vector<std::size_t> triangles;
  for (std::size_t i = 0; i < corners.positions.size() / 3; ++i)
    if (face(corners, i).squaredNorm() > 0) triangles.push_back(i);
  if (triangles.size() == corners.positions.size() / 3) return;
  keep(corners.normals, triangles);
  keep(corners.coordinates, triangles);
  keep(corners.positions, triangles);
}

void smooth_normals(Corners& corners) {
  const std::size_t count = corners.positions.size();
  std::vector<Vector3> faces(count / 3);
  for (std::size_t i = 0; i < faces.size(); ++i) faces[i] = face(corners, i).normalized();
  corners.normals.assign(count, {});
  const std::vector<std::size_t> order = by_position(corners);
  for (std::size_t first = 0, last = 0; first < count; first = last) {
    while (last < count && corners.positions[order[last]] == corners.positions[order[first]]) ++last;
    for (std::size_t i = first; i < last; ++i) {
      const Vector3& own = faces[order[i] / 3];
      Vector3 sum = Vector3::Zero();
      for (std::size_t j = first; j < last; ++j)
        if (const Vector3& other = faces[order[j] / 3]; own.dot(other) > kSmooth)
          sum += angle_at(corners, order[j]) * other;
      const Vector3 normal = sum.norm() > 0 ? sum.normalized() : own;
      for (int k = 0; k < 3; ++k)
        corners.normals[order[i]][static_cast<std::size_t>(k)] = static_cast<float>(normal[k]);
    }
  }
}

DrawnMesh joined(const Corners& corners) {
  DrawnMesh mesh;
  std::unordered_map<Key, std::uint32_t, KeyHash> known;  // asked by key only: its order reaches nothing
  for (std::size_t i = 0; i < corners.positions.size(); ++i) {
    const auto next = static_cast<std::uint32_t>(mesh.positions.size());
    const auto [at, is_new] = known.try_emplace(key_of(corners, i), next);
    if (i % 3 == 0) mesh.triangles.emplace_back();
    mesh.triangles.back()[i % 3] = at->second;
    if (!is_new) continue;
    mesh.positions.push_back(corners.positions[i]);
    mesh.normals.push_back(corners.normals[i]);
    if (!corners.coordinates.empty()) mesh.coordinates.push_back(corners.coordinates[i]);
  }
  return mesh;
}

}  // namespace stampede
