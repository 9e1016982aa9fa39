// The engine's part of tests/bench/peers; each mode prints one JSON object.
//   peers_bench physics CUBES SECONDS [asleep]   steps a second: Panda, table, resting cubes, the arm waving, 240 Hz
//   peers_bench checks SECONDS                   free configurations among ten posts looked at a second, one and many
//                                                a call
//   peers_bench posts                            those posts and configurations, for others to look at
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <string>

#include "engine/base/error.h"
#include "engine/sim/world.h"
#include "tests/engine/motion/cluttered.h"

namespace {

using namespace stampede;
using Clock = std::chrono::steady_clock;

constexpr int kFrame = 12;    // physics steps of a frame
constexpr int kStroke = 120;  // physics steps from one pose to the next
constexpr int kConfigurations = 500;

// tests/bench/peers/scene.py waves in the same way.
Trajectory waving(const Arm& arm) {
  Trajectory path;
  const JointVector zero = JointVector::Zero(arm.joints());
  for (int k = 0; k < 100; ++k) {
    JointVector q = arm.home();
    if (k % 99 > 0)  // home at both ends
      for (Eigen::Index j = 0; j < q.size(); ++j) q[j] += 0.2 * std::sin(1.3 * k + static_cast<double>(j));
    path.knots.push_back({k * kStroke, q, zero, zero});
  }
  return path;
}

// How often `round` can be done in a second; it says how many things it did.
double rate_of(double seconds, const std::function<std::int64_t()>& round) {
  round();
  std::int64_t done = 0;
  const auto begin = Clock::now();
  std::chrono::duration<double> passed{};
  do {
    done += round();
    passed = Clock::now() - begin;
  } while (passed.count() < seconds);
  return static_cast<double>(done) / passed.count();
}

// What rests may sleep, or not; throws where this engine cannot let it.
template <typename Engine>
void let_sleep(Engine& world, bool sleep) {
  if constexpr (requires { world.let_sleep(sleep); }) {
    world.let_sleep(sleep);
  } else if (sleep) {
    throw Error("World", "nothing sleeps in this engine");
  }
}

void physics(int cubes, double seconds, bool sleep) {
  World world(std::make_shared<const Scene>(table_scene(cubes)));
  let_sleep(world, sleep);
  world.keep_log(false);
  const Trajectory path = waving(world.arm());
  const auto wave = [&] {
    if (!world.following()) world.apply(operation::Follow{path});
    for (int frame = 0; frame < 20; ++frame) {
      for (int step = 0; step < kFrame; ++step) world.step();
      world.close_window();
    }
    return static_cast<std::int64_t>(20) * kFrame;
  };
  const double steps = rate_of(seconds, wave);
  double moved = 0, lag = (world.arm_position() - world.reference().position).cwiseAbs().maxCoeff();
  const Scene& scene = world.scene();
  for (std::size_t b = 0; b < scene.bodies.size(); ++b) {
    const Vector3 now = world.world_from_part({static_cast<int>(b), 0}).translation();
    moved = std::max(moved, (now - scene.bodies[b].world_from_body.translation()).norm());
  }
  std::printf("{\"steps_per_s\": %.1f, \"cubes_moved_mm\": %.4f, \"arm_lag_rad\": %.5f}\n", steps, 1e3 * moved, lag);
}

std::vector<JointVector> free_configurations(const CollisionState& state) {
  Random random(RandomKey("free"));
  std::vector<JointVector> configurations;
  for (int k = 0; k < kConfigurations; ++k) configurations.push_back(random_free(state, random));
  return configurations;
}

void checks(double seconds) {
  const World world(cluttered_scene());
  const CollisionState state = world.collision_state();
  const std::vector<JointVector> configurations = free_configurations(state);
  const double one = rate_of(seconds, [&] {
    std::int64_t free = 0;
    for (const JointVector& q : configurations) free += state.free(q) ? 1 : 0;
    return free;
  });
  const double many = rate_of(seconds, [&] { return static_cast<std::int64_t>(state.first_touching(configurations)); });
  std::printf("{\"one_per_s\": %.0f, \"many_per_s\": %.0f}\n", one, many);
}

void posts() {
  const auto scene = cluttered_scene();
  const World world(scene);
  std::string boxes, rows;
  const auto number = [](double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", value);
    return std::string(text);
  };
  for (const Body& body : scene->bodies) {
    const Vector3 centre = body.world_from_body.translation(), size = body.parts[0].shapes[0].size;
    boxes += (boxes.empty() ? "[" : ", [");
    for (int i = 0; i < 3; ++i) boxes += number(centre[i]) + ", ";
    boxes += number(size[0]) + ", " + number(size[1]) + ", " + number(size[2]) + "]";
  }
  for (const JointVector& q : free_configurations(world.collision_state())) {
    rows += (rows.empty() ? "[" : ", [");
    for (Eigen::Index j = 0; j < q.size(); ++j) rows += (j > 0 ? ", " : "") + number(q[j]);
    rows += "]";
  }
  std::printf("{\"boxes\": [%s], \"configurations\": [%s]}\n", boxes.c_str(), rows.c_str());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const std::string mode = argc > 1 ? argv[1] : "";
    const bool sleep = argc == 5 && std::strcmp(argv[4], "asleep") == 0;
    if (mode == "physics" && (argc == 4 || sleep)) {
      physics(std::atoi(argv[2]), std::atof(argv[3]), sleep);
    } else if (mode == "checks" && argc == 3) {
      checks(std::atof(argv[2]));
    } else if (mode == "posts" && argc == 2) {
      posts();
    } else {
      std::fprintf(stderr, "usage: peers_bench physics CUBES SECONDS [asleep] | checks SECONDS | posts\n");
      return 2;
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
