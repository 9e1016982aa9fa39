#include "engine/start/impasse.h"

#include "engine/sim/world.h"
#include "engine/start/fact_tracker.h"

namespace stampede {

SceneState state_of(const WorldView& view) {
  const World& world = view.world();
  const Scene& scene = view.scene();
  SceneState state = initial_state(scene);
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const int body = static_cast<int>(b);
    state.world_from_body[b] = world.world_from_part({body, 0});
    for (std::size_t p = 1; p < scene.bodies[b].parts.size(); ++p)
      if (scene.bodies[b].parts[p].joint.kind != JointKind::fixed)
        state.joint_position[b][p] = world.joint_position({body, static_cast<int>(p)});
  }
  for (std::size_t p = 1; p < scene.robot.body.parts.size(); ++p)
    if (scene.robot.body.parts[p].joint.kind != JointKind::fixed)
      state.robot_position[p] = world.joint_position(PartRef::of_robot(static_cast<int>(p)));
  for (std::size_t i = 0; i < scene.regions.size(); ++i)
    if (scene.regions[i].body.empty()) state.world_from_region[i] = view.world_from(scene.regions[i].name);
  if (view.facts() != nullptr)
    for (const std::vector<std::string>& words : facts_that_show(scene))
      if (view.facts()->facts().contains({words[0], {words.begin() + 1, words.end()}})) state.facts.insert(words);
  return state;
}

}  // namespace stampede
