// One thread's working memory for questions to one CollisionState. Room-internal.
#pragma once

#include <algorithm>
#include <cstdlib>

#include "engine/sim/collision_model.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/depth.h"

namespace stampede {

// Allowed of a state in which the arm alone counts: no part that there is.
constexpr PartRef kWhateverTheHandMeets{1 << 30, 0};

// Lifetime: borrows the state, which must not change meanwhile.
class CollisionQuery {
 public:
  using Placed = CollisionState::Placed;
  explicit CollisionQuery(const CollisionState& state, double padding_m = 0);

  bool touches(const JointVector& q) { return touches(q, padding_); }
  bool touches(const JointVector& q, double padding_m);
  bool links_within(const JointVector& q, double distance_m);  // a joint between them
  // The same in parts: after pose(), single pairs of pieces may be asked about, the robot's or what it holds.
  void pose(const JointVector& q);
  const std::vector<Transform>& poses() const { return poses_; }  // of the robot's parts
  bool meets_body(std::size_t piece, bool held, std::size_t body_piece, double padding_m);
  bool meets_itself(std::size_t piece, bool held, std::size_t other, bool other_held);
  // Calls visitor(pair) for what touches, in a fixed order, until it says true: enough.
  template <typename Visitor>
  bool visit(const JointVector& q, const Visitor& visitor);

  double depth(const CollisionPair& pair) const;  // of a pair that visit() has just shown, m
  static bool arm_alone(const CollisionState& state) {
    return std::find(state.allowed_.begin(), state.allowed_.end(), kWhateverTheHandMeets) != state.allowed_.end();
  }
  // Calls visitor(a, b, depth_of) for pieces of two bodies whose boxes share more than `most_m` along each axis.
  template <typename Visitor>
  static void visit_bodies(const CollisionState& state, double most_m, const Visitor& visitor);
  bool hand_free(const Transform& world_from_tip);
  void arm_as_it_was();  // before body_contact
  std::optional<PartRef> body_contact(int body, const Transform& world_from_body);

  static void place(Placed& placed, const CollisionModel::Piece& piece, const Transform& world_from_part);

 private:
  using Piece = CollisionModel::Piece;
  Placed placed(std::size_t piece, bool held) const;
  void set_positions(const JointVector& q);
  template <typename Visitor>
  bool visit_placed(const Visitor& visitor) const;
  void place_robot();
  void place_carried();
  Transform world_from_tip_now() const;
  Transform world_from_carried() const;
  void find_near(Vector3 lower, Vector3 upper, double reach);
  void find_near();
  bool near(const Piece& a, const Placed& at_a, const Piece& b, const Placed& at_b, double distance) const;
  template <typename Visitor>
  bool meets_bodies(const Piece& piece, const Placed& placed, bool may_touch, const Visitor& visitor) const;
  template <typename Visitor>
  bool meets_part(const Piece& piece, const Placed& placed, int robot_part, double distance,
                  const Visitor& visitor) const;
  template <typename Visitor>
  bool visit_links(double distance_a_joint, const Visitor& visitor) const;

  const CollisionState& state_;
  const CollisionModel& model_;
  double padding_;
  bool arm_alone_;
  std::vector<double> positions_;  // of all robot parts
  std::vector<Transform> poses_;
  std::vector<Placed> robot_, carried_;
  std::vector<bool> allowed_;        // per piece of the bodies
  std::vector<std::uint32_t> near_;  // pieces of bodies within the box around all that moves, in order
  std::size_t held_begin_ = 0, held_end_ = 0;
};

template <typename Visitor>
bool CollisionQuery::meets_bodies(const Piece& piece, const Placed& placed, bool may_touch,
                                  const Visitor& visitor) const {
  for (const std::uint32_t i : near_) {
    if (may_touch && allowed_[i]) continue;
    if (near(piece, placed, model_.bodies[i], state_.pieces_[i], padding_) &&
        visitor(CollisionPair{piece.part, model_.bodies[i].part}))
      return true;
  }
  return false;
}

template <typename Visitor>
bool CollisionQuery::meets_part(const Piece& piece, const Placed& placed, int robot_part, double distance,
                                const Visitor& visitor) const {
  const CollisionModel::Range range = model_.robot_parts[static_cast<std::size_t>(robot_part)];
  for (std::size_t i = range.begin; i < range.end; ++i)
    if (near(piece, placed, model_.robot[i], robot_[i], distance) &&
        visitor(CollisionPair{piece.part, model_.robot[i].part}))
      return true;
  return false;
}

template <typename Visitor>
bool CollisionQuery::visit_links(double distance_a_joint, const Visitor& visitor) const {
  for (const auto& [one, two] : model_.scene->robot.checked_pairs) {
    const CollisionModel::Range range = model_.robot_parts[static_cast<std::size_t>(one)];
    const int between =
        std::abs(model_.joints[static_cast<std::size_t>(two)] - model_.joints[static_cast<std::size_t>(one)]);
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (meets_part(model_.robot[i], robot_[i], two, between * distance_a_joint, visitor)) return true;
  }
  return false;
}

template <typename Visitor>
bool CollisionQuery::visit(const JointVector& q, const Visitor& visitor) {
  set_positions(q);
  place_robot();
  if (state_.held_) place_carried();
  find_near();
  return visit_placed(visitor);
}

template <typename Visitor>
bool CollisionQuery::visit_placed(const Visitor& visitor) const {
  const bool holding = state_.held_.has_value();
  for (std::size_t i = 0; i < robot_.size(); ++i) {
    const auto part = static_cast<std::size_t>(model_.robot[i].part.part);
    if (arm_alone_ && model_.hand[part]) continue;
    if (model_.moved[part] && meets_bodies(model_.robot[i], robot_[i], model_.grips[part] && !holding, visitor))
      return true;
  }
  if (visit_links(0, visitor)) return true;
  for (std::size_t i = held_begin_; i < held_end_; ++i) {
    const Placed& placed = carried_[i - held_begin_];
    if (!arm_alone_ && meets_bodies(model_.bodies[i], placed, true, visitor)) return true;
    for (const int part : model_.held_partners)
      if (meets_part(model_.bodies[i], placed, part, 0, visitor)) return true;
  }
  return false;
}

template <typename Visitor>
void CollisionQuery::visit_bodies(const CollisionState& state, double most_m, const Visitor& visitor) {
  const std::vector<Piece>& pieces = state.model_->bodies;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    for (std::size_t k = i + 1; k < pieces.size(); ++k) {
      const Placed &one = state.pieces_[i], &other = state.pieces_[k];
      if (pieces[i].part.body == pieces[k].part.body) continue;
      if ((one.upper.cwiseMin(other.upper) - one.lower.cwiseMax(other.lower)).minCoeff() <= most_m) continue;
      visitor(pieces[i].part, pieces[k].part, [&] {
        return depth_between(pieces[i].convex, one.world_from_shape, pieces[k].convex, other.world_from_shape);
      });
    }
}

}  // namespace stampede
