// A start under construction: a scene in which things are put one after the other, and a frozen world of it to ask.
#pragma once

#include <memory>
#include <optional>

#include "engine/sim/collision_state.h"
#include "engine/start/predicates.h"
#include "engine/start/world_view.h"

namespace stampede {

class Draft {
 public:
  explicit Draft(Scene scene);

  const Scene& scene() const { return scene_; }
  const WorldView& view() const { return *view_; }                   // valid until the next place()
  const CollisionState& collision_state() const { return *state_; }  // likewise

  // Puts a thing there, or a part's joint. Result: what takes that back. Throws Error: the scene has no such thing.
  Placement place(const Placement& placement);

 private:
  bool carries(const Body& body) const;  // another body is joined to it
  Placement put(const Placement& placement, const Object& thing);
  void rebuild();

  Scene scene_;
  std::unique_ptr<World> world_;
  std::unique_ptr<WorldView> view_;
  std::optional<CollisionState> state_;
};

}  // namespace stampede
