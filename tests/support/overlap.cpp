#include "tests/support/overlap.h"

#include <ccd/ccd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <set>

#include "engine/model/scene_poses.h"
#include "engine/record/observation.h"

namespace stampede::test {
namespace {

struct Solid {
  const Shape* shape = nullptr;
  Transform world_from_shape = Transform::Identity();
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
};

Vector3 local_support(const Shape& shape, const Vector3& d) {
  const auto round_side = [&](double radius) {
    const double across = std::hypot(d.x(), d.y());
    return across > 1e-12 ? Vector3(radius * d.x() / across, radius * d.y() / across, 0) : Vector3(0, 0, 0);
  };
  const Vector3 end(0, 0, std::copysign(shape.length / 2, d.z()));
  switch (shape.kind) {
    case ShapeKind::box:
      return {std::copysign(shape.size.x() / 2, d.x()), std::copysign(shape.size.y() / 2, d.y()),
              std::copysign(shape.size.z() / 2, d.z())};
    case ShapeKind::sphere:
      return shape.radius * d.normalized();
    case ShapeKind::capsule:
      return end + shape.radius * d.normalized();
    case ShapeKind::cylinder:
      return end + round_side(shape.radius);
    case ShapeKind::cone: {
      const Vector3 tip(0, 0, shape.length / 2), rim = Vector3(0, 0, -shape.length / 2) + round_side(shape.radius);
      return tip.dot(d) > rim.dot(d) ? tip : rim;
    }
    case ShapeKind::hull:
    case ShapeKind::mesh:
      break;
  }
  return *std::max_element(shape.points.begin(), shape.points.end(),
                           [&](const Vector3& a, const Vector3& b) { return a.dot(d) < b.dot(d); });
}

Vector3 support(const Solid& solid, const Vector3& d) {
  return solid.world_from_shape * local_support(*solid.shape, solid.world_from_shape.linear().transpose() * d);
}

Solid solid_at(const Shape& shape, const Transform& world_from_part) {
  Solid solid;
  solid.shape = &shape;
  solid.world_from_shape = world_from_part * shape.part_from_shape;
  for (int axis = 0; axis < 3; ++axis) {
    solid.upper[axis] = support(solid, Vector3::Unit(axis))[axis];
    solid.lower[axis] = support(solid, -Vector3::Unit(axis))[axis];
  }
  return solid;
}

Vector3 centre_of(const Solid& solid) { return (solid.lower + solid.upper) / 2; }

void ccd_support(const void* object, const ccd_vec3_t* direction, ccd_vec3_t* out) {
  const Vector3 point =
      support(*static_cast<const Solid*>(object), Vector3(direction->v[0], direction->v[1], direction->v[2]));
  ccdVec3Set(out, point.x(), point.y(), point.z());
}

void ccd_centre(const void* object, ccd_vec3_t* out) {
  const Vector3 centre = centre_of(*static_cast<const Solid*>(object));
  ccdVec3Set(out, centre.x(), centre.y(), centre.z());
}

// How far the two overlap along a direction: an upper bound of their depth, whichever it is.
double along(const Solid& one, const Solid& other, const Vector3& d) {
  return support(one, d).dot(d) - support(other, -d).dot(d);
}

bool boxes_meet(const Solid& one, const Solid& other, double deeper) {
  for (int axis = 0; axis < 3; ++axis)
    if (std::min(one.upper[axis] - other.lower[axis], other.upper[axis] - one.lower[axis]) <= deeper) return false;
  return true;
}

double depth_of(const Solid& one, const Solid& other, double deeper) {
  // Axes that part most pairs, or show them to be shallow: those of both shapes, and the line between them.
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Vector3& axis) {
    least = std::min({least, along(one, other, axis), along(one, other, -axis)});
    return least <= deeper;
  };
  for (const Solid* solid : {&one, &other})
    for (int axis = 0; axis < 3; ++axis)
      if (look(solid->world_from_shape.linear().col(axis))) return std::max(0.0, least);
  const Vector3 between = centre_of(other) - centre_of(one);
  if (between.norm() > 1e-9 && look(between.normalized())) return std::max(0.0, least);

  ccd_t ccd;
  CCD_INIT(&ccd);
  ccd.support1 = ccd.support2 = ccd_support;
  ccd.center1 = ccd.center2 = ccd_centre;
  ccd.max_iterations = 200;
  ccd.epa_tolerance = 1e-5;
  ccd.mpr_tolerance = 1e-5;
  if (ccdGJKIntersect(&one, &other, &ccd) == 0) return 0;
  ccd_real_t depth = 0;
  ccd_vec3_t direction, position;
  const auto follow = [&] {
    const Vector3 found(direction.v[0], direction.v[1], direction.v[2]);
    if (found.norm() > 1e-9) look(found.normalized());
  };
  if (ccdGJKPenetration(&one, &other, &ccd, &depth, &direction, &position) == 0) follow();
  if (ccdMPRPenetration(&one, &other, &ccd, &depth, &direction, &position) == 0) follow();
  return std::max(0.0, least);
}

// A part with its shapes that collide.
struct Lump {
  int body = -1, part = 0;  // body -1: the robot
  std::string name;
  bool stands = false;  // never moves
  std::vector<Solid> solids;
};

std::string name_of(const Scene& scene, int body, int part) {
  const Body& its = scene.body_at(body);
  const std::string& name = body < 0 ? scene.robot.name : its.name;
  const std::string& own = its.parts[static_cast<std::size_t>(part)].name;
  return own.empty() || own == name ? name : name + "." + own;
}

class Measurement {
 public:
  Measurement(const EpisodeRecord& episode, const OverlapLimits& limits)
      : episode_(episode), limits_(limits), scene_(scene_from_document(episode.scene.document)) {
    for (int body = -1; body < static_cast<int>(scene_.bodies.size()); ++body)
      for (std::size_t part = 0; part < scene_.body_at(body).parts.size(); ++part) add(body, static_cast<int>(part));
    find_neighbours();
  }

  std::vector<Overlap> run() {
    const auto count = static_cast<std::int64_t>(episode_.frames.size());
    for (frame_ = 0; frame_ < count; frame_ += limits_.stride) {
      place();
      for (std::size_t i = 0; i < lumps_.size(); ++i)
        for (std::size_t k = i + 1; k < lumps_.size(); ++k)
          if (counts(lumps_[i], lumps_[k])) measure(lumps_[i], lumps_[k]);
    }
    std::vector<Overlap> all;
    for (auto& [pair, worst] : worst_) all.push_back(std::move(worst));
    std::stable_sort(all.begin(), all.end(), [](const Overlap& a, const Overlap& b) { return a.depth > b.depth; });
    return all;
  }

 private:
  void add(int body, int part) {
    const Body& its = scene_.body_at(body);
    Lump lump{body, part, name_of(scene_, body, part), body >= 0 && !its.free, {}};
    for (int above = part; above > 0 && lump.stands; above = its.parts[static_cast<std::size_t>(above)].parent)
      lump.stands = its.parts[static_cast<std::size_t>(above)].joint.kind == JointKind::fixed;
    for (const Shape& shape : its.parts[static_cast<std::size_t>(part)].shapes)
      if (shape.collides) lump.solids.emplace_back().shape = &shape;
    if (!lump.solids.empty()) lumps_.push_back(std::move(lump));
  }

  // Links on one joint, frames without shapes between them left out.
  void find_neighbours() {
    const std::vector<Part>& parts = scene_.robot.body.parts;
    const auto solid = [&](int part) {
      return std::ranges::any_of(parts[static_cast<std::size_t>(part)].shapes, &Shape::collides);
    };
    for (int part = 1; part < static_cast<int>(parts.size()); ++part) {
      int above = parts[static_cast<std::size_t>(part)].parent;
      while (above > 0 && !solid(above)) above = parts[static_cast<std::size_t>(above)].parent;
      neighbours_.insert({above, part});
    }
  }

  void place() {
    const ScenePoses poses = scene_poses(scene_, state_at(scene_, episode_, frame_));
    for (Lump& lump : lumps_) {
      if (lump.stands && frame_ > 0) continue;
      const auto part = static_cast<std::size_t>(lump.part);
      const Transform& pose = lump.body < 0 ? poses.world_from_robot_part[part]
                                            : poses.world_from_part[static_cast<std::size_t>(lump.body)][part];
      for (Solid& solid : lump.solids) solid = solid_at(*solid.shape, pose);
    }
  }

  bool counts(const Lump& one, const Lump& other) const {
    if (frame_ > 0 && one.stands && other.stands) return false;
    if (one.body != other.body) return !joined(one, other) && !joined(other, one);
    return one.body < 0 && !neighbours_.contains({one.part, other.part});
  }

  bool joined(const Lump& one, const Lump& other) const {
    return one.body >= 0 && other.body >= 0 && scene_.body_at(one.body).joined_to == scene_.body_at(other.body).name;
  }

  OverlapKind kind_of(const Lump& one, const Lump& other) const {
    if (one.body < 0 && other.body < 0) return OverlapKind::itself;
    if (frame_ == 0) return OverlapKind::start;
    if (one.body >= 0) return OverlapKind::things;
    return scene_.body_at(other.body).free ? OverlapKind::thing : OverlapKind::furniture;
  }

  bool in_contact(const Lump& one, const Lump& other) const {
    const auto is = [&](const Lump& lump, const std::string& object, const std::string& part) {
      const std::string whole = part.empty() || object.ends_with("." + part) ? object : object + "." + part;
      return lump.name == whole || lump.name == object;
    };
    // A contact's frames are those between which it was: at the last of them, too, things are as it left them.
    return std::ranges::any_of(episode_.labels.contacts, [&](const ContactRecord& contact) {
      return contact.first_frame <= frame_ && frame_ <= contact.end_frame &&
             ((is(one, contact.object_a, contact.part_a) && is(other, contact.object_b, contact.part_b)) ||
              (is(other, contact.object_a, contact.part_a) && is(one, contact.object_b, contact.part_b)));
    });
  }

  void measure(const Lump& one, const Lump& other) {
    double depth = limits_.let_alone;
    for (const Solid& a : one.solids)
      for (const Solid& b : other.solids)
        if (boxes_meet(a, b, depth)) depth = std::max(depth, depth_of(a, b, depth));
    if (depth <= limits_.let_alone) return;
    const bool pressed = in_contact(one, other);
    if (pressed && depth <= limits_.pressed) return;
    Overlap& worst = worst_[{one.name, other.name, frame_ == 0}];
    if (depth > worst.depth) worst = {kind_of(one, other), one.name, other.name, depth, frame_, pressed};
  }

  const EpisodeRecord& episode_;
  OverlapLimits limits_;
  Scene scene_;
  std::vector<Lump> lumps_;
  std::set<std::pair<int, int>> neighbours_;
  std::map<std::tuple<std::string, std::string, bool>, Overlap> worst_;
  std::int64_t frame_ = 0;
};

}  // namespace

std::vector<Overlap> overlaps_of(const EpisodeRecord& episode, const OverlapLimits& limits) {
  return Measurement(episode, limits).run();
}

std::string to_text(const Overlap& overlap) {
  char text[64];
  std::snprintf(text, sizeof text, ", %.1f mm at frame %lld%s", 1000 * overlap.depth,
                static_cast<long long>(overlap.frame), overlap.pressed ? ", pressed" : "");
  return std::string(kOverlapKinds[static_cast<std::size_t>(overlap.kind)]) + ": " + overlap.one + " and " +
         overlap.other + text;
}

double depth_of(const Shape& one, const Transform& world_from_part, const Shape& other,
                const Transform& world_from_other_part) {
  const Solid a = solid_at(one, world_from_part), b = solid_at(other, world_from_other_part);
  return boxes_meet(a, b, 0) ? depth_of(a, b, 0) : 0;
}

}  // namespace stampede::test
