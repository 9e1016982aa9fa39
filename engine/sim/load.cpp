#include "engine/sim/load.h"

#include <algorithm>
#include <map>

#include "engine/model/body_tree.h"
#include "engine/sim/world.h"

namespace stampede {

std::vector<Borne> loads(const World& world) {
  constexpr double kShare = 0.25;  // of a body's weight
  const Scene& scene = world.scene();
  const std::optional<PartRef> held = world.grasped();
  std::vector<std::map<PartRef, double>> upward(scene.bodies.size());  // N, by what bears
  const auto add = [&](PartRef above, PartRef below, double force) {
    if (above.body < 0 || below.body < 0 || !scene.body_at(above.body).free) return;
    if (held && held->body == above.body) return;
    upward[static_cast<std::size_t>(above.body)][below] += force;
  };
  for (const Contact& contact : world.contacts()) {
    add(contact.a, contact.b, contact.force.z());
    add(contact.b, contact.a, -contact.force.z());
  }
  std::vector<Borne> result;
  for (int b = 0; b < static_cast<int>(upward.size()); ++b) {
    const auto& by = upward[static_cast<std::size_t>(b)];
    const auto most = std::ranges::max_element(by, {}, [](const auto& one) { return one.second; });
    const double weight = scene.body_at(b).parts[0].mass * scene.gravity.norm();
    if (most != by.end() && most->second >= kShare * weight) result.push_back({most->first, b});
  }
  return result;
}

std::vector<int> borne_by(const Scene& scene, const std::vector<Borne>& loads, PartRef part) {
  const auto hangs_on_it = [&](PartRef one) {
    return one.body == part.body && hangs_on(scene.body_at(one.body), one.part, part.part);
  };
  std::vector<int> found;
  for (bool more = true; more;) {
    more = false;
    for (const Borne& load : loads) {
      const bool on_found = std::ranges::find(found, load.bearer.body) != found.end();
      if (std::ranges::find(found, load.body) != found.end() || load.body == part.body) continue;
      if (!on_found && !hangs_on_it(load.bearer)) continue;
      found.push_back(load.body);
      more = true;
    }
  }
  return found;
}

}  // namespace stampede
