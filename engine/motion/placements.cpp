#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "engine/base/error.h"
#include "engine/motion/candidate_shapes.h"
#include "engine/motion/candidates.h"

namespace stampede {
namespace {

constexpr double kGap_m = 0.001;      // set down from this height
constexpr double kMargin_m = 0.005;   // from the edge
constexpr double kPadding_m = 0.005;  // from other bodies
constexpr int kDrawsPerSpot = 40;
constexpr double kLevel = 0.985;  // cosine: a face within 10 degrees of level carries

int body_of(const Scene& scene, const Object& object) {
  const int body = scene.body_index(object.body);
  if (body < 0) throw Error("placements", "object '" + object.name + "' has no body");
  return body;
}

const Part& part_of(const Scene& scene, const Object& object) {
  return scene.bodies[static_cast<std::size_t>(body_of(scene, object))].parts.at(static_cast<std::size_t>(object.part));
}

Quaternion turn(double yaw) { return Quaternion(Eigen::AngleAxisd(yaw, Vector3::UnitZ())); }

// The present rotation without its tilt: upright when it stands within 45 degrees of it, else lying on the side
// that is lowest now. Yaw is left out: it is drawn.
Quaternion resting_rotation(const Quaternion& world_from_body) {
  const Vector3 up = world_from_body.conjugate() * Vector3::UnitZ();
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  Vector3 nearest = Vector3::Zero();
  nearest[axis] = up[axis] > 0 ? 1 : -1;
  return Quaternion::FromTwoVectors(nearest, Vector3::UnitZ());
}

// What a placed body needs to know of itself, for one rotation.
struct Footprint {
  double below = 0;  // from its origin down to its lowest point, m
  double above = 0;
  Vector3 low, high;  // its bounding box about the origin, world axes, m
  double radius = 0;  // of the box seen from above, about the origin
};

Footprint footprint(const Part& part, const Quaternion& rotation) {
  Footprint foot;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3 direction = rotation.conjugate() * Vector3::Unit(axis);
    foot.high[axis] = reach(part, direction);
    foot.low[axis] = -reach(part, -direction);
  }
  foot.below = -foot.low.z();
  foot.above = foot.high.z();
  return foot;
}

// A level face that carries: a rectangle or a disc (radius > 0) in its own frame, z up.
struct Face {
  Transform world_from_face = Transform::Identity();
  double half_x = 0, half_y = 0, radius = 0;
  double area() const { return radius > 0 ? std::numbers::pi * radius * radius : 4 * half_x * half_y; }
};

// The upper face of one shape; nothing when it is round or tilted.
std::optional<Face> upper_face(const Shape& shape, const Transform& world_from_part) {
  const Transform world_from_shape = world_from_part * shape.part_from_shape;
  const Vector3 up = world_from_shape.linear().transpose() * Vector3::UnitZ();
  Eigen::Index axis = 0;
  if (up.cwiseAbs().maxCoeff(&axis) < kLevel) return std::nullopt;
  Face face;
  face.world_from_face = world_from_shape;
  Vector3 centre = Vector3::Zero();
  Vector3 half = 0.5 * shape.size;
  if (shape.kind == ShapeKind::hull) {
    Vector3 low = Vector3::Constant(1e9), high = -low;
    for (const Vector3& point : shape.points) {
      low = low.cwiseMin(point);
      high = high.cwiseMax(point);
    }
    centre = 0.5 * (low + high);
    half = 0.5 * (high - low);
  } else if (shape.kind == ShapeKind::cylinder && axis == 2) {
    face.radius = shape.radius;
    half = Vector3(shape.radius, shape.radius, 0.5 * shape.length);
  } else if (shape.kind != ShapeKind::box) {
    return std::nullopt;
  }
  const Vector3 normal = (up[axis] > 0 ? 1.0 : -1.0) * Vector3::Unit(axis);
  Matrix3 axes;
  axes.col(2) = normal;
  axes.col(0) = Vector3::Unit((axis + 1) % 3);
  axes.col(1) = normal.cross(axes.col(0));
  face.half_x = half[(axis + 1) % 3];
  face.half_y = half[(axis + 2) % 3];
  face.world_from_face.translation() = world_from_shape * (centre + normal * half[axis]);
  face.world_from_face.linear() = world_from_shape.linear() * axes;
  return face;
}

// A point of the face at which a footprint, seen in the face's frame, lies within it, `margin` from its edge.
std::optional<Vector3> draw_on(const Face& face, const Footprint& foot, Random& random) {
  const Vector3 low = foot.low, high = foot.high;
  if (face.radius > 0) {
    const double radius = std::sqrt(random.uniform()) * face.radius, angle = random.between(0, 2 * std::numbers::pi);
    const Vector3 point(radius * std::cos(angle), radius * std::sin(angle), 0);
    const double x = std::max(std::abs(point.x() + low.x()), std::abs(point.x() + high.x()));
    const double y = std::max(std::abs(point.y() + low.y()), std::abs(point.y() + high.y()));
    if (std::hypot(x, y) > face.radius - kMargin_m) return std::nullopt;
    return point;
  }
  const double x0 = -face.half_x + kMargin_m - low.x(), x1 = face.half_x - kMargin_m - high.x();
  const double y0 = -face.half_y + kMargin_m - low.y(), y1 = face.half_y - kMargin_m - high.y();
  if (x0 > x1 || y0 > y1) return std::nullopt;
  const double x = random.between(x0, x1), y = random.between(y0, y1);
  return Vector3(x, y, 0);
}

std::vector<Face> upper_faces(const Part& part, const Transform& world_from_part) {
  std::vector<Face> faces;
  for (const Shape& shape : part.shapes) {
    if (!shape.collides) continue;
    if (const auto face = upper_face(shape, world_from_part)) faces.push_back(*face);
  }
  return faces;
}

const Face& draw_face(const std::vector<Face>& faces, Random& random) {
  double total = 0;
  for (const Face& face : faces) total += face.area();
  double left = random.between(0, total);
  for (const Face& face : faces)
    if ((left -= face.area()) < 0) return face;
  return faces.back();
}

Quaternion resting_rotation(const World& world, int body) {
  return resting_rotation(Quaternion(world.world_from_part({body, 0}).linear()));
}

// Of the places that were drawn, those that are taken; where none was, the one that misses least. For people.
class TurnedDown {
 public:
  TurnedDown(const CollisionState& state, int body, std::vector<Looked>* list)
      : state_(state), body_(body), list_(list) {}
  bool wanted() const { return list_ != nullptr; }

  void taken(const Transform& place, double padding_m) {
    if (list_ == nullptr || list_->size() >= kMost) return;
    const std::optional<PartRef> part = state_.body_contact(body_, place, padding_m);
    if (!part) return;
    Looked looked{Looked::Fate::touches, place};
    looked.touched = name_of_part(state_.scene(), *part);
    if (++measured_ <= kMostMeasured)
      looked.missed_m = way_to_free(place, level_directions(),
                                    [&](const Transform& moved) { return state_.body_free(body_, moved, padding_m); });
    list_->push_back(std::move(looked));
  }
  void too_wide(const Transform& place, double by_m) {
    if (!too_wide_ || by_m < too_wide_->missed_m) {
      too_wide_ = Looked{Looked::Fate::no_room, place};
      too_wide_->missed_m = by_m;
    }
    ++misses_;
  }
  void close(bool fits) {
    if (list_ != nullptr && !fits && too_wide_) list_->insert(list_->end(), std::min(misses_, kMost), *too_wide_);
  }

 private:
  static constexpr std::size_t kMost = 200;
  static constexpr int kMostMeasured = 24;
  const CollisionState& state_;
  int body_, measured_ = 0;
  std::size_t misses_ = 0;
  std::vector<Looked>* list_;
  std::optional<Looked> too_wide_;
};

// How much wider than the face a footprint is; negative: it fits.
double too_wide_by(const Face& face, const Footprint& foot) {
  const Vector3 size = foot.high - foot.low;
  if (face.radius > 0) return std::hypot(size.x(), size.y()) / 2 + kMargin_m - face.radius;
  return std::max(size.x() - 2 * face.half_x, size.y() - 2 * face.half_y) + 2 * kMargin_m;
}

// Places of one body being sought, with the draws of one kind of place.
class SpotSearch {
 public:
  SpotSearch(const SpotQuery& query, std::string_view draws)
      : state_(query.state),
        body_(body_of(query.world.scene(), query.object)),
        part_(query.world.scene().bodies[static_cast<std::size_t>(body_)].parts.at(0)),
        upright_(resting_rotation(query.world, body_)),
        most_(query.most),
        random_(query.key.with(draws)),
        turned_down_(query.state, body_, query.turned_down) {}

  Random& random() { return random_; }
  Quaternion turned(double yaw) const { return turn(yaw) * upright_; }
  Quaternion draw_rotation() { return turned(random_.between(-std::numbers::pi, std::numbers::pi)); }
  Footprint foot(const Quaternion& rotation) const { return footprint(part_, rotation); }
  // Seen in the frame of a face.
  Footprint foot_on(const Face& face, const Quaternion& rotation) const {
    return foot(Quaternion(face.world_from_face.linear()).conjugate() * rotation);
  }

  // On a face: somewhere if it fits, else in the middle, which is turned down. `foot`: in the frame of the face.
  std::optional<Transform> place_on(const Face& face, const Footprint& foot, const Quaternion& rotation) {
    const std::optional<Vector3> point = draw_on(face, foot, random_);
    if (!point && !turned_down_.wanted()) return std::nullopt;
    Vector3 origin =
        face.world_from_face * point.value_or(Vector3(-0.5 * (foot.low + foot.high)).cwiseProduct(Vector3(1, 1, 0)));
    origin.z() += footprint(part_, rotation).below + kGap_m;
    if (point) return make_transform(origin, rotation);
    if (const double by = too_wide_by(face, foot); by > 0) turned_down_.too_wide(make_transform(origin, rotation), by);
    return std::nullopt;
  }

  // Draws places, asks about many at once and keeps the first that are free. A draw is nothing where it misses.
  std::vector<Transform> keep_free(const std::function<std::optional<Transform>()>& draw) {
    std::vector<Transform> kept, drawn;
    bool fits = false;
    for (int left = kDrawsPerSpot * most_; left > 0 && !enough(kept);) {
      drawn.clear();
      for (; left > 0 && !enough(drawn); --left)
        if (const std::optional<Transform> place = draw()) drawn.push_back(*place);
      fits = fits || !drawn.empty();
      const std::vector<bool> free = state_.places_free(body_, drawn, kPadding_m);
      for (std::size_t i = 0; i < drawn.size() && !enough(kept); ++i)
        if (free[i])
          kept.push_back(drawn[i]);
        else
          turned_down_.taken(drawn[i], kPadding_m);
    }
    turned_down_.close(fits);
    return kept;
  }

  // The same of one place, which may be close to others.
  void keep_if_free(const Transform& place, std::vector<Transform>& kept) {
    if (state_.body_free(body_, place, 0))
      kept.push_back(place);
    else
      turned_down_.taken(place, 0);
  }
  bool enough(const std::vector<Transform>& places) const { return static_cast<int>(places.size()) >= most_; }

 private:
  const CollisionState& state_;
  int body_;
  const Part& part_;
  Quaternion upright_;
  int most_;
  Random random_;
  TurnedDown turned_down_;
};

}  // namespace

std::vector<Transform> free_spots(const SpotQuery& query, const Object& surface) {
  const Scene& scene = query.world.scene();
  SpotSearch search(query, "free_spots");
  const Transform world_from_surface = query.world.world_from_part({body_of(scene, surface), surface.part});
  const std::vector<Face> faces = upper_faces(part_of(scene, surface), world_from_surface);
  if (faces.empty()) return {};
  return search.keep_free([&] {
    const Face& face = draw_face(faces, search.random());
    const Quaternion rotation = search.draw_rotation();
    std::optional<Transform> place = search.place_on(face, search.foot_on(face, rotation), rotation);
    if (place && query.within && !query.within->contains(*place)) place.reset();
    return place;
  });
}

std::vector<Transform> region_spots(const SpotQuery& query, const Region& region) {
  SpotSearch search(query, "region_spots");
  const Transform world_from_region =
      region.body.empty() ? region.part_from_region
                          : query.world.world_from_part({query.world.scene().body_index(region.body), region.part}) *
                                region.part_from_region;
  // The lower face, with z up; a patch of no height carries too.
  const Face face{world_from_region * translation(0, 0, -0.5 * region.size.z()), 0.5 * region.size.x(),
                  0.5 * region.size.y(), 0};
  return search.keep_free([&] {
    const Quaternion rotation = search.draw_rotation();
    Footprint foot = search.foot_on(face, rotation);
    // Where the whole object does not fit, its middle does: a small target still names a place.
    if (foot.high.x() - foot.low.x() + 2 * kMargin_m > region.size.x() ||
        foot.high.y() - foot.low.y() + 2 * kMargin_m > region.size.y())
      foot.low = foot.high = Vector3::Zero();
    return search.place_on(face, foot, rotation);
  });
}

std::vector<Transform> stack_spots(const SpotQuery& query, const Object& below) {
  const Scene& scene = query.world.scene();
  SpotSearch search(query, "stack_spots");
  const Part& lower = part_of(scene, below);
  const Transform world_from_below = query.world.world_from_part({body_of(scene, below), below.part});
  const Footprint base = footprint(lower, Quaternion(world_from_below.linear()));
  const Vector3 middle = world_from_below.translation() + 0.5 * (base.low + base.high);
  const double top = world_from_below.translation().z() + base.above;
  // Sides parallel to those below: the lower body's yaw and its quarter turns, in an order drawn by key.
  const Quaternion flat = resting_rotation(Quaternion(world_from_below.linear()));
  const Matrix3 turned = (Quaternion(world_from_below.linear()) * flat.conjugate()).toRotationMatrix();
  const double yaw = std::atan2(turned(1, 0), turned(0, 0));
  const std::int64_t first = search.random().below(4);
  std::vector<Transform> spots;
  for (std::int64_t k = 0; k < 4 && !search.enough(spots); ++k) {
    const Quaternion rotation = search.turned(yaw + 0.5 * std::numbers::pi * static_cast<double>((first + k) % 4));
    const Footprint foot = search.foot(rotation);
    Vector3 origin = middle - 0.5 * (foot.low + foot.high);
    origin.z() = top + foot.below + kGap_m;
    search.keep_if_free(make_transform(origin, rotation), spots);
  }
  return spots;
}

}  // namespace stampede
