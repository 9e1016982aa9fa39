#include "engine/motion/looked.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "engine/sim/collision_state.h"

namespace stampede {
namespace {

constexpr double kMetresPerRadian = 0.3;
constexpr double kNoWay_m = 0.05;  // how near it is to have two free ends
constexpr double kFarthest_m = 0.064;

std::string number(double value, int digits) {
  std::string text = std::to_string(value);
  return text.substr(0, text.find('.') + (digits > 0 ? static_cast<std::size_t>(digits) + 1 : 0));
}

std::string millimetres(double metres) { return number(std::max(1.0, std::round(1000 * metres)), 0) + " mm"; }

double distance_of(const Looked& one) {
  if (one.fate == Looked::Fate::usable) return 0;
  if (one.fate == Looked::Fate::no_way) return kNoWay_m;
  if (!one.joint.empty()) return kMetresPerRadian * one.missed_rad;
  return one.missed_m < 0 ? std::numeric_limits<double>::infinity() : one.missed_m;
}

}  // namespace

std::string cause_of(const Looked& looked) {
  const std::string where = looked.approach ? " on the approach" : "";
  switch (looked.fate) {
    case Looked::Fate::usable:
      return "usable";
    case Looked::Fate::touches:
      return "touch " + looked.touched + where;
    case Looked::Fate::out_of_reach:
      return "out of reach" + where;
    case Looked::Fate::no_way:
      return "without a straight way from the approach";
    case Looked::Fate::no_room:
      return "too wide for the place";
    case Looked::Fate::no_follow:
      return "without a way for the arm to go with it";
    case Looked::Fate::crowded:
      break;
  }
  return "without room for a hand beside it";
}

std::string amount_of(const Looked& looked) {
  if (!looked.joint.empty()) return number(looked.missed_rad, 2) + " rad beyond " + looked.joint + "'s limit";
  return looked.missed_m < 0 ? "" : millimetres(looked.missed_m);
}

std::string miss_of(const Looked& looked) {
  const std::string amount = amount_of(looked), by = amount.empty() ? "" : " by " + amount;
  const std::string where = looked.approach ? " on the approach" : "";
  if (looked.fate == Looked::Fate::touches) return "touches " + looked.touched + by + where;
  if (!looked.joint.empty()) return amount + where;
  if (looked.fate == Looked::Fate::out_of_reach) return "out of reach" + by + where;
  return cause_of(looked) + by;
}

const Looked* nearest_miss(std::span<const Looked> looked) {
  const Looked* nearest = nullptr;
  for (const Looked& one : looked) {
    if (one.fate == Looked::Fate::usable || !std::isfinite(distance_of(one))) continue;
    if (nearest == nullptr || distance_of(one) < distance_of(*nearest)) nearest = &one;
  }
  return nearest;
}

const Looked* commonest_miss(std::span<const Looked> looked) {
  const auto misses = [](const Looked& one) { return one.fate != Looked::Fate::usable; };
  const bool of_best = std::ranges::any_of(looked, [&](const Looked& one) { return misses(one) && one.best; });
  struct Cause {
    std::string name;
    int times = 0;
    const Looked* nearest = nullptr;
  };
  std::vector<Cause> causes;  // in the order in which they come
  for (const Looked& one : looked) {
    if (!misses(one) || (of_best && !one.best)) continue;
    std::string name = cause_of(one);
    auto cause = std::ranges::find(causes, name, &Cause::name);
    if (cause == causes.end()) cause = causes.insert(cause, {std::move(name), 0, &one});
    ++cause->times;
    if (distance_of(one) < distance_of(*cause->nearest)) cause->nearest = &one;
  }
  const auto commonest = std::ranges::max_element(causes, {}, &Cause::times);  // the first of equals
  return commonest == causes.end() ? nullptr : commonest->nearest;
}

std::string Causes::text() const {
  std::vector<std::pair<std::string, int>> sorted(counts_.begin(), counts_.end());
  std::stable_sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  std::string text;
  for (const auto& [cause, count] : sorted) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + cause;
  return text;
}

Causes causes_of(std::span<const Looked> looked) {
  Causes causes;
  for (const Looked& one : looked) causes.add(cause_of(one));
  return causes;
}

std::string name_of_part(const Scene& scene, PartRef ref) {
  const Body& body = scene.body_at(ref.body);
  const std::string& name = ref.body < 0 ? scene.robot.name : body.name;
  if (ref.part < 0 || (ref.part == 0 && ref.body >= 0) || ref.part >= static_cast<int>(body.parts.size())) return name;
  const std::string& part = body.parts[static_cast<std::size_t>(ref.part)].name;
  return part.empty() || part == name ? name : name + "." + part;
}

std::string touched_in_all(const CollisionState& state, const std::vector<JointVector>& configurations) {
  std::string first;
  for (const JointVector& q : configurations) {
    const std::optional<CollisionPair> contact = state.first_contact(q);
    if (!contact) return {};
    if (first.empty()) first = name_of_part(state.scene(), contact->other);
  }
  return first;
}

double way_to_free(const Transform& pose, std::span<const Vector3> directions,
                   const std::function<bool(const Transform&)>& free) {
  const auto free_at = [&](const Vector3& direction, double way) {
    Transform moved = pose;
    moved.translation() += way * direction;
    return free(moved);
  };
  for (double way = 0.001; way <= kFarthest_m; way *= 2)
    for (const Vector3& direction : directions) {
      if (!free_at(direction, way)) continue;
      double low = way / 2, high = way;
      while (high - low > 0.001) (free_at(direction, (low + high) / 2) ? high : low) = (low + high) / 2;
      return high;
    }
  return -1;
}

const std::vector<Vector3>& level_directions() {
  static const std::vector<Vector3> all = [] {
    std::vector<Vector3> directions;
    for (int k = 0; k < 8; ++k)
      directions.emplace_back(std::cos(k * std::numbers::pi / 4), std::sin(k * std::numbers::pi / 4), 0);
    return directions;
  }();
  return all;
}

void note_shortfall(const std::optional<Shortfall>& missing, const Robot& robot, Looked& looked) {
  if (!missing) return;
  if (missing->joint < 0) {
    looked.missed_m = missing->way_m;
    return;
  }
  const int part = robot.arm[static_cast<std::size_t>(missing->joint)];
  looked.joint = robot.body.parts[static_cast<std::size_t>(part)].joint.name;
  looked.missed_rad = missing->angle;
}

}  // namespace stampede
