// Inverse kinematics of the Panda on 10,000 random reachable poses: share solved and time per pose.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "engine/model/kinematics.h"
#include "tests/support/panda.h"

namespace stampede {
namespace {

std::vector<Transform> reachable_poses(const Arm& arm, int count) {
  Random random(RandomKey("ik_bench"));
  std::vector<Transform> poses;
  JointVector q(arm.joints());
  for (int k = 0; k < count; ++k) {
    for (Eigen::Index i = 0; i < q.size(); ++i) {
      const JointLimits& limit = arm.limits()[static_cast<std::size_t>(i)];
      q[i] = random.between(limit.lower, limit.upper);
    }
    poses.push_back(arm.world_from_tip(q));
  }
  return poses;
}

// The mean hides the common case: a few poses need many restarts, so median and 99th percentile are counters.
void solve_from_home(benchmark::State& state) {
  const Arm arm(panda_robot());
  const std::vector<Transform> poses = reachable_poses(arm, 10000);
  std::vector<double> times_us;
  int solved = 0;
  for (auto _ : state) {
    times_us.clear();
    solved = 0;
    for (std::size_t k = 0; k < poses.size(); ++k) {
      const auto before = std::chrono::steady_clock::now();
      solved += arm.solve(poses[k], arm.home(), RandomKey("ik").with(static_cast<std::int64_t>(k))).has_value();
      times_us.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - before).count());
    }
  }
  std::sort(times_us.begin(), times_us.end());
  state.counters["solved_percent"] = 100.0 * solved / static_cast<double>(poses.size());
  state.counters["median_us"] = times_us[times_us.size() / 2];
  state.counters["p99_us"] = times_us[times_us.size() * 99 / 100];
}
BENCHMARK(solve_from_home)->Unit(benchmark::kMillisecond);

void tip_pose(benchmark::State& state) {
  const Arm arm(panda_robot());
  JointVector q = arm.home();
  for (auto _ : state) {
    q[0] += 1e-6;
    benchmark::DoNotOptimize(arm.base_from_tip(q));
  }
}
BENCHMARK(tip_pose);

}  // namespace
}  // namespace stampede

BENCHMARK_MAIN();
