// Bubbles of free space: how far each link is from contact, and how far it can move.
#include <algorithm>
#include <cmath>

#include "engine/sim/collision_query.h"

namespace stampede {
namespace {

constexpr double kFar = 0.3;      // m: no link needs to be further from contact
constexpr double kAmple = 0.03;   // m: boxes that are so far apart are not looked at more closely
constexpr double kWanted = 0.03;  // m: nor shapes
constexpr double kTight = 1e-3;   // m: a bubble with less is not worth its name
constexpr double kSlack = 1e-7;   // m, for rounding

double box_gap(const Vector3& lower_a, const Vector3& upper_a, const Vector3& lower_b, const Vector3& upper_b) {
  return (lower_a - upper_b).cwiseMax(lower_b - upper_a).cwiseMax(0.0).norm();
}

double ball_gap(const Vector3& centre, double radius, const Vector3& lower, const Vector3& upper) {
  return (lower - centre).cwiseMax(centre - upper).cwiseMax(0.0).norm() - radius;
}

}  // namespace

const CollisionQuery::Piece& CollisionQuery::piece_of(const Lump& lump, std::size_t piece) const {
  return lump.held ? model_.bodies[piece] : model_.robot[piece];
}

const CollisionQuery::Placed& CollisionQuery::placed_of(const Lump& lump, std::size_t piece) const {
  return lump.held ? carried_[piece - held_begin_] : robot_[piece];
}

void CollisionQuery::list_lumps() {
  lumps_.reserve(model_.robot_parts.size() + 1);
  meetings_.reserve(model_.scene->robot.checked_pairs.size() + model_.held_partners.size());
  const Robot& robot = model_.scene->robot;
  const auto add = [&](int part, int joints, bool held, CollisionModel::Range pieces) {
    Lump& lump = lumps_.emplace_back();
    lump.part = part;
    lump.joints = joints;
    lump.held = held;
    lump.pieces = pieces;
    Vector3 lower = Vector3::Constant(1e9), upper = -lower;
    for (std::size_t i = pieces.begin; i < pieces.end; ++i) {
      Placed placed;
      place(placed, piece_of(lump, i), Transform::Identity());
      lower = lower.cwiseMin(placed.lower);
      upper = upper.cwiseMax(placed.upper);
    }
    lump.middle = (lower + upper) / 2;
    lump.radius = (upper - lower).norm() / 2;
  };
  for (std::size_t p = 0; p < model_.robot_parts.size(); ++p)
    add(static_cast<int>(p), model_.joints[p], false, model_.robot_parts[p]);
  const auto add_meeting = [&](std::size_t a, std::size_t b) {
    if (lumps_[a].pieces.begin == lumps_[a].pieces.end || lumps_[b].pieces.begin == lumps_[b].pieces.end) return;
    if (lumps_[a].joints > lumps_[b].joints) std::swap(a, b);
    meetings_.push_back({a, b, 0});
  };
  for (const auto& [one, two] : robot.checked_pairs)
    add_meeting(static_cast<std::size_t>(one), static_cast<std::size_t>(two));
  if (state_.held_) {
    add(robot.tip_part, static_cast<int>(robot.arm.size()), true, CollisionModel::Range{held_begin_, held_end_});
    for (const int part : model_.held_partners) add_meeting(static_cast<std::size_t>(part), lumps_.size() - 1);
  }
  placed_.resize(lumps_.size());
}

void CollisionQuery::place_lump(std::size_t index) {
  if (placed_[index]) return;
  placed_[index] = true;
  const Lump& lump = lumps_[index];
  if (lump.held) return place_carried();
  for (std::size_t i = lump.pieces.begin; i < lump.pieces.end; ++i)
    place(robot_[i], model_.robot[i], poses_[static_cast<std::size_t>(lump.part)]);
}

// The ball around a lump, and how far the joints are from what is farthest in it.
void CollisionQuery::measure(Lump& lump) const {
  lump.centre = (lump.held ? world_from_carried() : poses_[static_cast<std::size_t>(lump.part)]) * lump.middle;
  const std::vector<int>& arm = model_.scene->robot.arm;
  for (std::size_t j = 0; j < static_cast<std::size_t>(lump.joints); ++j)
    lump.reach[j] = (lump.centre - poses_[static_cast<std::size_t>(arm[j])].translation()).norm() + lump.radius;
}

bool CollisionQuery::clear_of_bodies(std::size_t index) {
  Lump& lump = lumps_[index];
  lump.clearance = kFar;
  if (lump.joints == 0) return true;
  const bool may_touch =
      lump.held ||
      (model_.hand[static_cast<std::size_t>(piece_of(lump, lump.pieces.begin).part.part)] && !state_.held_);
  for (const std::uint32_t k : near_) {
    if (may_touch && allowed_[k]) continue;
    const Placed& body = state_.pieces_[k];
    if (ball_gap(lump.centre, lump.radius, body.lower, body.upper) - padding_ >= lump.clearance) continue;
    place_lump(index);
    for (std::size_t i = lump.pieces.begin; i < lump.pieces.end; ++i) {
      const Placed& placed = placed_of(lump, i);
      double gap = box_gap(placed.lower, placed.upper, body.lower, body.upper);
      if (gap - padding_ >= lump.clearance) continue;
      if (gap < kAmple)
        gap = std::max(gap, gap_between(piece_of(lump, i).convex, placed.world_from_shape, model_.bodies[k].convex,
                                        body.world_from_shape, kWanted));
      lump.clearance = std::min(lump.clearance, gap - padding_);
      if (gap - padding_ < kTight && closer_than(piece_of(lump, i).convex, placed.world_from_shape,
                                                 model_.bodies[k].convex, body.world_from_shape, padding_))
        return false;
    }
  }
  return true;
}

bool CollisionQuery::clear_of_each_other(Meeting& meeting) {
  const Lump &one = lumps_[meeting.one], &other = lumps_[meeting.other];
  meeting.clearance = (one.centre - other.centre).norm() - one.radius - other.radius;
  if (meeting.clearance >= kWanted) return true;
  meeting.clearance = kWanted;
  place_lump(meeting.one);
  place_lump(meeting.other);
  for (std::size_t i = one.pieces.begin; i < one.pieces.end; ++i)
    for (std::size_t k = other.pieces.begin; k < other.pieces.end; ++k) {
      const Placed &at_i = placed_of(one, i), &at_k = placed_of(other, k);
      double gap = box_gap(at_i.lower, at_i.upper, at_k.lower, at_k.upper);
      if (gap >= meeting.clearance) continue;
      if (gap < kAmple)
        gap = std::max(gap, gap_between(piece_of(one, i).convex, at_i.world_from_shape, piece_of(other, k).convex,
                                        at_k.world_from_shape, kWanted));
      meeting.clearance = std::min(meeting.clearance, gap);
      if (gap < kTight && closer_than(piece_of(one, i).convex, at_i.world_from_shape, piece_of(other, k).convex,
                                      at_k.world_from_shape, 0))
        return false;
    }
  return true;
}

CollisionQuery::Found CollisionQuery::find_bubble(const JointVector& q) {
  if (lumps_.empty()) list_lumps();
  bubble_ = q;
  set_positions(q);
  const Robot& robot = model_.scene->robot;
  forward_kinematics(robot.body, robot.body.world_from_body, positions_, poses_);
  std::fill(placed_.begin(), placed_.end(), false);
  Vector3 lower = Vector3::Constant(1e9), upper = -lower;
  for (Lump& lump : lumps_) {
    if (lump.pieces.begin == lump.pieces.end) continue;
    measure(lump);
    if (lump.joints == 0) continue;
    lower = lower.cwiseMin((lump.centre.array() - lump.radius).matrix());
    upper = upper.cwiseMax((lump.centre.array() + lump.radius).matrix());
  }
  find_near(lower, upper, padding_ + kFar);
  double least = kFar;
  for (std::size_t i = lumps_.size(); i-- > 0;) {  // the hand first: it is what meets things
    if (lumps_[i].pieces.begin == lumps_[i].pieces.end) continue;
    if (!clear_of_bodies(i)) return Found::touching;
    least = std::min(least, lumps_[i].clearance);
  }
  for (Meeting& meeting : meetings_) {
    if (!clear_of_each_other(meeting)) return Found::touching;
    least = std::min(least, meeting.clearance);
  }
  return least < kTight ? Found::free : Found::bubble;
}

// How far a point of the lump can be from where it was in the bubble's middle, seen from the link before `first_joint`.
// Joints are turned one after the other, the last first: each then finds the point as much further away as those before
// have moved it.
double CollisionQuery::drift(const Lump& lump, int first_joint, const JointVector& q) const {
  double moved = 0;
  for (int j = lump.joints - 1; j >= first_joint; --j)
    moved += std::abs(q[j] - bubble_[j]) * (lump.reach[static_cast<std::size_t>(j)] + moved);
  return moved;
}

bool CollisionQuery::in_bubble(const JointVector& q) const {
  for (const Lump& lump : lumps_)
    if (lump.pieces.begin != lump.pieces.end && drift(lump, 0, q) + kSlack > lump.clearance) return false;
  return std::all_of(meetings_.begin(), meetings_.end(), [&](const Meeting& meeting) {
    return drift(lumps_[meeting.other], lumps_[meeting.one].joints, q) + kSlack <= meeting.clearance;
  });
}

}  // namespace stampede
