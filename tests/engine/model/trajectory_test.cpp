#include "engine/model/trajectory.h"

#include <catch2/catch.hpp>

using namespace stampede;

namespace {

JointVector one(double value) { return JointVector::Constant(1, value); }

}  // namespace

TEST_CASE("a quintic through a quintic's own knots is that quintic") {
  // x = 1 + 2t + 3t^2 - 4t^3 + 5t^4 - 6t^5 sampled every half second at 240 Hz.
  const auto knot = [](std::int64_t step) {
    const double t = static_cast<double>(step) / 240;
    return Trajectory::Knot{step, one(1 + t * (2 + t * (3 + t * (-4 + t * (5 - 6 * t))))),
                            one(2 + t * (6 + t * (-12 + t * (20 - 30 * t)))), one(6 + t * (-24 + t * (60 - 120 * t)))};
  };
  const Trajectory trajectory{{knot(0), knot(120), knot(240)}};
  CHECK(trajectory.steps() == 240);
  for (int step = 0; step < 240; ++step) {
    const JointState state = evaluate(trajectory, step, 240);
    const Trajectory::Knot expected = knot(step);
    REQUIRE((state.position - expected.position).norm() < 1e-12);
    REQUIRE((state.velocity - expected.velocity).norm() < 1e-11);
    REQUIRE((state.acceleration - expected.acceleration).norm() < 1e-10);
  }
}

TEST_CASE("knots are met exactly, before the first and after the last nothing moves on") {
  const Trajectory trajectory{
      {{0, one(0.1), one(0.2), one(0.3)}, {24, one(0.4), one(0.5), one(0.6)}, {60, one(1), one(0.7), one(0)}}};
  CHECK(evaluate(trajectory, 0, 240).position == one(0.1));
  CHECK(evaluate(trajectory, 24, 240).velocity == one(0.5));
  CHECK(evaluate(trajectory, -5, 240).position == one(0.1));
  CHECK(evaluate(trajectory, 60, 240).position == one(1));
  CHECK(evaluate(trajectory, 61, 240).velocity == one(0));  // the arm holds still
  CHECK(evaluate({}, 3, 240).position.size() == 0);
}
