// What predicates, skills and tests may read of a world, by the names that people use.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/model/part_ref.h"
#include "engine/model/scene.h"

namespace stampede {

class FactTracker;
class World;

// Reads a world; keeps a short history per frame for tests of rest. Contacts are those of the last frame.
// Throws Error for names that the scene does not have, with the nearest name as cure.
class WorldView {
 public:
  explicit WorldView(World& world);
  const World& world() const { return *world_; }
  const Scene& scene() const;
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
  // Whether something holds, and by how much: not negative while it does, not positive while it does not, m.
  struct Judged {
    bool holds = false;
    double margin = 0;
  };
  // Contact with `surface` bears at least a quarter of the object's weight; of what is in the hand too, any of it that
  // comes from below. Margin: how far the object's middle is from the edge of the surface's box, seen from above; else
  // minus the way from its foot to the top of that box.
  Judged supports(std::string_view surface, std::string_view object) const;
  bool at_rest(
      std::string_view object) const;  // moved less than 1 mm and 1 deg in 0.25 s, relative to what supports it
  // By friction between the pads. Margin: how deep the tip is in the object's box; else minus the way to it.
  Judged grasped(std::string_view object) const;
  // Grasped, and nothing but the hand touches it. Margin: how deep it could fall; while it is not in the hand, that of
  // grasped().
  Judged carried(std::string_view object) const;
  std::string grasped_object() const;  // or empty

  // What the hand holds, and from where: as it is, or as it is imagined. Then `grasped`, the hand's pose and what draws
  // read of the hand are of that moment, and all else of the world as it is.
  struct Held {
    PartRef part;
    Transform world_from_tip;
    double opening = 0;  // m
  };
  void imagine(std::optional<Held> held) { imagined_ = held; }
  std::optional<PartRef> held() const;
  Transform world_from_tip() const;
  double opening() const;  // m
  // Is the centre (or with `whole` the bounding box) of `object` inside the region?
  bool inside(std::string_view region, std::string_view object, bool whole = false) const;
  // Signed distance of a point to the region's box, negative inside, m.
  double region_distance(std::string_view region, const Vector3& point) const;
  double box_distance(std::string_view object, const Vector3& point) const;  // the same, of its bounding box

  void close_frame();  // after World::close_window: extends the history
  struct History {
    std::deque<std::vector<Transform>> poses;  // per frame, per scene body
  };
  const History& history() const { return history_; }
  void restore(History history) { history_ = std::move(history); }

  // The symbols of this moment beside the raw state, where a run keeps them; else null. Predicates never read them.
  const FactTracker* facts() const { return facts_; }
  void set_facts(const FactTracker* facts) { facts_ = facts; }

  // The free body's object that a body index stands for; empty: a fixture part etc.
  PartRef part_of(std::string_view object) const;
  bool owns(const Object& object, PartRef part) const;  // does a contact on `part` count as on `object`?

 private:
  int body_of(const Object& object) const;  // index of its body; -1: none
  double drop_below(const Object& object) const;
  std::array<Vector3, 2> bounds_of(PartRef part) const;  // of a body's part in the world

  World* world_;
  const FactTracker* facts_ = nullptr;
  std::optional<Held> imagined_;
  std::map<std::string, int, std::less<>> index_;  // object name -> index in scene().objects
  std::vector<int> bodies_;                        // of each of them, the index of its body; -1: none
  struct Box {
    PartRef part;
    Vector3 low, high;  // in the part's frame
  };
  std::vector<std::vector<Box>> parts_;  // bounding boxes by body and part
  std::vector<Box> shapes_;              // of all shapes that bodies collide with
  History history_;
};

// The scene as it is now, but for the robots' arms: what a fresh world starts from.
Scene scene_as_it_is(const WorldView& view);

}  // namespace stampede
