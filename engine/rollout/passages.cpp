#include "engine/rollout/passages.h"

#include <algorithm>

namespace stampede {
namespace {

constexpr double kPassed_m = 0.05;

}  // namespace

void Passages::look(const World& world, std::int64_t clock) {
  if (vias_.empty()) return;
  const JointVector speed = world.arm_velocity();
  samples_.push_back({world.step_count(), clock, world.world_from_tip(), speed.cwiseAbs().maxCoeff(),
                      (world.arm().jacobian(world.arm_position()).topRows<3>() * speed).norm()});
}

// Least sum of distances over ascending samples, by dynamic programming: a path may pass one place twice.
std::vector<ViaRecord> Passages::in_order() const {
  std::vector<ViaRecord> records;
  if (samples_.empty()) return records;
  const std::size_t count = samples_.size();
  const auto distance = [&](std::size_t via, std::size_t sample) {
    return (samples_[sample].world_from_tip.translation() - vias_[via].world_from_tip.translation()).norm();
  };
  // best[i][t]: the sample at or before t at which via i is passed, when all before it are passed in order.
  std::vector<std::vector<std::size_t>> best(vias_.size(), std::vector<std::size_t>(count, 0));
  std::vector<double> before(count, 0.0), cost(count, 0.0);
  for (std::size_t i = 0; i < vias_.size(); ++i) {
    for (std::size_t t = 0; t < count; ++t) {
      const double here = before[t] + distance(i, t);
      const bool nearer = t == 0 || here < cost[t - 1];
      cost[t] = nearer ? here : cost[t - 1];
      best[i][t] = nearer ? t : best[i][t - 1];
    }
    before = cost;
  }
  std::size_t last = count - 1;
  for (std::size_t i = vias_.size(); i-- > 0;) {
    if (vias_[i].by_time) {
      const auto passed = std::find_if(samples_.begin(), samples_.end(),
                                       [&](const Sample& sample) { return sample.clock >= vias_[i].step; });
      if (passed == samples_.end()) continue;
      last = static_cast<std::size_t>(passed - samples_.begin());
    } else {
      last = best[i][last];
    }
    const Sample& sample = samples_[last];
    if (distance(i, last) >= kPassed_m) continue;
    records.push_back({segment_, vias_[i].name, to_pose(vias_[i].world_from_tip), to_pose(sample.world_from_tip),
                       sample.step, sample.joint_speed, sample.tool_speed});
  }
  std::reverse(records.begin(), records.end());
  return records;
}

}  // namespace stampede
