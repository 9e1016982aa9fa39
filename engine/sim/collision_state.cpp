#include "engine/sim/collision_state.h"

#include <algorithm>

#include "engine/base/error.h"
#include "engine/model/body_tree.h"
#include "engine/sim/collision_query.h"
#include "engine/sim/configuration_checker.h"

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
  each_piece_loaded_on({body, 0}, [&](std::size_t i) { place(i, translation(0, 0, -100)); });
  held_ = body;
  tip_from_held_ = tip_from_body;
}

void CollisionState::move_body(int body, const Transform& world_from_body) {
  const CollisionModel::Range range = model_->body_pieces.at(static_cast<std::size_t>(body));
  const std::size_t first = model_->part_0[static_cast<std::size_t>(body)];
  for (std::size_t i = range.begin; i < range.end; ++i)
    place(i, world_from_body * body_from_part_[first + static_cast<std::size_t>(model_->bodies[i].part.part)]);
}

template <typename Use>
void CollisionState::each_piece_on(PartRef part, const Use& use) {
  const Body& body = scene().bodies.at(static_cast<std::size_t>(part.body));
  const CollisionModel::Range range = model_->body_pieces[static_cast<std::size_t>(part.body)];
  for (std::size_t i = range.begin; i < range.end; ++i)
    if (hangs_on(body, model_->bodies[i].part.part, part.part)) use(i);
}

template <typename Use>
void CollisionState::each_piece_loaded_on(PartRef part, const Use& use) {
  if (loads_.empty()) return;
  for (const int body : borne_by(scene(), loads_, part)) {
    const CollisionModel::Range range = model_->body_pieces[static_cast<std::size_t>(body)];
    for (std::size_t i = range.begin; i < range.end; ++i) use(i);
  }
}

void CollisionState::move_part(PartRef part, const Transform& motion) {
  const auto move = [&](std::size_t i) {
    place(i, motion * pieces_[i].world_from_shape * model_->bodies[i].part_from_shape.inverse());
  };
  each_piece_on(part, move);
  each_piece_loaded_on(part, move);
}

void CollisionState::remove(PartRef part) {
  const auto take_away = [&](std::size_t i) { place(i, translation(0, 0, -100)); };
  each_piece_on(part, take_away);
  each_piece_loaded_on(part, take_away);
}

void CollisionState::allow_touched(PartRef part, const JointVector& q) {
  constexpr double kNear_m = 0.003;  // fingers about to close
  CollisionQuery query(*this);
  query.pose(q);
  std::vector<std::size_t> touched;
  each_piece_on(part, [&](std::size_t i) {
    for (std::size_t piece = 0; piece < model_->robot.size(); ++piece)
      if (query.meets_body(piece, false, i, kNear_m)) {
        touched.push_back(i);
        break;
      }
  });
  for (const std::size_t i : touched) place(i, translation(0, 0, -100));
  std::erase(allowed_, part);
}

bool CollisionState::free(const JointVector& q, double padding_m) const {
  return !CollisionQuery(*this, padding_m).touches(q);
}

bool CollisionState::links_within(const JointVector& q, double distance_m) const {
  return CollisionQuery(*this).links_within(q, distance_m);
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

std::size_t CollisionState::first_touching(std::span<const JointVector> configurations, double padding_m) const {
  return ConfigurationChecker(*this).first_touching(configurations,
                                                    std::vector<double>(configurations.size(), padding_m));
}

bool CollisionState::hand_free(const Transform& world_from_tip, double padding_m) const {
  return CollisionQuery(*this, padding_m).hand_free(world_from_tip);
}

bool CollisionState::body_free(int body, const Transform& world_from_body, double padding_m) const {
  return places_free(body, {&world_from_body, 1}, padding_m).front();
}

std::optional<PartRef> CollisionState::body_contact(int body, const Transform& world_from_body,
                                                    double padding_m) const {
  CollisionQuery query(*this, padding_m);
  query.arm_as_it_was();
  return query.body_contact(body, world_from_body);
}

std::vector<bool> CollisionState::places_free(int body, std::span<const Transform> world_from_body,
                                              double padding_m) const {
  CollisionQuery query(*this, padding_m);
  query.arm_as_it_was();
  std::vector<bool> free;
  for (const Transform& place : world_from_body) free.push_back(!query.body_contact(body, place));
  return free;
}

}  // namespace stampede
