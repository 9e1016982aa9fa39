#include "engine/geometry/hull.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace stampede {
namespace {

struct Face {
  std::array<int, 3> corners{};
  Vector3 normal = Vector3::Zero();
  double offset = 0;
  std::vector<int> outside;  // points seen by this face
  int farthest = -1;
  double distance = 0;
  bool alive = true;
};

class Quickhull {
 public:
  explicit Quickhull(std::span<const Vector3> points) : points_(points) {}

  std::optional<Hull> run(int most_points) {
    if (!start()) return std::nullopt;
    for (int corners = 4; most_points == 0 || corners < most_points; ++corners) {
      const int face = farthest_face();
      if (face < 0) break;
      add_point(face);
    }
    return result();
  }

 private:
  double height(const Face& face, int point) const {
    return face.normal.dot(points_[static_cast<std::size_t>(point)]) - face.offset;
  }
  const Vector3& at(int point) const { return points_[static_cast<std::size_t>(point)]; }

  int add_face(int a, int b, int c) {
    Face face;
    face.corners = {a, b, c};
    face.normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    face.offset = face.normal.dot(at(a));
    const int index = static_cast<int>(faces_.size());
    faces_.push_back(std::move(face));
    for (int k = 0; k < 3; ++k)
      edges_[{faces_.back().corners[static_cast<std::size_t>(k)],
              faces_.back().corners[static_cast<std::size_t>((k + 1) % 3)]}] = index;
    return index;
  }

  // The first face that sees the point owns it.
  void hand_out(const std::vector<int>& orphans, std::span<const int> owners) {
    for (const int point : orphans) {
      for (const int index : owners) {
        Face& face = faces_[static_cast<std::size_t>(index)];
        const double distance = height(face, point);
        if (distance <= tolerance_) continue;
        face.outside.push_back(point);
        if (distance > face.distance) {
          face.distance = distance;
          face.farthest = point;
        }
        break;
      }
    }
  }

  // A tetrahedron of far apart points: the widest pair along an axis, the point farthest from their line, then
  // from their plane.
  bool start() {
    const int n = static_cast<int>(points_.size());
    if (n < 4) return false;
    Vector3 low = at(0), high = at(0);
    for (const Vector3& p : points_) {
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
    }
    int axis = 0;
    const double extent = (high - low).maxCoeff(&axis);
    tolerance_ = 1e-10 * extent + 1e-14 * std::max(low.cwiseAbs().maxCoeff(), high.cwiseAbs().maxCoeff());
    int a = 0, b = 0;
    for (int i = 1; i < n; ++i) {
      if (at(i)[axis] < at(a)[axis]) a = i;
      if (at(i)[axis] > at(b)[axis]) b = i;
    }
    const auto best = [&](auto&& measure) {
      int index = -1;
      double most = std::max(tolerance_, 1e-7 * extent);
      for (int i = 0; i < n; ++i) {
        const double value = measure(at(i));
        if (value > most) {
          most = value;
          index = i;
        }
      }
      return index;
    };
    const Vector3 line = (at(b) - at(a)).normalized();
    int c = best([&](const Vector3& p) { return line.cross(p - at(a)).norm(); });
    if (c < 0) return false;
    const Vector3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    const int d = best([&](const Vector3& p) { return std::abs(normal.dot(p - at(a))); });
    if (d < 0) return false;
    if (normal.dot(at(d) - at(a)) > 0) std::swap(b, c);  // d lies behind a, b, c
    const std::array<int, 4> owners{add_face(a, b, c), add_face(a, d, b), add_face(b, d, c), add_face(c, d, a)};
    std::vector<int> all(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) all[static_cast<std::size_t>(i)] = i;
    hand_out(all, owners);
    return true;
  }

  int farthest_face() const {
    int best = -1;
    double distance = 0;
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      if (!faces_[i].alive || faces_[i].distance <= distance) continue;
      distance = faces_[i].distance;
      best = static_cast<int>(i);
    }
    return best;
  }

  // Replaces all faces that see the point by a fan from their outline to it.
  void add_point(int first) {
    const int point = faces_[static_cast<std::size_t>(first)].farthest;
    std::vector<int> seen{first}, orphans, fan;
    std::vector<std::pair<int, int>> outline;
    faces_[static_cast<std::size_t>(first)].alive = false;
    for (std::size_t k = 0; k < seen.size(); ++k) {
      const Face face = faces_[static_cast<std::size_t>(seen[k])];
      orphans.insert(orphans.end(), face.outside.begin(), face.outside.end());
      for (std::size_t side = 0; side < 3; ++side) {
        const int from = face.corners[side], to = face.corners[(side + 1) % 3];
        const int beyond = edges_.at({to, from});
        Face& neighbour = faces_[static_cast<std::size_t>(beyond)];
        if (!neighbour.alive) continue;
        if (height(neighbour, point) > tolerance_) {
          neighbour.alive = false;
          seen.push_back(beyond);
        } else {
          outline.emplace_back(from, to);
        }
      }
    }
    for (const auto& [from, to] : outline) fan.push_back(add_face(from, to, point));
    std::sort(orphans.begin(), orphans.end());
    hand_out(orphans, fan);
  }

  std::optional<Hull> result() const {
    std::map<int, int> corner;  // input index -> hull index, in input order
    for (const Face& face : faces_)
      if (face.alive)
        for (const int c : face.corners) corner.emplace(c, 0);
    Hull hull;
    for (auto& [input, index] : corner) {
      index = static_cast<int>(hull.points.size());
      hull.points.push_back(at(input));
    }
    for (const Face& face : faces_) {
      if (!face.alive) continue;
      hull.triangles.push_back({corner.at(face.corners[0]), corner.at(face.corners[1]), corner.at(face.corners[2])});
    }
    for (const Face& owner : faces_)
      for (const int point : owner.outside)
        for (const Face& face : faces_)
          if (owner.alive && face.alive) hull.deviation_m = std::max(hull.deviation_m, height(face, point));
    return hull;
  }

  std::span<const Vector3> points_;
  std::vector<Face> faces_;
  std::map<std::pair<int, int>, int> edges_;  // directed edge -> the face on its left
  double tolerance_ = 0;
};

// Points on a face or an edge may have become corners on the way: those see fewer than three planes.
std::vector<Vector3> true_corners(const Hull& hull) {
  std::vector<std::vector<Vector3>> planes(hull.points.size());
  for (const auto& [a, b, c] : hull.triangles) {
    const auto at = [&](int corner) { return hull.points[static_cast<std::size_t>(corner)]; };
    const Vector3 normal = (at(b) - at(a)).cross(at(c) - at(a)).normalized();
    for (const int corner : {a, b, c}) {
      auto& seen = planes[static_cast<std::size_t>(corner)];
      const auto same = [&](const Vector3& other) { return normal.cross(other).norm() < 1e-6; };
      if (std::none_of(seen.begin(), seen.end(), same)) seen.push_back(normal);
    }
  }
  std::vector<Vector3> corners;
  for (std::size_t i = 0; i < planes.size(); ++i)
    if (planes[i].size() >= 3) corners.push_back(hull.points[i]);
  return corners;
}

}  // namespace

std::optional<Hull> convex_hull(std::span<const Vector3> points, int most_points) {
  std::optional<Hull> hull = Quickhull(points).run(most_points);
  if (!hull) return hull;
  const std::vector<Vector3> corners = true_corners(*hull);
  if (corners.size() == hull->points.size()) return hull;
  std::optional<Hull> clean = Quickhull(corners).run(0);
  if (!clean) return hull;
  clean->deviation_m = hull->deviation_m;
  return clean;
}

MassProperties mass_properties(const Hull& solid) {
  MassProperties result;
  if (solid.points.empty()) return result;
  const Vector3 apex = solid.points.front();  // near the solid: no cancellation far from the origin
  double volume = 0;
  Vector3 first = Vector3::Zero();
  Matrix3 second = Matrix3::Zero();  // integral of x x^T about the apex
  for (const auto& [ia, ib, ic] : solid.triangles) {
    const Vector3 a = solid.points[static_cast<std::size_t>(ia)] - apex;
    const Vector3 b = solid.points[static_cast<std::size_t>(ib)] - apex;
    const Vector3 c = solid.points[static_cast<std::size_t>(ic)] - apex;
    const double part = a.dot(b.cross(c)) / 6.0;
    const Vector3 sum = a + b + c;
    volume += part;
    first += part / 4.0 * sum;
    second += part / 20.0 * (a * a.transpose() + b * b.transpose() + c * c.transpose() + sum * sum.transpose());
  }
  if (volume <= 0) return result;
  const Vector3 centre = first / volume;
  second -= volume * centre * centre.transpose();
  result.volume = volume;
  result.centre = apex + centre;
  result.inertia = second.trace() * Matrix3::Identity() - second;
  return result;
}

}  // namespace stampede
