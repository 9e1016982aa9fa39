#include "engine/start/draft.h"

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/sim/world.h"

namespace stampede {

Draft::Draft(Scene scene) : scene_(std::move(scene)) { rebuild(); }

Placement Draft::place(const Placement& placement) {
  const Object* thing = scene_.object(placement.object);
  if (thing == nullptr) throw Error("", "sample placed '" + placement.object + "', which the scene does not have");
  if (const double* position = std::get_if<double>(&placement.value)) {
    Body& body = scene_.bodies[static_cast<std::size_t>(scene_.body_index(thing->body))];
    double& initial = body.parts[static_cast<std::size_t>(thing->part)].joint.initial;
    const Placement before{placement.object, std::exchange(initial, *position)};
    rebuild();
    return before;
  }
  return put(placement, *thing);
}

Placement Draft::put(const Placement& placement, const Object& thing) {
  const Transform& pose = std::get<Transform>(placement.value);
  if (thing.kind == ObjectKind::region) {
    Region& region = scene_.regions[static_cast<std::size_t>(scene_.region_index(thing.name))];
    const Placement before{placement.object, region.part_from_region};
    region.part_from_region = region.body.empty() ? pose : region.part_from_region;
    rebuild();
    return before;
  }
  const int index = scene_.body_index(thing.body);
  Body& body = scene_.bodies[static_cast<std::size_t>(index)];
  const Placement before{placement.object, body.world_from_body};
  body.world_from_body = pose;
  if (!body.free || carries(body)) {
    rebuild();
    return before;
  }
  world_->apply(operation::Place{index, pose});
  state_->move_body(index, pose);
  return before;
}

bool Draft::carries(const Body& body) const {
  return std::any_of(scene_.bodies.begin(), scene_.bodies.end(),
                     [&](const Body& other) { return other.joined_to == body.name; });
}

void Draft::rebuild() {
  world_ = std::make_unique<World>(std::make_shared<const Scene>(scene_));
  view_ = std::make_unique<WorldView>(*world_);
  state_ = world_->collision_state();
}

}  // namespace stampede
