// A frozen world that answers whether the arm may be somewhere. Independent of the World it came from.
#pragma once

#include <optional>
#include <vector>

#include "engine/sim/world.h"

namespace stampede {

struct CollisionPair {
  PartRef robot_part;  // body -1, or the held body
  PartRef other;
};

class CollisionSpace {
 public:
  virtual ~CollisionSpace() = default;
  virtual const Scene& scene() const = 0;
  virtual const Arm& arm() const = 0;

  // A body that moves with the tip from now on and collides in the arm's stead. `tip_from_body` is fixed.
  virtual void hold(int body, const Transform& tip_from_body) = 0;
  virtual void release() = 0;
  virtual std::optional<int> held() const = 0;
  // Contact between the empty hand, or what the hand holds, and this part does not count. clear_allowed() forgets all.
  virtual void allow(PartRef part) = 0;
  virtual std::vector<PartRef> allowed() const = 0;
  virtual void clear_allowed() = 0;
  virtual void set_opening(double opening_m) = 0;
  virtual void set_padding(double padding_m) = 0;  // obstacles grow by this; default 0
  virtual void move_body(int body, const Transform& world_from_body) = 0;
  virtual void remove(PartRef part) = 0;  // with all that hangs on it; of a base part, the whole body

  virtual bool free(const JointVector& q) = 0;                                   // no contact anywhere
  virtual std::optional<CollisionPair> first_contact(const JointVector& q) = 0;  // in a fixed order
  // Would this free body, placed here, touch anything but what it may rest on? Used by scene sampling.
  virtual bool body_free(int body, const Transform& world_from_body, double padding_m) = 0;
};

}  // namespace stampede
