// What predicates, skills and tests may read of a world, by the names that people use.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/sim/world.h"

namespace stampede {

class FactTracker;

// Reads a world; keeps a short history per frame for tests of rest. Contacts are those of the last frame.
// Throws Error for names that the scene does not have, with the nearest name as cure.
class WorldView {
 public:
  explicit WorldView(World& world);
  const World& world() const { return *world_; }
  const Scene& scene() const { return world_->scene(); }
  const Object& object(std::string_view name) const;
  double time_s() const;

  Transform world_from(std::string_view object) const;  // body, part, region centre, or the hand's tip
  Transform world_from(const Object& object) const;     // the same, of one of the scene's
  Vector3 velocity(std::string_view object) const;      // linear, world, m/s
  Vector3 size(std::string_view object) const;          // bounding box in its own frame, m
  double bottom(std::string_view object) const;         // lowest and highest world z of its bounding box, m
  double top(std::string_view object) const;

  double joint(std::string_view part) const;           // position, rad or m
  double joint_fraction(std::string_view part) const;  // 0 at the lower limit … 1 at the upper
  double joint_velocity(std::string_view part) const;
  std::pair<double, double> joint_range(std::string_view part) const;

  Transform part_at(std::string_view part, double position) const;  // world pose with its joint elsewhere

  bool touching(std::string_view a, std::string_view b) const;
  double contact_force(std::string_view a, std::string_view b) const;  // mean normal, N
  // The upward share of contact force on `object` that comes from `surface`: at least a quarter of its weight, and
  // the hand does not hold it.
  bool supports(std::string_view surface, std::string_view object) const;
  bool at_rest(
      std::string_view object) const;  // moved less than 1 mm and 1 deg in 0.25 s, relative to what supports it
  bool grasped(std::string_view object) const;  // by friction between the pads
  std::string grasped_object() const;           // or empty
  double opening() const;                       // m
  // Is the centre (or with `whole` the bounding box) of `object` inside the region?
  bool inside(std::string_view region, std::string_view object, bool whole = false) const;
  // Signed distance of a point to the region's box, negative inside, m.
  double region_distance(std::string_view region, const Vector3& point) const;

  void close_frame();  // after World::close_window: extends the history
  struct History {
    std::deque<std::vector<Transform>> poses;  // per frame, per scene body
  };
  const History& history() const { return history_; }
  void restore(History history) { history_ = std::move(history); }
  void attach(World& world) { world_ = &world; }

  // The symbols of this moment beside the raw state, where a run keeps them; else null. Predicates never read them.
  const FactTracker* facts() const { return facts_; }
  void set_facts(const FactTracker* facts) { facts_ = facts; }

  // The free body's object that a body index stands for; empty: a fixture part etc.
  PartRef part_of(std::string_view object) const;
  bool owns(const Object& object, PartRef part) const;  // does a contact on `part` count as on `object`?

 private:
  int body_of(const Object& object) const;  // index of its body; -1: none

  World* world_;
  const FactTracker* facts_ = nullptr;
  std::map<std::string, int, std::less<>> index_;  // object name -> index in scene().objects
  std::vector<int> bodies_;                        // of each of them, the index of its body; -1: none
  History history_;
};

}  // namespace stampede
