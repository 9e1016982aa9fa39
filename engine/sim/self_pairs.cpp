#include "engine/sim/self_pairs.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <numbers>
#include <string>

#include "engine/model/kinematics.h"
#include "engine/sim/collision_model.h"

namespace stampede {
namespace {

constexpr int kCounted = 256;        // samples at which every pair is looked at
constexpr int kSamples = 4096;       // and those that have not met by then
constexpr double kAlways = 0.95;     // share of them at which a pair touches, and so is taken for one that always does
constexpr double kNearly_m = 0.005;  // what comes nearer may meet between the samples

// The i-th number of van der Corput's sequence in a base: together, of different primes, Halton's points.
double halton(int i, int base) {
  double value = 0, digit = 1.0 / base;
  for (; i > 0; i /= base, digit /= base) value += digit * (i % base);
  return value;
}

class Sampling {
 public:
  explicit Sampling(const Robot& robot) : scene_(std::make_shared<Scene>()) {
    auto scene = std::make_shared<Scene>();
    scene->robot = robot;
    scene->robot.checked_pairs.clear();
    model_ = std::make_unique<CollisionModel>(scene);
    scene_ = std::move(scene);
    for (const Part& part : robot.body.parts) positions_.push_back(part.joint.initial);
    for (int a = 0; a < count(); ++a)
      for (int b = a + 1; b < count(); ++b)
        if (worth_asking(a, b)) pairs_.push_back({a, b});
  }

  std::vector<std::pair<int, int>> run() {
    for (int i = 0; i < kSamples && !pairs_.empty(); ++i) {
      set_joints(i);
      forward_kinematics(robot().body, Transform::Identity(), positions_, poses_);
      for (Pair& pair : pairs_)
        if (i < kCounted || pair.met == 0) look(pair);
      if (i + 1 < kCounted) continue;
      for (const Pair& pair : pairs_)
        if (pair.met > 0 && pair.touching < kAlways * kCounted) found_.emplace_back(pair.a, pair.b);
      std::erase_if(pairs_, [](const Pair& pair) { return pair.met > 0; });
    }
    std::sort(found_.begin(), found_.end());
    return std::move(found_);
  }

 private:
  struct Pair {
    int a = 0, b = 0;
    int met = 0, touching = 0;  // samples: nearly, and truly
  };

  const Robot& robot() const { return scene_->robot; }
  int count() const { return static_cast<int>(robot().body.parts.size()); }
  int parent(int part) const { return robot().body.parts[static_cast<std::size_t>(part)].parent; }
  bool solid(int part) const {
    const CollisionModel::Range range = model_->robot_parts[static_cast<std::size_t>(part)];
    return range.begin < range.end;
  }
  bool driven(int part) const { return std::ranges::find(robot().arm, part) != robot().arm.end(); }

  // The part on the way from one to the other at which both ways to the base meet.
  int common(int a, int b) const {
    while (a != b) (a > b ? a : b) = std::max(0, parent(std::max(a, b)));
    return a;
  }

  bool worth_asking(int a, int b) const {
    if (!solid(a) || !solid(b)) return false;
    const int meeting = common(a, b);
    bool moved = false, between = meeting != a && meeting != b && solid(meeting);
    for (const int end : {a, b})
      for (int part = end; part != meeting; part = std::max(0, parent(part))) {
        moved = moved || driven(part);
        between = between || (part != end && solid(part));
      }
    return moved && between;
  }

  void set_joints(int i) {
    static constexpr int kPrimes[] = {2, 3, 5, 7, 11, 13, 17, 19, 23, 29, 31, 37, 41, 43, 47, 53, 59};
    int prime = 0;
    const auto draw = [&](double lower, double upper) {
      if (!(lower < upper)) lower = -std::numbers::pi, upper = std::numbers::pi;
      return lower + (upper - lower) * halton(i, kPrimes[prime++]);
    };
    for (std::size_t j = 0; j < robot().arm.size(); ++j)
      positions_[static_cast<std::size_t>(robot().arm[j])] = draw(robot().limits[j].lower, robot().limits[j].upper);
    for (const int finger : robot().fingers) {  // coupled: all as far open
      const Joint& joint = robot().body.parts[static_cast<std::size_t>(finger)].joint;
      positions_[static_cast<std::size_t>(finger)] =
          joint.lower + (joint.upper - joint.lower) * halton(i, kPrimes[prime]);
    }
  }

  void look(Pair& pair) const {
    const bool near = closer(pair, kNearly_m);
    pair.met += near;
    pair.touching += near && closer(pair, 0);
  }

  bool closer(const Pair& pair, double distance) const {
    const CollisionModel::Range a = model_->robot_parts[static_cast<std::size_t>(pair.a)],
                                b = model_->robot_parts[static_cast<std::size_t>(pair.b)];
    for (std::size_t i = a.begin; i < a.end; ++i)
      for (std::size_t k = b.begin; k < b.end; ++k)
        if (closer(model_->robot[i], model_->robot[k], distance)) return true;
    return false;
  }

  bool closer(const CollisionModel::Piece& a, const CollisionModel::Piece& b, double distance) const {
    const Transform at_a = product(poses_[static_cast<std::size_t>(a.part.part)], a.part_from_shape),
                    at_b = product(poses_[static_cast<std::size_t>(b.part.part)], b.part_from_shape);
    const double reach = a.convex.box_half.norm() + b.convex.box_half.norm() + distance;
    if ((at_a * a.convex.box_centre - at_b * b.convex.box_centre).squaredNorm() > reach * reach) return false;
    return closer_than(a.convex, at_a, b.convex, at_b, distance);
  }

  std::shared_ptr<const Scene> scene_;
  std::unique_ptr<CollisionModel> model_;
  std::vector<double> positions_;  // of all parts
  std::vector<Transform> poses_;
  std::vector<Pair> pairs_;  // not decided yet
  std::vector<std::pair<int, int>> found_;
};

// What the answer depends on: not where the robot stands, nor where an episode begins.
std::string shape_of(const Robot& robot) {
  Scene scene;
  scene.robot = robot;
  scene.robot.checked_pairs.clear();
  scene.robot.body.world_from_body = Transform::Identity();
  for (const int part : robot.arm) scene.robot.body.parts[static_cast<std::size_t>(part)].joint.initial = 0;
  return scene_to_document(scene);
}

}  // namespace

std::vector<std::pair<int, int>> pairs_that_meet(const Robot& robot) {
  static std::mutex mutex;
  static std::map<std::string, std::vector<std::pair<int, int>>> known;
  const std::string shape = shape_of(robot);
  const std::lock_guard lock(mutex);
  const auto found = known.find(shape);
  if (found != known.end()) return found->second;
  return known.emplace(shape, Sampling(robot).run()).first->second;
}

}  // namespace stampede
