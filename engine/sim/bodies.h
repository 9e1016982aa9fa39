// The scene's bodies as they are simulated, and where they are now. Private to engine/sim.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "engine/sim/collision_model.h"
#include "engine/sim/collision_state.h"
#include "engine/sim/contact_finder.h"
#include "engine/sim/movers.h"
#include "engine/sim/world.h"

namespace stampede {

// Where a part lives.
struct PartSlot {
  btCollisionObject* object = nullptr;  // its frame is the link's: centre of mass, principal axes
  Transform link_from_part = Transform::Identity();
  Articulation* tree = nullptr;  // null: it stands still, or is free
  int link = -1;                 // of the tree
  int dof = -1;                  // of the tree, where the part itself moves on a hinge or slider
};

struct BodySlot {
  std::vector<PartSlot> parts;
  Articulation* tree = nullptr;  // null: nothing of it moves on a joint
  FreeBody* free = nullptr;      // the one part of a free body; with more parts it is a floating tree
  Bond* bond = nullptr;          // by which the free body is joined to another

  bool floats() const { return tree != nullptr && tree->floating(); }
};

class Bodies {
 public:
  explicit Bodies(std::shared_ptr<const Scene> scene);
  // build_bodies.cpp: always in the same order, Bullet's ids follow it.
  void build(ContactFinder& finder, Movers& movers);

  const Scene& scene() const { return *scene_; }
  int count() const { return static_cast<int>(scene_->bodies.size()); }  // without the robot
  const Body& body(int index) const;
  const Part& part(PartRef ref) const { return body(ref.body).parts[static_cast<std::size_t>(ref.part)]; }
  BodySlot& body_slot(int index) { return slots_[static_cast<std::size_t>(index + 1)]; }
  const BodySlot& body_slot(int index) const { return slots_[static_cast<std::size_t>(index + 1)]; }
  const PartSlot& slot(PartRef ref) const { return body_slot(ref.body).parts[static_cast<std::size_t>(ref.part)]; }

  const Transform& world_from_part(PartRef ref) const;
  const std::vector<Transform>& world_from_robot_parts() const;
  Vector3 velocity(PartRef ref, Vector3* linear) const;  // angular; linear of the centre of mass
  double position(PartRef ref) const;
  bool joined(PartRef ref) const;   // to another body, which has not let go of it
  bool strains(PartRef ref) const;  // its joint is pressed beyond a stop
  CollisionState for_planning() const;

  std::vector<double> state() const;
  void set_state(const std::vector<double>& state);
  void moved() { ++stamp_; }  // whoever moves anything says so

 private:
  std::shared_ptr<const Scene> scene_;
  std::vector<BodySlot> slots_;                                    // the robot first, then the scene's
  mutable std::shared_ptr<const CollisionModel> collision_model_;  // made when first asked for
  mutable std::vector<std::vector<Transform>> poses_;              // body + 1, part
  mutable std::vector<std::vector<std::int64_t>> pose_stamps_;
  std::int64_t stamp_ = 1;  // poses with another one are stale
};

}  // namespace stampede
