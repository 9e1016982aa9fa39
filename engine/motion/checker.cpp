#include "engine/motion/checker.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/motion/looked.h"
#include "engine/sim/overlap.h"

namespace stampede {
namespace {

constexpr double kExcusedRadius = 0.25;  // rad around an end that touches the padding

std::string contact_text(const CollisionState& state, const JointVector& q, double padding_m) {
  const auto text = [&](PartRef one, PartRef other) {
    return name_of_part(state.scene(), one) + " touches " + name_of_part(state.scene(), other);
  };
  if (const std::optional<Overlap> pair = deepest_overlap(state, q)) {
    const long depth_mm = std::lround(1000 * pair->depth);
    return text(pair->one, pair->other) + (depth_mm > 0 ? ", " + std::to_string(depth_mm) + " mm deep" : "");
  }
  const std::optional<CollisionPair> pair = state.first_contact(q, padding_m);
  return pair ? text(pair->robot_part, pair->other) : std::string();
}

}  // namespace

double joint_gap(const JointVector& a, const JointVector& b) {
  return a.size() == 0 ? 0.0 : (a - b).cwiseAbs().maxCoeff();
}

Checker::Checker(const CollisionState& state, double padding_m, const std::vector<JointVector>& ends)
    : state_(state), padding_m_(std::max(0.0, padding_m)), many_(state) {
  if (padding_m_ <= 0) return;
  for (const JointVector& end : ends)
    if (!state_.free(end, padding_m_)) excused_.push_back(end);
}

double Checker::padding_at(const JointVector& q) const {
  const bool excused = std::any_of(excused_.begin(), excused_.end(),
                                   [&](const JointVector& end) { return joint_gap(end, q) < kExcusedRadius; });
  return excused ? 0.0 : padding_m_;
}

bool Checker::free(const JointVector& q) const { return state_.free(q, padding_at(q)); }

std::string Checker::contact(const JointVector& q) const { return contact_text(state_, q, padding_at(q)); }

std::size_t Checker::first_touching(std::span<const JointVector> configurations) {
  paddings_.clear();
  for (const JointVector& q : configurations) paddings_.push_back(padding_at(q));
  return many_.first_touching(configurations, paddings_);
}

// Each eight that are asked about together are spread over the whole edge (Thomason, Kingston, Kavraki, ICRA 2024,
// doi:10.1109/ICRA57147.2024.10611190).
bool Checker::edge_free(const JointVector& a, const JointVector& b, double step_rad) {
  constexpr int kTogether = 8;
  const JointVector way = b - a;
  const int count = std::max(1, static_cast<int>(std::ceil(joint_gap(a, b) / step_rad)));
  const int rounds = (count + kTogether - 1) / kTogether;
  std::array<JointVector, kTogether> samples;
  std::array<double, kTogether> paddings{};
  for (int round = rounds; round > 0; --round) {
    std::size_t together = 0;
    for (int i = round; i <= count; i += rounds, ++together) {
      samples[together] = i == count ? b : JointVector(a + (static_cast<double>(i) / count) * way);
      paddings[together] = padding_at(samples[together]);
    }
    if (!many_.all_free(std::span(samples).first(together), std::span(paddings).first(together))) return false;
  }
  return true;
}

namespace {

// Collects configurations and asks about many at once.
class Batch {
 public:
  explicit Batch(Checker& checker) : checker_(checker) { samples_.reserve(kSize); }
  // The first that touched something, among those added so far; asked when enough have come together, or at the end.
  std::optional<JointVector> add(const JointVector& q) {
    samples_.push_back(q);
    return samples_.size() < kSize ? std::nullopt : ask();
  }
  std::optional<JointVector> ask() {
    const std::size_t touching = checker_.first_touching(samples_);
    std::optional<JointVector> found;
    if (touching < samples_.size()) found = samples_[touching];
    samples_.clear();
    return found;
  }

 private:
  static constexpr std::size_t kSize = 64;
  Checker& checker_;
  std::vector<JointVector> samples_;
};

}  // namespace

std::optional<JointVector> first_touch(Checker& checker, const std::vector<JointVector>& waypoints, double step_rad) {
  if (waypoints.empty()) return std::nullopt;
  Batch batch(checker);
  batch.add(waypoints.front());
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const JointVector& a = waypoints[i - 1];
    const JointVector& b = waypoints[i];
    const int count = std::max(1, static_cast<int>(std::ceil(joint_gap(a, b) / step_rad)));
    for (int k = 1; k <= count; ++k)
      if (const auto touch = batch.add(a + (static_cast<double>(k) / count) * (b - a))) return touch;
  }
  return batch.ask();
}

std::optional<JointVector> first_touch(Checker& checker, const Trajectory& trajectory, std::int64_t from,
                                       std::int64_t to, int physics_hz, double step_rad) {
  if (trajectory.knots.empty()) return std::nullopt;
  Batch batch(checker);
  JointVector last = evaluate(trajectory, static_cast<double>(from), physics_hz).position;
  batch.add(last);
  for (std::int64_t step = from + 1; step <= to; ++step) {
    const double s = static_cast<double>(step);
    const JointVector q = evaluate(trajectory, s, physics_hz).position;
    const double gap = joint_gap(last, q);
    const bool end = step == to;
    // Slow stretches skip steps; a step longer than the spacing is divided.
    const double next = end ? 0.0 : joint_gap(last, evaluate(trajectory, s + 1, physics_hz).position);
    if (!end && next <= step_rad) continue;
    const int count = std::max(1, static_cast<int>(std::ceil(gap / step_rad)));
    for (int k = 1; k <= count; ++k) {
      const double between = s - 1.0 + static_cast<double>(k) / count;
      const JointVector sample = k == count ? q : evaluate(trajectory, between, physics_hz).position;
      if (const auto touch = batch.add(sample)) return touch;
    }
    last = q;
  }
  return batch.ask();
}

std::string describe_contact(const CollisionState& state, const JointVector& q) { return contact_text(state, q, 0); }

}  // namespace stampede
