#include "engine/sim/collision_model.h"

#include <algorithm>

namespace stampede {
namespace {

void add_pieces(std::vector<CollisionModel::Piece>& pieces, const Part& part, PartRef ref) {
  for (const Shape& shape : part.shapes)
    if (shape.collides) pieces.push_back({Convex(shape), ref, shape.part_from_shape});
}

}  // namespace

CollisionModel::CollisionModel(std::shared_ptr<const Scene> scene_in) : scene(std::move(scene_in)), arm(scene->robot) {
  const Robot& panda = scene->robot;
  const auto parts = panda.body.parts.size();
  moved.assign(parts, false);
  hand.assign(parts, false);
  grips.assign(parts, false);
  joints.assign(parts, 0);
  for (std::size_t p = 0; p < parts; ++p) {
    const Part& part = panda.body.parts[p];
    const std::size_t begin = robot.size();
    add_pieces(robot, part, {-1, static_cast<int>(p)});
    robot_parts.push_back({begin, robot.size()});
    const bool driven = std::find(panda.arm.begin(), panda.arm.end(), static_cast<int>(p)) != panda.arm.end();
    moved[p] = driven || (part.parent >= 0 && moved[static_cast<std::size_t>(part.parent)]);
    joints[p] = (driven ? 1 : 0) + (part.parent >= 0 ? joints[static_cast<std::size_t>(part.parent)] : 0);
    hand[p] = part.parent >= 0 && (part.parent == panda.arm.back() || hand[static_cast<std::size_t>(part.parent)]);
  }
  hand[static_cast<std::size_t>(panda.tip_part)] = true;
  for (std::size_t p = 0; p < parts; ++p) {
    const bool finger =
        std::find(panda.fingers.begin(), panda.fingers.end(), static_cast<int>(p)) != panda.fingers.end();
    const int parent = panda.body.parts[p].parent;
    grips[p] = finger || (parent >= 0 && grips[static_cast<std::size_t>(parent)]) || (panda.fingers.empty() && hand[p]);
  }
  for (const auto& [one, two] : panda.checked_pairs) {
    if (hand[static_cast<std::size_t>(two)] && !hand[static_cast<std::size_t>(one)]) held_partners.push_back(one);
    if (hand[static_cast<std::size_t>(one)] && !hand[static_cast<std::size_t>(two)]) held_partners.push_back(two);
  }
  std::sort(held_partners.begin(), held_partners.end());
  held_partners.erase(std::unique(held_partners.begin(), held_partners.end()), held_partners.end());
  std::size_t first_part = 0;
  for (std::size_t b = 0; b < scene->bodies.size(); ++b) {
    const Body& body = scene->bodies[b];
    const std::size_t begin = bodies.size();
    for (std::size_t p = 0; p < body.parts.size(); ++p)
      add_pieces(bodies, body.parts[p], {static_cast<int>(b), static_cast<int>(p)});
    body_pieces.push_back({begin, bodies.size()});
    part_0.push_back(first_part);
    first_part += body.parts.size();
  }
}

}  // namespace stampede
