// Scenes and moves that the tests of the simulated world share.
#pragma once

#include <memory>

#include "engine/sim/world.h"
#include "tests/support/panda.h"

namespace stampede::testing {

Shape box_shape(const Vector3& size, const Vector3& centre = Vector3::Zero());
Body box_body(const std::string& name, const Vector3& size, const Vector3& centre, double mass);  // mass 0: fixed

// A chest in front of the arm with one drawer (part 1) that slides out 0.2 m towards the robot by a bar handle.
Body chest(const Vector3& centre);
// A push button (part 1) that sinks 5 mm and returns.
Body button(const Vector3& centre);
// A door (part 1, hinge about z) locked until its lever (part 2) is pressed below -30 degrees.
Body latched_door(const Vector3& origin);
// On the base part, without shapes or mass.
Part moving_part(const std::string& name, JointKind kind, const Vector3& axis, const Vector3& origin, double lower,
                 double upper);

// Puts bodies in the order that Scene asks for: fixed first.
void add_body(Scene& scene, Body body);
std::shared_ptr<const Scene> shared(Scene scene);
int body_index(const World& world, const char* name);

JointVector solve(const World& world, const Transform& world_from_tip, const JointVector& near);
Transform tip_down(double x, double y, double z, double yaw = 0);  // the tip pointing down, closing along y at yaw 0

void run(World& world, double seconds);  // frames are closed every 12 steps
void move_to(World& world, const JointVector& q, double seconds);
// The tip moves in a straight line, in `seconds`, at rest at both ends.
void move_line(World& world, const Transform& world_from_tip, double seconds);
void grip(World& world, double opening, double force = 20, double seconds = 0.6);

}  // namespace stampede::testing
