#include "tests/engine/sim/sim_scenes.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace stampede::testing {
Part moving_part(const std::string& name, JointKind kind, const Vector3& axis, const Vector3& origin, double lower,
                 double upper) {
  Part part;
  part.name = name;
  part.parent = 0;
  part.joint.name = name;
  part.joint.kind = kind;
  part.joint.axis = axis;
  part.joint.parent_from_joint = translation(origin);
  part.joint.lower = lower;
  part.joint.upper = upper;
  return part;
}

Shape box_shape(const Vector3& size, const Vector3& centre) {
  Shape shape;
  shape.size = size;
  shape.part_from_shape = translation(centre);
  return shape;
}

Body box_body(const std::string& name, const Vector3& size, const Vector3& centre, double mass) {
  Part part;
  part.name = name;
  part.shapes.push_back(box_shape(size));
  Body body;
  body.name = name;
  body.free = mass > 0;
  if (mass > 0) set_uniform_mass(part, mass);
  body.parts.push_back(part);
  body.world_from_body = translation(centre);
  return body;
}

Body chest(const Vector3& centre) {
  Body body = box_body("chest", {0.24, 0.24, 0.02}, centre, 0);
  body.parts[0].shapes.push_back(box_shape({0.24, 0.24, 0.02}, {0, 0, 0.14}));
  Part drawer = moving_part("drawer", JointKind::slider, {-1, 0, 0}, {0, 0, 0.07}, 0, 0.2);
  drawer.shapes = {
      box_shape({0.01, 0.2, 0.1}, {-0.11, 0, 0}),          box_shape({0.2, 0.2, 0.01}, {0, 0, -0.045}),
      box_shape({0.01, 0.2, 0.08}, {0.1, 0, 0}),           box_shape({0.2, 0.01, 0.08}, {0, 0.095, 0}),
      box_shape({0.2, 0.01, 0.08}, {0, -0.095, 0}),        box_shape({0.01, 0.12, 0.01}, {-0.155, 0, 0}),
      box_shape({0.035, 0.01, 0.01}, {-0.1325, 0.055, 0}), box_shape({0.035, 0.01, 0.01}, {-0.1325, -0.055, 0})};
  set_uniform_mass(drawer, 1.0);
  drawer.joint.friction = 2;
  drawer.joint.damping = 5;
  body.parts.push_back(drawer);
  return body;
}

Body button(const Vector3& centre) {
  Body body = box_body("button", {0.08, 0.08, 0.02}, centre, 0);
  Part cap = moving_part("cap", JointKind::slider, {0, 0, -1}, {0, 0, 0.02}, 0, 0.005);
  cap.shapes.push_back(box_shape({0.04, 0.04, 0.02}));
  set_uniform_mass(cap, 0.02);
  cap.joint.spring_force = 3;
  body.parts.push_back(cap);
  return body;
}

Body latched_door(const Vector3& origin) {
  Body body = box_body("door", {0.02, 0.02, 0.3}, origin, 0);
  Part leaf = moving_part("leaf", JointKind::hinge, {0, 0, 1}, {0, 0, 0}, 0, 1.9);
  leaf.shapes.push_back(box_shape({0.02, 0.3, 0.3}, {0, -0.16, 0}));
  set_uniform_mass(leaf, 1.5);
  leaf.joint.friction = 0.3;
  leaf.joint.damping = 0.2;
  leaf.joint.latch_key = "lever";
  leaf.joint.latch_open = -30 * std::numbers::pi / 180;
  leaf.joint.latch_close = 0.01;
  Part lever = moving_part("lever", JointKind::hinge, {1, 0, 0}, {-0.06, -0.28, 0}, -0.8, 0);
  lever.parent = 1;
  lever.shapes.push_back(box_shape({0.02, 0.1, 0.02}, {0, 0.05, 0}));
  set_uniform_mass(lever, 0.1);
  lever.joint.spring_force = 0.3;
  body.parts.push_back(leaf);
  body.parts.push_back(lever);
  return body;
}

void add_body(Scene& scene, Body body) {
  std::size_t at = 0;
  while (at < scene.bodies.size() && !scene.bodies[at].free) ++at;
  scene.bodies.insert(body.free ? scene.bodies.end() : scene.bodies.begin() + static_cast<std::ptrdiff_t>(at),
                      std::move(body));
}

std::shared_ptr<const Scene> shared(Scene scene) { return std::make_shared<const Scene>(std::move(scene)); }
int body_index(const World& world, const char* name) { return world.scene().body_index(name); }

JointVector solve(const World& world, const Transform& world_from_tip, const JointVector& near) {
  const auto q = world.arm().solve(world_from_tip, near, RandomKey("test"));
  if (!q) throw std::runtime_error("the test asks for a pose that the arm cannot reach");
  return *q;
}

Transform tip_down(double x, double y, double z, double yaw) {
  return translation(x, y, z) * rotation_rpy(0, 0, yaw) * rotation_rpy(std::numbers::pi, 0, 0);
}

void run(World& world, double seconds) {
  const auto steps = static_cast<std::int64_t>(std::llround(seconds / world.dt()));
  for (std::int64_t i = 0; i < steps; ++i) {
    world.step();
    if (world.step_count() % 12 == 0) world.close_window();
  }
}

void move_to(World& world, const JointVector& q, double seconds) {
  const JointVector zero = JointVector::Zero(q.size());
  const auto steps = static_cast<std::int64_t>(std::llround(seconds / world.dt()));
  world.apply(operation::Follow{{{{0, world.reference().position, zero, zero}, {steps, q, zero, zero}}}});
  run(world, seconds);
}

void move_line(World& world, const Transform& world_from_tip, double seconds) {
  constexpr int kKnots = 21;
  const auto total = static_cast<std::int64_t>(std::llround(seconds / world.dt()));
  const Transform start = world.arm().world_from_tip(world.reference().position);
  const Quaternion turn_start(start.linear()), turn_end(world_from_tip.linear());
  Trajectory path;
  JointVector q = world.reference().position;
  for (int k = 0; k < kKnots; ++k) {
    const double u = static_cast<double>(k) / (kKnots - 1);
    const double s = u * u * u * (10 + u * (6 * u - 15));  // at rest at both ends
    const Vector3 origin = start.translation() + s * (world_from_tip.translation() - start.translation());
    if (k > 0) q = solve(world, make_transform(origin, turn_start.slerp(s, turn_end)), q);
    const JointVector zero = JointVector::Zero(q.size());
    path.knots.push_back({total * k / (kKnots - 1), q, zero, zero});
  }
  for (std::size_t k = 1; k + 1 < path.knots.size(); ++k) {
    const double before = static_cast<double>(path.knots[k].step - path.knots[k - 1].step) * world.dt();
    const double after = static_cast<double>(path.knots[k + 1].step - path.knots[k].step) * world.dt();
    const JointVector in = (path.knots[k].position - path.knots[k - 1].position) / before;
    const JointVector out = (path.knots[k + 1].position - path.knots[k].position) / after;
    path.knots[k].velocity = (in + out) / 2;
    path.knots[k].acceleration = (out - in) * 2 / (before + after);
  }
  world.apply(operation::Follow{path});
  run(world, seconds);
}

void grip(World& world, double opening, double force, double seconds) {
  world.apply(operation::Hand{opening, force});
  run(world, seconds);
}

}  // namespace stampede::testing
