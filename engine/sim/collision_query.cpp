#include "engine/sim/collision_query.h"

#include <algorithm>
#include <utility>

#include "engine/sim/depth.h"

namespace stampede {
namespace {

constexpr double kRestGap = 0.001;  // m: what a body rests on may be this much nearer than anything else

bool boxes_apart(const Vector3& lower_a, const Vector3& upper_a, const Vector3& lower_b, const Vector3& upper_b,
                 double distance) {
  bool apart = false;
  for (int axis = 0; axis < 3; ++axis)
    apart = apart | (lower_a[axis] > upper_b[axis] + distance) | (lower_b[axis] > upper_a[axis] + distance);
  return apart;
}

}  // namespace

CollisionQuery::CollisionQuery(const CollisionState& state, double padding_m)
    : state_(state),
      model_(*state.model_),
      padding_(padding_m),
      arm_alone_(arm_alone(state)),
      positions_(state.robot_positions_),
      robot_(model_.robot.size()) {
  const Robot& robot = model_.scene->robot;
  for (const int finger : robot.fingers)
    positions_[static_cast<std::size_t>(finger)] = state.opening_ / static_cast<double>(robot.fingers.size());
  allowed_.assign(model_.bodies.size(), false);
  if (!state.allowed_.empty())
    for (std::size_t i = 0; i < model_.bodies.size(); ++i)
      allowed_[i] =
          std::find(state.allowed_.begin(), state.allowed_.end(), model_.bodies[i].part) != state.allowed_.end();
  near_.reserve(model_.bodies.size());
  if (!state.held_) return;
  const CollisionModel::Range held = model_.body_pieces[static_cast<std::size_t>(*state.held_)];
  held_begin_ = held.begin;
  held_end_ = held.end;
  carried_.resize(held.end - held.begin);
}

void CollisionQuery::place(Placed& placed, const CollisionModel::Piece& piece, const Transform& world_from_part) {
  placed.world_from_shape = product(world_from_part, piece.part_from_shape);
  const Vector3 centre = placed.world_from_shape * piece.convex.box_centre;
  const Vector3 reach = placed.world_from_shape.linear().cwiseAbs() * piece.convex.box_half;
  placed.lower = centre - reach;
  placed.upper = centre + reach;
}

void CollisionQuery::place_robot() {
  const Robot& robot = model_.scene->robot;
  forward_kinematics(robot.body, robot.body.world_from_body, positions_, poses_);
  for (std::size_t i = 0; i < robot_.size(); ++i)
    place(robot_[i], model_.robot[i], poses_[static_cast<std::size_t>(model_.robot[i].part.part)]);
}

Transform CollisionQuery::world_from_tip_now() const {
  const Robot& robot = model_.scene->robot;
  return poses_[static_cast<std::size_t>(robot.tip_part)] * robot.tip_part_from_tip;
}

Transform CollisionQuery::world_from_carried() const { return world_from_tip_now() * state_.tip_from_held_; }

void CollisionQuery::place_carried() {
  const Transform world_from_held = world_from_carried();
  for (std::size_t i = held_begin_; i < held_end_; ++i)
    place(carried_[i - held_begin_], model_.bodies[i], world_from_held);
}

void CollisionQuery::set_positions(const JointVector& q) {
  const Robot& robot = model_.scene->robot;
  for (std::size_t j = 0; j < robot.arm.size(); ++j)
    positions_[static_cast<std::size_t>(robot.arm[j])] = q[static_cast<Eigen::Index>(j)];
}

// One box around all that moves leaves out most of what stands about, for all pieces of the robot at once.
void CollisionQuery::find_near() {
  Vector3 lower = Vector3::Constant(1e9), upper = -lower;
  const auto add = [&](const Placed& placed) {
    lower = lower.cwiseMin(placed.lower);
    upper = upper.cwiseMax(placed.upper);
  };
  for (std::size_t i = 0; i < robot_.size(); ++i)
    if (model_.moved[static_cast<std::size_t>(model_.robot[i].part.part)]) add(robot_[i]);
  for (const Placed& placed : carried_) add(placed);
  find_near(lower, upper, padding_);
}

void CollisionQuery::find_near(Vector3 lower, Vector3 upper, double reach) {
  near_.clear();
  for (std::size_t i = 0; i < state_.pieces_.size(); ++i) {
    if (i >= held_begin_ && i < held_end_) continue;
    const Placed& placed = state_.pieces_[i];
    if (!boxes_apart(lower, upper, placed.lower, placed.upper, reach)) near_.push_back(static_cast<std::uint32_t>(i));
  }
}

bool CollisionQuery::near(const Piece& a, const Placed& at_a, const Piece& b, const Placed& at_b,
                          double distance) const {
  if (boxes_apart(at_a.lower, at_a.upper, at_b.lower, at_b.upper, distance)) return false;
  return closer_than(a.convex, at_a.world_from_shape, b.convex, at_b.world_from_shape, distance);
}

bool CollisionQuery::touches(const JointVector& q, double padding_m) {
  const double own = std::exchange(padding_, padding_m);
  const bool touching = visit(q, [](const CollisionPair&) { return true; });
  padding_ = own;
  return touching;
}

bool CollisionQuery::links_within(const JointVector& q, double distance_m) {
  set_positions(q);
  place_robot();
  return visit_links(distance_m, [](const CollisionPair&) { return true; });
}

void CollisionQuery::pose(const JointVector& q) {
  set_positions(q);
  const Robot& robot = model_.scene->robot;
  forward_kinematics(robot.body, robot.body.world_from_body, positions_, poses_);
}

CollisionQuery::Placed CollisionQuery::placed(std::size_t piece, bool held) const {
  Placed result;
  if (held)
    place(result, model_.bodies[piece], world_from_carried());
  else
    place(result, model_.robot[piece], poses_[static_cast<std::size_t>(model_.robot[piece].part.part)]);
  return result;
}

bool CollisionQuery::meets_body(std::size_t piece, bool held, std::size_t body_piece, double padding_m) {
  return near(held ? model_.bodies[piece] : model_.robot[piece], placed(piece, held), model_.bodies[body_piece],
              state_.pieces_[body_piece], padding_m);
}

bool CollisionQuery::meets_itself(std::size_t piece, bool held, std::size_t other, bool other_held) {
  return near(held ? model_.bodies[piece] : model_.robot[piece], placed(piece, held),
              other_held ? model_.bodies[other] : model_.robot[other], placed(other, other_held), 0);
}

double CollisionQuery::depth(const CollisionPair& pair) const {
  struct Shown {
    const Piece* piece;
    Transform pose;
  };
  const auto shapes = [&](PartRef part) {
    std::vector<Shown> shown;
    for (std::size_t i = 0; i < robot_.size(); ++i)
      if (model_.robot[i].part == part) shown.push_back({&model_.robot[i], robot_[i].world_from_shape});
    for (std::size_t i = 0; i < state_.pieces_.size(); ++i) {
      const bool carried = i >= held_begin_ && i < held_end_;
      if (model_.bodies[i].part == part)
        shown.push_back(
            {&model_.bodies[i], (carried ? carried_[i - held_begin_] : state_.pieces_[i]).world_from_shape});
    }
    return shown;
  };
  double most = 0;
  for (const Shown& one : shapes(pair.robot_part))
    for (const Shown& other : shapes(pair.other))
      most = std::max(most, depth_between(one.piece->convex, one.pose, other.piece->convex, other.pose));
  return most;
}

bool CollisionQuery::hand_free(const Transform& world_from_tip) {
  const Robot& robot = model_.scene->robot;
  forward_kinematics(robot.body, robot.body.world_from_body, positions_, poses_);
  const Transform moved = world_from_tip * world_from_tip_now().inverse();
  find_near(Vector3::Constant(-1e9), Vector3::Constant(1e9), 0);
  for (std::size_t i = 0; i < robot_.size(); ++i) {
    const auto part = static_cast<std::size_t>(model_.robot[i].part.part);
    if (!model_.hand[part]) continue;
    place(robot_[i], model_.robot[i], moved * poses_[part]);
    if (meets_bodies(model_.robot[i], robot_[i], model_.grips[part] && !state_.held_.has_value(),
                     [](const CollisionPair&) { return true; }))
      return false;
  }
  return true;
}

void CollisionQuery::arm_as_it_was() {
  const std::vector<int>& arm = model_.scene->robot.arm;
  for (const int part : arm)
    positions_[static_cast<std::size_t>(part)] = state_.robot_positions_[static_cast<std::size_t>(part)];
  place_robot();
}

// Tested a little higher than asked, so that what it rests on is just out of reach, with padding or without.
std::optional<PartRef> CollisionQuery::body_contact(int body, const Transform& world_from_body) {
  const Vector3& gravity = model_.scene->gravity;
  const Vector3 up = gravity.squaredNorm() > 0 ? Vector3(-gravity.normalized()) : Vector3::UnitZ();
  const Transform raised = translation(up * (padding_ + kRestGap)) * world_from_body;
  const CollisionModel::Range range = model_.body_pieces.at(static_cast<std::size_t>(body));
  const std::size_t first = model_.part_0[static_cast<std::size_t>(body)];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    const Piece& piece = model_.bodies[i];
    Placed tried;
    place(tried, piece, raised * state_.body_from_part_[first + static_cast<std::size_t>(piece.part.part)]);
    for (std::size_t k = 0; k < model_.bodies.size(); ++k)
      if ((k < range.begin || k >= range.end) && near(piece, tried, model_.bodies[k], state_.pieces_[k], padding_))
        return model_.bodies[k].part;
    for (std::size_t k = 0; k < robot_.size(); ++k)
      if (near(piece, tried, model_.robot[k], robot_[k], padding_)) return model_.robot[k].part;
  }
  return std::nullopt;
}

}  // namespace stampede
