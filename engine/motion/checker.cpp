#include "engine/motion/checker.h"

#include <algorithm>
#include <cmath>

namespace stampede {
namespace {

constexpr double kExcusedRadius = 0.25;  // rad around an end that touches the padding

std::string part_name(const Scene& scene, PartRef ref) {
  const Body& body = ref.body < 0 ? scene.robot.body : scene.bodies.at(static_cast<std::size_t>(ref.body));
  const std::string& name = ref.body < 0 ? scene.robot.name : body.name;
  if (ref.part < 0 || ref.part >= static_cast<int>(body.parts.size())) return name;
  const std::string& part = body.parts[static_cast<std::size_t>(ref.part)].name;
  return part.empty() || part == name ? name : name + "." + part;
}

std::string contact_text(CollisionSpace& space, const JointVector& q) {
  const std::optional<CollisionPair> pair = space.first_contact(q);
  if (!pair) return {};
  return part_name(space.scene(), pair->robot_part) + " touches " + part_name(space.scene(), pair->other);
}

}  // namespace

double joint_gap(const JointVector& a, const JointVector& b) {
  return a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff();
}

Checker::Checker(CollisionSpace& space, double padding_m, const std::vector<JointVector>& ends)
    : space_(space), padding_m_(padding_m) {
  space_.set_padding(0);
  if (padding_m_ <= 0) return;
  pad(padding_m_);
  for (const JointVector& end : ends)
    if (!space_.free(end)) excused_.push_back(end);
}

Checker::~Checker() { pad(0); }

void Checker::pad(double padding_m) {
  if (padding_m == applied_m_) return;
  space_.set_padding(padding_m);
  applied_m_ = padding_m;
}

void Checker::pad_for(const JointVector& q) {
  const bool excused = std::any_of(excused_.begin(), excused_.end(),
                                   [&](const JointVector& end) { return joint_gap(end, q) < kExcusedRadius; });
  pad(excused ? 0.0 : padding_m_);
}

bool Checker::free(const JointVector& q) {
  pad_for(q);
  return space_.free(q);
}

std::string Checker::contact(const JointVector& q) {
  pad_for(q);
  return contact_text(space_, q);
}

bool Checker::edge_free(const JointVector& a, const JointVector& b, double step_rad) {
  const int count = static_cast<int>(std::ceil(joint_gap(a, b) / step_rad));
  if (!free(b)) return false;
  int stride = 1;
  while (stride < count) stride *= 2;
  for (; stride >= 2; stride /= 2)
    for (int i = stride / 2; i < count; i += stride)
      if (!free(a + (static_cast<double>(i) / count) * (b - a))) return false;
  return true;
}

std::optional<JointVector> first_touch(Checker& checker, const std::vector<JointVector>& waypoints, double step_rad) {
  if (waypoints.empty()) return std::nullopt;
  if (!checker.free(waypoints.front())) return waypoints.front();
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const JointVector& a = waypoints[i - 1];
    const JointVector& b = waypoints[i];
    const int count = std::max(1, static_cast<int>(std::ceil(joint_gap(a, b) / step_rad)));
    for (int k = 1; k <= count; ++k) {
      const JointVector q = a + (static_cast<double>(k) / count) * (b - a);
      if (!checker.free(q)) return q;
    }
  }
  return std::nullopt;
}

std::optional<JointVector> first_touch(Checker& checker, const Trajectory& trajectory, int physics_hz,
                                       double step_rad) {
  if (trajectory.knots.empty()) return std::nullopt;
  JointVector last = trajectory.knots.front().position;
  if (!checker.free(last)) return last;
  for (std::int64_t step = 1; step <= trajectory.steps(); ++step) {
    const double s = static_cast<double>(step);
    const JointVector q = evaluate(trajectory, s, physics_hz).position;
    const double gap = joint_gap(last, q);
    const bool end = step == trajectory.steps();
    // Slow stretches skip steps; a step longer than the spacing is divided.
    const double next = end ? 0.0 : joint_gap(last, evaluate(trajectory, s + 1, physics_hz).position);
    if (!end && next <= step_rad) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(gap / step_rad)));
    for (int k = 1; k <= count; ++k) {
      const double between = s - 1.0 + static_cast<double>(k) / count;
      const JointVector sample = k == count ? q : evaluate(trajectory, between, physics_hz).position;
      if (!checker.free(sample)) return sample;
    }
    last = q;
  }
  return std::nullopt;
}

std::string describe_contact(CollisionSpace& space, const JointVector& q) {
  space.set_padding(0);
  return contact_text(space, q);
}

}  // namespace stampede
