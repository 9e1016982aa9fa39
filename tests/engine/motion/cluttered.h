// A table with ten tall boxes around the arm, and random configurations in it: for tests and benchmarks of motion.
#pragma once

#include <memory>
#include <numbers>

#include "engine/base/random.h"
#include "engine/motion/planner.h"
#include "tests/support/panda.h"

namespace stampede {

inline constexpr int kHz = 240;  // of the physics in these tests

// Looking straight down at a point of the table.
inline Transform above(double x, double y, double z, double yaw = 0) {
  return translation(x, y, z) * rotation_rpy(std::numbers::pi, 0, yaw);
}

inline Body box_body(const std::string& name, const Vector3& size) {
  Shape shape;
  shape.size = size;
  Part part;
  part.name = name;
  part.shapes = {shape};
  Body body;
  body.name = name;
  body.parts = {part};
  return body;
}

inline std::shared_ptr<const Scene> cluttered_scene(int boxes = 10) {
  auto scene = std::make_shared<Scene>(table_scene(0));
  Random random(RandomKey("cluttered"));
  for (int i = 0; i < boxes; ++i) {
    const double angle = 2.2 * (2.0 * i / std::max(1, boxes - 1) - 1.0), distance = random.between(0.4, 0.75);
    const double height = random.between(0.2, 0.6);
    Body body = box_body("post" + std::to_string(i), Vector3(0.08, 0.08, height));
    body.world_from_body = translation(distance * std::cos(angle), distance * std::sin(angle), 0.5 * height);
    scene->bodies.push_back(std::move(body));
  }
  std::sort(scene->bodies.begin(), scene->bodies.end(), [](const Body& a, const Body& b) { return a.name < b.name; });
  return scene;
}

inline JointVector random_free(const CollisionState& state, Random& random) {
  const auto& limits = state.arm().limits();
  JointVector q(static_cast<Eigen::Index>(limits.size()));
  do {
    for (std::size_t i = 0; i < limits.size(); ++i)
      q[static_cast<Eigen::Index>(i)] = random.between(limits[i].lower, limits[i].upper);
  } while (!state.free(q));
  return q;
}

// Samples of a trajectory at most `step_rad` apart that touch something.
inline int touches(const CollisionState& state, const Trajectory& trajectory, int physics_hz, double step_rad) {
  int count = 0;
  JointVector last = trajectory.knots.front().position;
  for (double step = 0; step <= static_cast<double>(trajectory.steps()); step += 0.1) {
    const JointVector q = evaluate(trajectory, step, physics_hz).position;
    const double next = (evaluate(trajectory, step + 0.1, physics_hz).position - last).cwiseAbs().maxCoeff();
    if (step > 0 && next < step_rad) continue;  // slow stretches need fewer samples
    if (!state.free(q)) ++count;
    last = q;
  }
  return count;
}

}  // namespace stampede
