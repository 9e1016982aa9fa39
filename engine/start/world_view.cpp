#include "engine/start/world_view.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/names.h"
#include "engine/base/nearest.h"
#include "engine/geometry/corners.h"
#include "engine/motion/candidates.h"
#include "engine/sim/load.h"
#include "engine/sim/world.h"

namespace stampede {
namespace {

constexpr std::size_t kRestFrames = 5;  // 0.25 s at 20 Hz
constexpr double kRestDistance = 1e-3;  // m
constexpr double kRestAngle = 0.0175;   // rad
constexpr double kSupportShare = 0.25;  // of the object's weight

constexpr double kFromBelow = 0.5;  // least share of a contact's normal that is upward

using Bounds = std::array<Vector3, 2>;

Bounds world_bounds(const Transform& world_from_part, const Vector3& low, const Vector3& high) {
  Vector3 lower = Vector3::Constant(std::numeric_limits<double>::infinity()), upper = -lower;
  for (const Vector3& corner : box_corners(low, high)) {
    const Vector3 point = world_from_part * corner;
    lower = lower.cwiseMin(point);
    upper = upper.cwiseMax(point);
  }
  return {lower, upper};
}

// Of a point to a box, from how far it lies beyond each pair of faces: negative inside.
double signed_distance(const Vector3& beyond) {
  const double outside = beyond.cwiseMax(0).norm();
  return outside > 0 ? outside : beyond.maxCoeff();
}

bool in_hand(const WorldView& view, const Object& thing) {
  const std::optional<PartRef> part = view.held();
  return part && view.owns(thing, *part);
}

// While the hand holds it too, its weight says nothing: then any contact from below counts, until it leaves.
bool borne(const WorldView& view, const Object& below, const Object& above) {
  if (above.kind != ObjectKind::body || below.kind == ObjectKind::region || below.kind == ObjectKind::hand)
    return false;
  const PartRef ref = view.part_of(above.name);
  const bool held = in_hand(view, above);
  double upward = 0;
  for (const Contact& contact : view.world().contacts()) {
    const bool first = contact.a == ref && view.owns(below, contact.b);
    if (!first && !(contact.b == ref && view.owns(below, contact.a))) continue;
    const double side = first ? 1 : -1;
    if (held && contact.mean_force > 0 && side * contact.normal.z() >= kFromBelow) return true;
    upward += side * contact.force.z();
  }
  if (held || upward <= 0) return false;
  const double mass = view.scene().bodies[static_cast<std::size_t>(ref.body)].parts[0].mass;
  return upward >= kSupportShare * mass * view.scene().gravity.norm();
}

// What rests in or on it is its load: that touches it, and counts as a part of it.
bool touched_by_others(const WorldView& view, const Object& thing) {
  const auto& contacts = view.world().contacts();
  const auto touches = [&](const auto& is_own) {
    return std::any_of(contacts.begin(), contacts.end(), [&](const Contact& contact) {
      const bool a = is_own(contact.a), b = is_own(contact.b);
      return a != b && (a ? contact.b : contact.a).body >= 0;
    });
  };
  if (!touches([&](PartRef part) { return view.owns(thing, part); })) return false;
  const std::vector<int> load = borne_by(view.scene(), loads(view.world()), view.part_of(thing.name));
  return touches([&](PartRef part) {
    return view.owns(thing, part) || std::find(load.begin(), load.end(), part.body) != load.end();
  });
}

}  // namespace

const Scene& WorldView::scene() const { return world_->scene(); }

WorldView::WorldView(World& world) : world_(&world) {
  const auto& objects = scene().objects;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    index_[objects[i].name] = static_cast<int>(i);
    bodies_.push_back(objects[i].body.empty() ? -1 : scene().body_index(objects[i].body));
  }
  for (int body = 0; body < static_cast<int>(scene().bodies.size()); ++body) {
    std::vector<Box>& boxes = parts_.emplace_back();
    for (const Part& part : scene().bodies[static_cast<std::size_t>(body)].parts) {
      const PartRef ref{body, static_cast<int>(boxes.size())};
      const auto [low, high] = bounding_box(part);
      boxes.push_back({ref, low, high});
      Part alone;
      for (const Shape& shape : part.shapes) {
        if (!shape.collides) continue;
        alone.shapes = {shape};
        const auto [shape_low, shape_high] = bounding_box(alone);
        shapes_.push_back({ref, shape_low, shape_high});
      }
    }
  }
}

Bounds WorldView::bounds_of(PartRef part) const {
  const Box& box = parts_[static_cast<std::size_t>(part.body)][static_cast<std::size_t>(part.part)];
  return world_bounds(world_->world_from_part(part), box.low, box.high);
}

// Contacts are asked for whom they belong to many times a frame: names are looked up once.
int WorldView::body_of(const Object& thing) const {
  const auto& objects = scene().objects;
  const auto index = static_cast<std::size_t>(&thing - objects.data());
  const bool own = !std::less<>()(&thing, objects.data()) && index < objects.size();
  return own ? bodies_[index] : scene().body_index(thing.body);
}

const Object& WorldView::object(std::string_view name) const {
  const auto found = index_.find(name);
  if (found == index_.end())
    throw Error("", "the scene has no object '" + std::string(name) + "'",
                did_you_mean(name, names_of(scene().objects)));
  return scene().objects[static_cast<std::size_t>(found->second)];
}

double WorldView::time_s() const { return static_cast<double>(world_->step_count()) * world_->dt(); }

PartRef WorldView::part_of(std::string_view name) const {
  const Object& thing = object(name);
  switch (thing.kind) {
    case ObjectKind::body:
    case ObjectKind::part:
      return {body_of(thing), thing.part};
    case ObjectKind::hand:
      return PartRef::of_robot(scene().robot.tip_part);
    case ObjectKind::region:
      break;
  }
  throw Error("", "'" + std::string(name) + "' is a region: it has no body");
}

bool WorldView::owns(const Object& thing, PartRef part) const {
  const Robot& robot = scene().robot;
  switch (thing.kind) {
    case ObjectKind::body:
      return part.body >= 0 && part.body == body_of(thing);
    case ObjectKind::part:
      return part.body >= 0 && part == PartRef{body_of(thing), thing.part};
    case ObjectKind::hand:
      return part.on_robot() && part.robot() == 0 &&
             (std::count(robot.pads.begin(), robot.pads.end(), part.part) > 0 ||
              std::count(robot.fingers.begin(), robot.fingers.end(), part.part) > 0 || part.part == robot.tip_part);
    case ObjectKind::region:
      return false;
  }
  return false;
}

Transform WorldView::world_from(std::string_view name) const { return world_from(object(name)); }

Transform WorldView::world_from(const Object& thing) const {
  switch (thing.kind) {
    case ObjectKind::body:
    case ObjectKind::part:
      return world_->world_from_part({body_of(thing), thing.part});
    case ObjectKind::hand:
      return world_from_tip();
    case ObjectKind::region:
      break;
  }
  return world_from_object(*world_, thing);
}

Vector3 WorldView::velocity(std::string_view name) const {
  return object(name).kind == ObjectKind::region ? Vector3::Zero().eval() : world_->linear_velocity(part_of(name));
}

Vector3 WorldView::size(std::string_view name) const {
  const Object& thing = object(name);
  if (thing.kind == ObjectKind::region) {
    const int region = scene().region_index(name);
    if (region >= 0) return scene().regions[static_cast<std::size_t>(region)].size;
  }
  return thing.size;
}

double WorldView::bottom(std::string_view name) const {
  const Object& thing = object(name);
  if (thing.kind == ObjectKind::region || thing.kind == ObjectKind::hand)
    return world_from(name).translation().z() - size(name).z() / 2;
  return bounds_of(part_of(name))[0].z();
}

double WorldView::top(std::string_view name) const {
  const Object& thing = object(name);
  if (thing.kind == ObjectKind::region || thing.kind == ObjectKind::hand)
    return world_from(name).translation().z() + size(name).z() / 2;
  return bounds_of(part_of(name))[1].z();
}

double WorldView::joint(std::string_view part) const { return world_->joint_position(part_of(part)); }

double WorldView::joint_velocity(std::string_view part) const { return world_->joint_velocity(part_of(part)); }

std::pair<double, double> WorldView::joint_range(std::string_view name) const {
  const PartRef ref = part_of(name);
  const Joint& joint = scene().body_at(ref.body).parts[static_cast<std::size_t>(ref.part)].joint;
  return {joint.lower, joint.upper};
}

double WorldView::joint_fraction(std::string_view part) const {
  const auto [lower, upper] = joint_range(part);
  return upper > lower ? (joint(part) - lower) / (upper - lower) : 0;
}

Transform WorldView::part_at(std::string_view name, double position) const {
  const PartRef ref = part_of(name);
  const Body& body = scene().body_at(ref.body);
  const Part& part = body.parts[static_cast<std::size_t>(ref.part)];
  PartRef parent{ref.body, part.parent};
  if (part.parent < 0) {
    if (!world_->joined(ref)) return world_->world_from_part(ref);
    parent = {scene().body_index(body.joined_to), body.joined_part};
  }
  return world_->world_from_part(parent) * part.joint.parent_from_joint * joint_motion(part.joint, position);
}

bool WorldView::touching(std::string_view a, std::string_view b) const { return contact_force(a, b) > 0; }

double WorldView::contact_force(std::string_view a, std::string_view b) const {
  const Object &first = object(a), &second = object(b);
  double force = 0;
  for (const Contact& contact : world_->contacts())
    if ((owns(first, contact.a) && owns(second, contact.b)) || (owns(first, contact.b) && owns(second, contact.a)))
      force += contact.mean_force;
  return force;
}

WorldView::Judged WorldView::supports(std::string_view surface, std::string_view name) const {
  const Object &below = object(surface), &above = object(name);
  const bool on = borne(*this, below, above);
  const int owner = body_of(below);
  if (above.kind != ObjectKind::body || owner < 0 || below.kind == ObjectKind::region) return {on, 0};
  const Box& box = parts_[static_cast<std::size_t>(owner)][static_cast<std::size_t>(below.part)];
  const auto [low, high] = bounds_of({body_of(above), above.part});
  const Vector3 foot((low.x() + high.x()) / 2, (low.y() + high.y()) / 2, low.z());
  const Vector3 at = world_->world_from_part(box.part).inverse() * foot;
  const Vector3 inward = (at - box.low).cwiseMin(box.high - at);  // from the side faces
  if (on) return {true, std::max(0.0, inward.head<2>().minCoeff())};
  const Vector3 away(std::max(0.0, -inward.x()), std::max(0.0, -inward.y()), at.z() - box.high.z());
  return {false, -away.norm()};
}

// From its lowest point to the highest shape below it, by bounding boxes.
double WorldView::drop_below(const Object& thing) const {
  constexpr double kSunk = 0.002;  // m
  const PartRef own{body_of(thing), thing.part};
  const auto [low, high] = bounds_of(own);
  double floor = 0;
  for (const Box& box : shapes_) {
    if (box.part.body == own.body) continue;
    const auto [below, top] = world_bounds(world_->world_from_part(box.part), box.low, box.high);
    const bool under = below.x() < high.x() && top.x() > low.x() && below.y() < high.y() && top.y() > low.y();
    if (under && top.z() <= low.z() + kSunk) floor = std::max(floor, top.z());
  }
  return std::max(0.0, low.z() - floor);
}

WorldView::Judged WorldView::carried(std::string_view name) const {
  const Judged held = grasped(name);
  const Object& thing = object(name);
  if (!held.holds || thing.kind == ObjectKind::region) return {false, std::min(0.0, held.margin)};
  return touched_by_others(*this, thing) ? Judged{false, 0} : Judged{true, drop_below(thing)};
}

bool WorldView::at_rest(std::string_view name) const {
  const PartRef ref = part_of(name);
  if (ref.body < 0 || history_.poses.size() < kRestFrames) return false;
  const auto& body = scene().bodies[static_cast<std::size_t>(ref.body)];
  if (!body.free) return std::abs(world_->joint_velocity(ref)) < 0.01;
  const auto before = history_.poses.end() - static_cast<std::ptrdiff_t>(kRestFrames);
  const Transform& then = (*before)[static_cast<std::size_t>(ref.body)];
  const Transform& now = world_->world_from_part(ref);
  return (now.translation() - then.translation()).norm() < kRestDistance &&
         angle_between(Quaternion(now.linear()), Quaternion(then.linear())) < kRestAngle;
}

std::optional<PartRef> WorldView::held() const { return imagined_ ? imagined_->part : world_->grasped(); }

Transform WorldView::world_from_tip() const { return imagined_ ? imagined_->world_from_tip : world_->world_from_tip(); }

double WorldView::opening() const { return imagined_ ? imagined_->opening : world_->opening(); }

WorldView::Judged WorldView::grasped(std::string_view name) const {
  const Object& thing = object(name);
  const bool held = in_hand(*this, thing);
  const double depth = -box_distance(name, world_from_tip().translation());
  return {held, held ? std::max(0.0, depth) : std::min(0.0, depth)};
}

std::string WorldView::grasped_object() const {
  const std::optional<PartRef> part = held();
  if (!part) return {};
  std::string whole;
  for (const Object& thing : scene().objects) {
    if (!owns(thing, *part)) continue;
    if (thing.kind == ObjectKind::part) return thing.name;  // the part is more exact than its body
    whole = thing.name;
  }
  return whole;
}

bool WorldView::inside(std::string_view region_name, std::string_view name, bool whole) const {
  const Transform region_from_object = world_from(region_name).inverse() * world_from(name);
  const Vector3 half = size(region_name) / 2;
  if (!whole) return (region_from_object.translation().cwiseAbs() - half).maxCoeff() <= 0;
  const Vector3 reach = region_from_object.linear().cwiseAbs() * size(name) / 2;
  return (region_from_object.translation().cwiseAbs() + reach - half).maxCoeff() <= 1e-3;
}

double WorldView::region_distance(std::string_view region_name, const Vector3& point) const {
  return signed_distance((world_from(region_name).inverse() * point).cwiseAbs() - size(region_name) / 2);
}

double WorldView::box_distance(std::string_view name, const Vector3& point) const {
  const Object& thing = object(name);
  const int body = body_of(thing);
  if (thing.kind == ObjectKind::region || thing.kind == ObjectKind::hand || body < 0)
    return region_distance(name, point);
  const Box& box = parts_[static_cast<std::size_t>(body)][static_cast<std::size_t>(thing.part)];
  const Vector3 middle = (box.low + box.high) / 2;
  return signed_distance((world_from(thing).inverse() * point - middle).cwiseAbs() - (box.high - middle));
}

void WorldView::close_frame() {
  std::vector<Transform> poses;
  for (std::size_t body = 0; body < scene().bodies.size(); ++body)
    poses.push_back(world_->world_from_part({static_cast<int>(body), 0}));
  history_.poses.push_back(std::move(poses));
  if (history_.poses.size() > kRestFrames) history_.poses.pop_front();
}

Scene scene_as_it_is(const WorldView& view) {
  Scene scene = view.scene();
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    Body& body = scene.bodies[i];
    const int index = static_cast<int>(i);
    if (body.free) body.world_from_body = view.world().world_from_part({index, 0});
    for (std::size_t part = 1; part < body.parts.size(); ++part)
      if (body.parts[part].joint.kind != JointKind::fixed)
        body.parts[part].joint.initial = view.world().joint_position({index, static_cast<int>(part)});
  }
  return scene;
}

}  // namespace stampede
