#include "engine/sim/collision_space.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/convex.h"
#include "engine/sim/impl.h"

namespace stampede {
namespace {

constexpr double kRestGap = 0.001;  // m: what a body rests on may be this much nearer than anything else

// One convex shape of a part, where it is in the world, and its bounding box there.
struct Piece {
  Convex convex;
  PartRef part;
  Transform part_from_shape;
  Transform world_from_shape = Transform::Identity();
  Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();

  void place(const Transform& world_from_part) {
    world_from_shape = world_from_part * part_from_shape;
    const Vector3 centre = world_from_shape * convex.box_centre;
    const Vector3 reach = world_from_shape.linear().cwiseAbs() * convex.box_half;
    lower = centre - reach;
    upper = centre + reach;
  }
};

bool near(const Piece& a, const Piece& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.lower[axis] > b.upper[axis] + distance || b.lower[axis] > a.upper[axis] + distance) return false;
  return closer_than(a.convex, a.world_from_shape, b.convex, b.world_from_shape, distance);
}

void add_pieces(std::vector<Piece>& pieces, const Part& part, PartRef ref) {
  for (const Shape& shape : part.shapes)
    if (shape.collides) pieces.push_back({Convex(shape), ref, shape.part_from_shape});
}

struct BodyState {
  Transform world_from_body = Transform::Identity();
  std::vector<Transform> body_from_part;
};

class ExactCollisionSpace final : public CollisionSpace {
 public:
  explicit ExactCollisionSpace(const World::Impl& world);

  const Scene& scene() const override { return *scene_; }
  const Arm& arm() const override { return arm_; }
  void hold(int body, const Transform& tip_from_body) override;
  void release() override { held_.reset(); }
  std::optional<int> held() const override { return held_; }
  void allow(PartRef part) override { allowed_.push_back(part); }
  std::vector<PartRef> allowed() const override { return allowed_; }
  void clear_allowed() override { allowed_.clear(); }
  void set_opening(double opening_m) override { opening_ = opening_m; }
  void set_padding(double padding_m) override { padding_ = padding_m; }
  void move_body(int body, const Transform& world_from_body) override;
  void remove(PartRef part) override;
  bool free(const JointVector& q) override { return !search(q, nullptr); }
  std::optional<CollisionPair> first_contact(const JointVector& q) override;
  bool body_free(int body, const Transform& world_from_body, double padding_m) override;

 private:
  struct Range {
    std::size_t begin = 0, end = 0;
  };
  void find_hand();
  void place_robot(const JointVector& q);
  bool search(const JointVector& q, CollisionPair* pair);
  bool meets_bodies(const Piece& piece, bool of_hand, CollisionPair* pair) const;
  bool meets_part(const Piece& piece, int robot_part, CollisionPair* pair) const;

  std::shared_ptr<const Scene> scene_;
  Arm arm_;
  std::vector<double> positions_;  // of all robot parts, those not driven as they were
  JointVector frozen_arm_;
  double opening_ = 0, padding_ = 0;
  std::vector<Transform> robot_poses_;
  std::vector<Piece> robot_;        // in part order
  std::vector<Range> robot_parts_;  // pieces of each part
  std::vector<bool> moved_, hand_;  // per robot part: moves with the arm; behind its last joint
  std::vector<int> held_partners_;  // robot parts that a held body is tested against
  std::vector<BodyState> states_;
  std::vector<Piece> bodies_;       // of all bodies, in body and part order
  std::vector<Range> body_pieces_;  // pieces of each body
  std::vector<PartRef> allowed_;    // few: searched in order
  std::optional<int> held_;
  Transform tip_from_held_ = Transform::Identity();
  std::vector<Piece> carried_;  // the held body's, moving with the tip
  std::vector<Piece> tried_;    // body_free's scratch
};

ExactCollisionSpace::ExactCollisionSpace(const World::Impl& world)
    : scene_(world.scene), arm_(world.arm), frozen_arm_(world.arm_position_now()) {
  const Robot& robot = scene_->robot;
  for (int p = 0; p < static_cast<int>(robot.body.parts.size()); ++p) {
    positions_.push_back(world.position({kRobot, p}));
    const std::size_t begin = robot_.size();
    add_pieces(robot_, robot.body.parts[static_cast<std::size_t>(p)], {kRobot, p});
    robot_parts_.push_back({begin, robot_.size()});
  }
  for (const int finger : robot.fingers) opening_ += positions_[static_cast<std::size_t>(finger)];
  find_hand();
  for (int b = 0; b < static_cast<int>(scene_->bodies.size()); ++b) {
    const Body& body = scene_->bodies[static_cast<std::size_t>(b)];
    BodyState state;
    state.world_from_body = world.world_from_part({b, 0});
    const std::size_t begin = bodies_.size();
    for (int p = 0; p < static_cast<int>(body.parts.size()); ++p) {
      state.body_from_part.push_back(state.world_from_body.inverse() * world.world_from_part({b, p}));
      add_pieces(bodies_, body.parts[static_cast<std::size_t>(p)], {b, p});
    }
    body_pieces_.push_back({begin, bodies_.size()});
    states_.push_back(state);
    for (std::size_t i = begin; i < bodies_.size(); ++i) bodies_[i].place(world.world_from_part(bodies_[i].part));
  }
}

void ExactCollisionSpace::find_hand() {
  const Robot& robot = scene_->robot;
  const auto parts = robot.body.parts.size();
  moved_.assign(parts, false);
  hand_.assign(parts, false);
  for (std::size_t p = 0; p < parts; ++p) {
    const int parent = robot.body.parts[p].parent;
    const bool driven = std::find(robot.arm.begin(), robot.arm.end(), static_cast<int>(p)) != robot.arm.end();
    moved_[p] = driven || (parent >= 0 && moved_[static_cast<std::size_t>(parent)]);
    hand_[p] = parent >= 0 && (parent == robot.arm.back() || hand_[static_cast<std::size_t>(parent)]);
  }
  hand_[static_cast<std::size_t>(robot.tip_part)] = true;
  for (const auto& [one, two] : robot.checked_pairs) {
    if (hand_[static_cast<std::size_t>(two)] && !hand_[static_cast<std::size_t>(one)]) held_partners_.push_back(one);
    if (hand_[static_cast<std::size_t>(one)] && !hand_[static_cast<std::size_t>(two)]) held_partners_.push_back(two);
  }
  std::sort(held_partners_.begin(), held_partners_.end());
  held_partners_.erase(std::unique(held_partners_.begin(), held_partners_.end()), held_partners_.end());
}

void ExactCollisionSpace::hold(int body, const Transform& tip_from_body) {
  if (!scene_->bodies.at(static_cast<std::size_t>(body)).free)
    throw Error("CollisionSpace::hold", "body " + std::to_string(body) + " is not free", "hold free bodies only");
  held_ = body;
  tip_from_held_ = tip_from_body;
  const Range range = body_pieces_[static_cast<std::size_t>(body)];
  carried_.assign(bodies_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                  bodies_.begin() + static_cast<std::ptrdiff_t>(range.end));
}

void ExactCollisionSpace::move_body(int body, const Transform& world_from_body) {
  BodyState& state = states_.at(static_cast<std::size_t>(body));
  state.world_from_body = world_from_body;
  const Range range = body_pieces_[static_cast<std::size_t>(body)];
  for (std::size_t i = range.begin; i < range.end; ++i)
    bodies_[i].place(world_from_body * state.body_from_part[static_cast<std::size_t>(bodies_[i].part.part)]);
}

void ExactCollisionSpace::remove(PartRef part) {
  const std::vector<Part>& parts = scene_->bodies.at(static_cast<std::size_t>(part.body)).parts;
  const Range range = body_pieces_[static_cast<std::size_t>(part.body)];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    int above = bodies_[i].part.part;
    while (above > 0 && above != part.part) above = std::max(0, parts[static_cast<std::size_t>(above)].parent);
    if (above == part.part) bodies_[i].place(translation(0, 0, -100));
  }
}

void ExactCollisionSpace::place_robot(const JointVector& q) {
  const Robot& robot = scene_->robot;
  for (std::size_t j = 0; j < robot.arm.size(); ++j)
    positions_[static_cast<std::size_t>(robot.arm[j])] = q[static_cast<Eigen::Index>(j)];
  for (const int finger : robot.fingers)
    positions_[static_cast<std::size_t>(finger)] = opening_ / static_cast<double>(robot.fingers.size());
  forward_kinematics(robot.body, robot.body.world_from_body, positions_, robot_poses_);
  for (Piece& piece : robot_) piece.place(robot_poses_[static_cast<std::size_t>(piece.part.part)]);
}

bool ExactCollisionSpace::meets_bodies(const Piece& piece, bool of_hand, CollisionPair* pair) const {
  for (std::size_t b = 0; b < body_pieces_.size(); ++b) {
    if (held_ == static_cast<int>(b)) continue;
    for (std::size_t i = body_pieces_[b].begin; i < body_pieces_[b].end; ++i) {
      if (of_hand && std::find(allowed_.begin(), allowed_.end(), bodies_[i].part) != allowed_.end()) continue;
      if (!near(piece, bodies_[i], padding_)) continue;
      if (pair) *pair = {piece.part, bodies_[i].part};
      return true;
    }
  }
  return false;
}

bool ExactCollisionSpace::meets_part(const Piece& piece, int robot_part, CollisionPair* pair) const {
  const Range range = robot_parts_[static_cast<std::size_t>(robot_part)];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    if (!near(piece, robot_[i], 0)) continue;
    if (pair) *pair = {piece.part, robot_[i].part};
    return true;
  }
  return false;
}

bool ExactCollisionSpace::search(const JointVector& q, CollisionPair* pair) {
  place_robot(q);
  for (const Piece& piece : robot_) {
    const auto part = static_cast<std::size_t>(piece.part.part);
    if (moved_[part] && meets_bodies(piece, hand_[part] && !held_, pair)) return true;
  }
  for (const auto& [one, two] : scene_->robot.checked_pairs) {
    const Range range = robot_parts_[static_cast<std::size_t>(one)];
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (meets_part(robot_[i], two, pair)) return true;
  }
  if (!held_) return false;
  const Robot& robot = scene_->robot;
  const Transform world_from_held =
      robot_poses_[static_cast<std::size_t>(robot.tip_part)] * robot.tip_part_from_tip * tip_from_held_;
  for (Piece& piece : carried_) {
    piece.place(world_from_held);
    if (meets_bodies(piece, true, pair)) return true;
    for (const int part : held_partners_)
      if (meets_part(piece, part, pair)) return true;
  }
  return false;
}

std::optional<CollisionPair> ExactCollisionSpace::first_contact(const JointVector& q) {
  CollisionPair pair;
  if (!search(q, &pair)) return std::nullopt;
  return pair;
}

// Tested a little higher than asked, so that what it rests on is just out of reach, with padding or without.
bool ExactCollisionSpace::body_free(int body, const Transform& world_from_body, double padding_m) {
  const Range range = body_pieces_.at(static_cast<std::size_t>(body));
  const BodyState& state = states_[static_cast<std::size_t>(body)];
  const Vector3 up = scene_->gravity.squaredNorm() > 0 ? Vector3(-scene_->gravity.normalized()) : Vector3::UnitZ();
  const Transform raised = translation(up * (padding_m + kRestGap)) * world_from_body;
  tried_.assign(bodies_.begin() + static_cast<std::ptrdiff_t>(range.begin),
                bodies_.begin() + static_cast<std::ptrdiff_t>(range.end));
  place_robot(frozen_arm_);
  for (Piece& piece : tried_) {
    piece.place(raised * state.body_from_part[static_cast<std::size_t>(piece.part.part)]);
    for (const Piece& other : bodies_)
      if (other.part.body != body && near(piece, other, padding_m)) return false;
    for (const Piece& other : robot_)
      if (near(piece, other, padding_m)) return false;
  }
  return true;
}

}  // namespace

std::unique_ptr<CollisionSpace> World::collision_space() const { return std::make_unique<ExactCollisionSpace>(*impl_); }

}  // namespace stampede
