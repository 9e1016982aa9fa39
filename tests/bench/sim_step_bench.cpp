// The engine's step against a bare loop over Bullet's own solver, the same scene: Panda, table, resting 4 cm cubes, arm
// moving, 240 Hz. Both run in turn, one step each, so that a slow phase of the machine meets both.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>

#include "engine/sim/collision_state.h"
#include "engine/sim/world.h"
#include "tests/bench/bare_bullet.h"
#include "tests/support/panda.h"

namespace stampede {
namespace {

using Clock = std::chrono::steady_clock;

std::shared_ptr<const Scene> bench_scene() { return std::make_shared<const Scene>(table_scene(10)); }

Trajectory waving(const Arm& arm) {
  Trajectory path;
  const JointVector zero = JointVector::Zero(arm.joints());
  for (int k = 0; k < 400; ++k) {
    JointVector q = arm.home();
    if (k > 0)
      for (Eigen::Index j = 0; j < q.size(); ++j) q[j] += 0.2 * std::sin(1.3 * k + static_cast<double>(j));
    path.knots.push_back({k * 120, q, zero, zero});
  }
  return path;
}

void engine_against_bare(benchmark::State& state, ControllerKind kind, bool sleep = false) {
  const auto scene = std::make_shared<const Scene>(table_scene(static_cast<int>(state.range(0))));
  World engine(scene);
  BareBullet bare(*scene);
  const Trajectory path = waving(engine.arm());
  double engine_s = 0, bare_s = 0;
  std::int64_t step = 0;
  engine.keep_log(false);
  engine.let_sleep(sleep);
  engine.apply(operation::Controller{kind, 0});
  for (auto _ : state) {
    if (step % path.steps() == 0) {
      engine.apply(operation::Follow{path});
      step = 0;
    }
    const auto start = Clock::now();
    engine.step();
    if (step % 12 == 11) {
      engine.close_window();
      benchmark::DoNotOptimize(engine.grasped());
      for (int b = 0; b < static_cast<int>(scene->bodies.size()); ++b)
        benchmark::DoNotOptimize(engine.world_from_part({b, 0}));
    }
    const auto middle = Clock::now();
    bare.step(evaluate(path, static_cast<double>(step), scene->physics_hz));
    const auto end = Clock::now();
    engine_s += std::chrono::duration<double>(middle - start).count();
    bare_s += std::chrono::duration<double>(end - middle).count();
    ++step;
  }
  state.counters["engine_us"] = 1e6 * engine_s / static_cast<double>(state.iterations());
  state.counters["bare_us"] = 1e6 * bare_s / static_cast<double>(state.iterations());
  state.counters["speed_ratio"] = bare_s / engine_s;  // the engine's speed over the bare loop's
}

void collision_query(benchmark::State& state) {
  World world(bench_scene());
  CollisionState collision = world.collision_state();
  Random random(RandomKey("collision bench"));
  std::vector<JointVector> states;
  for (int i = 0; i < 1000; ++i) {
    JointVector q(world.arm().joints());
    for (Eigen::Index j = 0; j < q.size(); ++j) {
      const JointLimits& limits = world.arm().limits()[static_cast<std::size_t>(j)];
      q[j] = random.between(limits.lower, limits.upper);
    }
    if (state.range(0) == 0 || collision.free(q)) states.push_back(q);
  }
  std::size_t at = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(collision.free(states[at]));
    at = (at + 1) % states.size();
  }
}

void snapshot_and_restore(benchmark::State& state) {
  World world(bench_scene());
  for (int i = 0; i < 100; ++i) world.step();
  for (auto _ : state) {
    world.apply(operation::Boundary{});
    world.restore(world.snapshot());
  }
}

void build_world(benchmark::State& state) {
  const auto scene = bench_scene();
  for (auto _ : state) {
    World world(scene);
    benchmark::DoNotOptimize(world.step_count());
  }
}

void freeze_world(benchmark::State& state) {
  World world(bench_scene());
  for (auto _ : state) benchmark::DoNotOptimize(world.collision_state());
}

BENCHMARK_CAPTURE(engine_against_bare, joint_position, ControllerKind::joint_position)
    ->ArgName("cubes")
    ->Arg(3)
    ->Arg(10)
    ->Arg(30)
    ->MinTime(3);
BENCHMARK_CAPTURE(engine_against_bare, resting_cubes_asleep, ControllerKind::joint_position, true)
    ->ArgName("cubes")
    ->Arg(3)
    ->Arg(10)
    ->Arg(30)
    ->MinTime(3);
BENCHMARK_CAPTURE(engine_against_bare, joint_impedance, ControllerKind::joint_impedance)
    ->ArgName("cubes")
    ->Arg(10)
    ->MinTime(3);
BENCHMARK_CAPTURE(engine_against_bare, cartesian_impedance, ControllerKind::cartesian_impedance)
    ->ArgName("cubes")
    ->Arg(10)
    ->MinTime(3);
BENCHMARK(collision_query)->ArgName("free_only")->Arg(0)->Arg(1);
BENCHMARK(snapshot_and_restore);
BENCHMARK(build_world);
BENCHMARK(freeze_world);

}  // namespace
}  // namespace stampede

BENCHMARK_MAIN();
