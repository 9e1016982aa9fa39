#include "engine/sim/collision_state.h"

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/sim/collision_query.h"

namespace stampede {

CollisionState::CollisionState(std::shared_ptr<const CollisionModel> model, std::span<const Transform> world_from_part,
                               std::vector<double> robot_positions)
    : model_(std::move(model)), pieces_(model_->bodies.size()), robot_positions_(std::move(robot_positions)) {
  for (const int finger : scene().robot.fingers) opening_ += robot_positions_[static_cast<std::size_t>(finger)];
  body_from_part_.reserve(world_from_part.size());
  for (std::size_t b = 0; b < model_->part_0.size(); ++b) {
    const std::size_t first = model_->part_0[b];
    const Transform body_from_world = world_from_part[first].inverse();
    for (std::size_t p = 0; p < scene().bodies[b].parts.size(); ++p)
      body_from_part_.push_back(body_from_world * world_from_part[first + p]);
    const CollisionModel::Range range = model_->body_pieces[b];
    for (std::size_t i = range.begin; i < range.end; ++i)
      place(i, world_from_part[first + static_cast<std::size_t>(model_->bodies[i].part.part)]);
  }
}

const Scene& CollisionState::scene() const { return *model_->scene; }
const Arm& CollisionState::arm() const { return model_->arm; }

void CollisionState::place(std::size_t piece, const Transform& world_from_part) {
  CollisionQuery::place(pieces_[piece], model_->bodies[piece], world_from_part);
}

void CollisionState::hold(int body, const Transform& tip_from_body) {
  if (!scene().bodies.at(static_cast<std::size_t>(body)).free)
    throw Error("CollisionState::hold", "body " + std::to_string(body) + " is not free", "hold free bodies only");
  held_ = body;
  tip_from_held_ = tip_from_body;
}

void CollisionState::move_body(int body, const Transform& world_from_body) {
  const CollisionModel::Range range = model_->body_pieces.at(static_cast<std::size_t>(body));
  const std::size_t first = model_->part_0[static_cast<std::size_t>(body)];
  for (std::size_t i = range.begin; i < range.end; ++i)
    place(i, world_from_body * body_from_part_[first + static_cast<std::size_t>(model_->bodies[i].part.part)]);
}

void CollisionState::remove(PartRef part) {
  const std::vector<Part>& parts = scene().bodies.at(static_cast<std::size_t>(part.body)).parts;
  const CollisionModel::Range range = model_->body_pieces[static_cast<std::size_t>(part.body)];
  for (std::size_t i = range.begin; i < range.end; ++i) {
    int above = model_->bodies[i].part.part;
    while (above > 0 && above != part.part) above = std::max(0, parts[static_cast<std::size_t>(above)].parent);
    if (above == part.part) place(i, translation(0, 0, -100));
  }
}

bool CollisionState::free(const JointVector& q, double padding_m) const {
  return !CollisionQuery(*this, padding_m).touches(q);
}

std::optional<CollisionPair> CollisionState::first_contact(const JointVector& q, double padding_m) const {
  std::optional<CollisionPair> found;
  CollisionQuery(*this, padding_m).visit(q, [&](const CollisionPair& pair) {
    found = pair;
    return true;
  });
  return found;
}

std::vector<CollisionPair> CollisionState::contacts(const JointVector& q, double padding_m) const {
  std::vector<CollisionPair> all;
  CollisionQuery(*this, padding_m).visit(q, [&](const CollisionPair& pair) {
    const bool known = std::any_of(all.begin(), all.end(), [&](const CollisionPair& other) {
      return other.robot_part == pair.robot_part && other.other == pair.other;
    });
    if (!known) all.push_back(pair);
    return false;
  });
  return all;
}

// What comes next is often in the bubble of what was looked at last.
std::size_t CollisionState::first_touching(std::span<const JointVector> configurations, double padding_m) const {
  CollisionQuery query(*this, padding_m);
  std::size_t i = 0;
  while (i < configurations.size()) {
    const CollisionQuery::Found found = query.find_bubble(configurations[i]);
    if (found == CollisionQuery::Found::touching) return i;
    ++i;
    if (found == CollisionQuery::Found::bubble)
      while (i < configurations.size() && query.in_bubble(configurations[i])) ++i;
  }
  return i;
}

// The middle of the longest stretches first; a bubble there leaves less on both sides.
bool CollisionState::edge_free(const JointVector& a, const JointVector& b, double step_rad, double padding_m) const {
  CollisionQuery query(*this, padding_m);
  const double gap = a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff();
  const int count = std::max(1, static_cast<int>(std::ceil(gap / step_rad)));
  const auto sample = [&](int i) -> JointVector {
    return i == count ? b : a + (static_cast<double>(i) / count) * (b - a);
  };
  // How many further samples in a direction are in the bubble about sample i.
  const auto covered = [&](int i, int direction, int most) {
    int known = 0, beyond = most + 1;
    while (known + 1 < beyond) {
      const int tried = known == 0 && beyond > most ? most : (known + beyond) / 2;
      (query.in_bubble(sample(i + direction * tried)) ? known : beyond) = tried;
    }
    return known;
  };
  std::vector<std::pair<int, int>> stretches;
  const auto look = [&](int i, int first, int last) {
    const CollisionQuery::Found found = query.find_bubble(sample(i));
    if (found == CollisionQuery::Found::touching) return false;
    const bool bubble = found == CollisionQuery::Found::bubble;
    const int before = i - (bubble ? covered(i, -1, i - first) : 0), after = i + (bubble ? covered(i, 1, last - i) : 0);
    if (first < before) stretches.emplace_back(first, before - 1);
    if (after < last) stretches.emplace_back(after + 1, last);
    return true;
  };
  if (!look(count, 1, count)) return false;
  for (std::size_t next = 0; next < stretches.size(); ++next) {
    const auto [first, last] = stretches[next];
    if (!look(first + (last - first) / 2, first, last)) return false;
  }
  return true;
}

bool CollisionState::body_free(int body, const Transform& world_from_body, double padding_m) const {
  return places_free(body, {&world_from_body, 1}, padding_m).front();
}

std::vector<bool> CollisionState::places_free(int body, std::span<const Transform> world_from_body,
                                              double padding_m) const {
  CollisionQuery query(*this, padding_m);
  query.arm_as_it_was();
  std::vector<bool> free;
  for (const Transform& place : world_from_body) free.push_back(query.body_free(body, place));
  return free;
}

}  // namespace stampede
