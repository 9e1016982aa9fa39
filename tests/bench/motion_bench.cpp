// Whole planning queries between random free configurations among ten posts: search, shortening, rounding, timing and
// certification. Counters: median time, solved queries, and those that touch when looked at four times as densely.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>

#include "tests/engine/motion/cluttered.h"

namespace {

using namespace stampede;

void random_queries(benchmark::State& state) {
  const World world(cluttered_scene());
  const CollisionState collision = world.collision_state();
  std::vector<double> times_ms;
  int solved = 0, touching = 0;
  double duration_s = 0;
  std::int64_t number = 0;
  for (auto _ : state) {
    Random random(RandomKey("bench").with(number));
    const JointVector start = random_free(collision, random), goal = random_free(collision, random);
    const auto before = std::chrono::steady_clock::now();
    const PlannedMotion motion = plan_joints({collision, start, {}, RandomKey("plan").with(number++)}, goal);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - before;
    state.SetIterationTime(taken.count());
    times_ms.push_back(1e3 * taken.count());
    if (motion.reason != Reason::none) continue;
    ++solved;
    duration_s += static_cast<double>(motion.trajectory.steps()) / world.scene().physics_hz;
    if (touches(collision, motion.trajectory, world.scene().physics_hz, 0.0025) > 0) ++touching;
  }
  std::sort(times_ms.begin(), times_ms.end());
  state.counters["median_ms"] = times_ms[times_ms.size() / 2];
  state.counters["p95_ms"] = times_ms[times_ms.size() * 95 / 100];
  state.counters["solved"] = solved;
  state.counters["touching"] = touching;
  state.counters["mean_motion_s"] = duration_s / std::max(1, solved);
}
BENCHMARK(random_queries)->Iterations(200)->UseManualTime()->Unit(benchmark::kMillisecond);

void check_free(benchmark::State& state) {
  const World world(cluttered_scene());
  const CollisionState collision = world.collision_state();
  Random random(RandomKey("free"));
  std::vector<JointVector> configurations;
  for (int k = 0; k < 500; ++k) configurations.push_back(random_free(collision, random));
  std::size_t k = 0;
  for (auto _ : state) benchmark::DoNotOptimize(collision.free(configurations[k++ % configurations.size()]));
}
BENCHMARK(check_free);

void check_many(benchmark::State& state) {  // the same, all in one call; items: configurations
  const World world(cluttered_scene());
  const CollisionState collision = world.collision_state();
  Random random(RandomKey("free"));
  std::vector<JointVector> configurations;
  for (int k = 0; k < 500; ++k) configurations.push_back(random_free(collision, random));
  for (auto _ : state) benchmark::DoNotOptimize(collision.first_touching(configurations));
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(configurations.size()));
}
BENCHMARK(check_many);

}  // namespace

BENCHMARK_MAIN();
