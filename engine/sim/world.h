// One simulated scene: bodies, joints, contacts, the robot's controllers. One owner thread.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/model/operation.h"
#include "engine/model/part_ref.h"
#include "engine/model/scene.h"

namespace stampede {

// A touching pair over the last closed window (one frame). a < b.
struct Contact {
  PartRef a, b;
  double mean_force = 0, peak_force = 0;  // normal, N; mean over the window's steps
  double depth = 0;                       // by which the shapes overlapped at most, m
  Vector3 normal = Vector3::Zero();       // unit, world, from b to a, force-weighted
  Vector3 point = Vector3::Zero();        // world, force-weighted
  Vector3 force = Vector3::Zero();        // mean contact force on a, friction included, world, N
};

// What acts on a part: force N, and torque N m about its origin, both in its own axes.
struct Wrench {
  Vector3 force = Vector3::Zero(), torque = Vector3::Zero();
};

// What a ray meets first.
struct RayHit {
  PartRef part;
  double distance = 0;  // from the ray's start, m
};

// All that tells one moment of a world from another. Opaque, copyable, comparable by hash.
class Snapshot {
 public:
  struct Data;
  std::shared_ptr<const Data> data;
};

class CollisionState;

class World {
 public:
  explicit World(std::shared_ptr<const Scene> scene);
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  const Scene& scene() const;
  // `robot`: an index; throws Error for one that the scene does not have.
  const Arm& arm(int robot = 0) const;
  std::int64_t step_count() const;
  double dt() const;

  void apply(const Operation& operation);  // also appends to the log
  void step();                             // one physics step of 1/physics_hz
  std::vector<Command> log() const;        // since construction, or as restore left it
  void keep_log(bool keep);                // false: it is emptied, and stays so
  // What has come to rest and touches nothing that moves is not simulated until something meets it; facts, forces and
  // replay are the same. false: all is simulated all the time, for measurements.
  void let_sleep(bool sleep);

  // Poses are of part frames, not centres of mass.
  const Transform& world_from_part(PartRef part) const;  // current after each step
  Vector3 linear_velocity(PartRef part) const;           // of the centre of mass, world, m/s
  Vector3 angular_velocity(PartRef part) const;          // world, rad/s
  double joint_position(PartRef part) const;
  double joint_velocity(PartRef part) const;
  double joint_effort(PartRef part) const;  // applied by the motor or controller in the last step
  bool latched(PartRef part) const;
  bool joined(PartRef part) const;  // of a body that is joined to another: the joint has not let go of it

  JointVector arm_position(int robot = 0) const;
  JointVector arm_velocity(int robot = 0) const;
  JointState reference(int robot = 0) const;  // the arm's set-point at this step; under torques, where it is
  bool following(int robot = 0) const;        // the reference has not reached its trajectory's end
  bool steered(int robot = 0) const;          // a Servo is in force
  // What kept a steered arm from doing what its Servo asks for since it was last forgotten: any of speed, acceleration,
  // jerk, torque (of a joint), tool_speed, reference (it waits for an arm that does not get on), approach (something is
  // ahead, and is met slowly) and contact (the arm presses no harder).
  std::vector<std::string> limited(int robot = 0) const;
  void forget_limited();
  const operation::Controller& controller(int robot = 0) const;
  Transform world_from_tip(int robot = 0) const;
  double opening(int robot = 0) const;  // m
  double commanded_opening(int robot = 0) const;

  // Contacts of the last closed window; close_window() ends one (called once per frame).
  const std::vector<Contact>& contacts() const;
  void close_window();
  // The body held by friction in the last window: both pads touch it, at least 0.5 N mean each, normals opposed
  // within 45 degrees. Nothing: std::nullopt.
  std::optional<PartRef> grasped(int robot = 0) const;

  // What contacts did in the last step to `robot_part` and all parts beyond it, from the outside: the hand, the fingers
  // and, through the pads, what they hold. As a wrist sensor reads that was tared with an empty hand: weight and
  // inertia of the robot's own parts are left out, and so is what these parts do to each other. Zero until a step was
  // made after construction, restore or Boundary.
  Wrench contact_wrench(int robot_part) const;

  // Against the shapes that collide, as they are now. Nothing: std::nullopt.
  std::optional<RayHit> ray(const Vector3& from, const Vector3& to) const;

  // Restoring gives the same future, bit for bit, also in another World of an equal scene. Snapshots are taken
  // right after a Boundary operation. Restore also shortens the log to its length at the snapshot.
  Snapshot snapshot() const;
  void restore(const Snapshot& snapshot);
  std::string state_hash() const;  // of all positions and velocities

  // The world as it is now, for questions of motion planning: a value that knows nothing of this world any more.
  CollisionState collision_state() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
