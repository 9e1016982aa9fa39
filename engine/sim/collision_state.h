// Whether the arm may be somewhere: a moment of a world as a value, and the questions asked of it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "engine/model/kinematics.h"
#include "engine/model/part_ref.h"
#include "engine/sim/load.h"

namespace stampede {

struct CollisionModel;

struct CollisionPair {
  PartRef robot_part;  // body -1, or the held body
  PartRef other;
};

// Where bodies are, what the hand holds and what does not count. The shapes themselves belong to a model that is made
// once per scene and shared, so a state is cheap to make and to copy; it knows nothing of the World it came from.
// Questions leave it as it is and may be asked from several threads. Repeatable. Units: m, rad.
class CollisionState {
 public:
  // `world_from_part`: of all parts of all bodies but the robot, in order; `robot_positions`: one joint position a
  // part.
  CollisionState(std::shared_ptr<const CollisionModel> model, std::span<const Transform> world_from_part,
                 std::vector<double> robot_positions);

  const Scene& scene() const;
  const Arm& arm() const;

  // What rests on what: move_part() and remove() take it along, and what is held holds its load, which does not
  // collide.
  void set_loads(std::vector<Borne> loads) { loads_ = std::move(loads); }
  // A free body that moves with the tip from now on and collides in the arm's stead. Throws for a body that is fixed.
  void hold(int body, const Transform& tip_from_body);
  void release() { held_.reset(); }
  std::optional<int> held() const { return held_; }
  // Contact between the fingers of the empty hand, or what the hand holds, and this part does not count.
  // clear_allowed() forgets all.
  void allow(PartRef part) { allowed_.push_back(part); }
  const std::vector<PartRef>& allowed() const { return allowed_; }
  void clear_allowed() { allowed_.clear(); }
  void set_opening(double opening_m) { opening_ = opening_m; }
  double opening() const { return opening_; }
  void move_body(int body, const Transform& world_from_body);
  // These two with all that hangs on the part; of a base part, the whole body. `motion`: in the world's frame.
  void move_part(PartRef part, const Transform& motion);
  void remove(PartRef part);
  // Of this part only the shapes do not count that the arm touches at `q`, a handle in the hand: all others do.
  void allow_touched(PartRef part, const JointVector& q);

  // Obstacles grow by `padding_m`; the robot against itself is tested without.
  bool free(const JointVector& q, double padding_m = 0) const;
  std::optional<CollisionPair> first_contact(const JointVector& q, double padding_m = 0) const;  // in a fixed order
  std::vector<CollisionPair> contacts(const JointVector& q, double padding_m = 0) const;         // each pair once
  // Do two links that can meet come as near to each other as this for each of the arm's joints between them?
  bool links_within(const JointVector& q, double distance_m) const;
  // Index of the first configuration that touches something; configurations.size() when none does. See
  // ConfigurationChecker, which keeps its tables from call to call.
  std::size_t first_touching(std::span<const JointVector> configurations, double padding_m = 0) const;

  // Would the empty hand, with its tip there, touch any body? Wherever the rest of the arm may be.
  bool hand_free(const Transform& world_from_tip, double padding_m = 0) const;

  // Would this free body, placed there, touch anything but what it may rest on? The arm is where it was, the fingers
  // as open as the state says.
  bool body_free(int body, const Transform& world_from_body, double padding_m) const;
  std::optional<PartRef> body_contact(int body, const Transform& world_from_body, double padding_m) const;  // with what
  // The same for many places: one answer each.
  std::vector<bool> places_free(int body, std::span<const Transform> world_from_body, double padding_m) const;

 private:
  friend class CollisionQuery;
  friend class ConfigurationChecker;
  struct Placed {  // a piece of a body: its pose and its bounding box
    Transform world_from_shape = Transform::Identity();
    Vector3 lower = Vector3::Zero(), upper = Vector3::Zero();
  };
  void place(std::size_t piece, const Transform& world_from_part);
  template <typename Use>
  void each_piece_on(PartRef part, const Use& use);
  template <typename Use>
  void each_piece_loaded_on(PartRef part, const Use& use);

  std::shared_ptr<const CollisionModel> model_;
  std::vector<Placed> pieces_;             // of all bodies, in the model's order
  std::vector<Transform> body_from_part_;  // of all bodies, in body and part order
  std::vector<double> robot_positions_;    // of all robot parts
  double opening_ = 0;                     // m
  std::vector<Borne> loads_;               // bodies, by what bears them
  std::vector<PartRef> allowed_;           // few: searched in order
  std::optional<int> held_;
  Transform tip_from_held_ = Transform::Identity();
};

}  // namespace stampede
