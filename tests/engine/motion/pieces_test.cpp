// Ways of the tool in pieces: where they lead, how fast, without stops but where one is asked for.
#include "engine/motion/pieces.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/motion/blended_path.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

struct Space {
  World world{std::make_shared<Scene>(table_scene(0))};
  CollisionState state = world.collision_state();
  JointVector start;
  Transform begin;

  explicit Space(const Transform& from = above(0.45, -0.1, 0.25)) {
    start = *state.arm().solve(from, state.arm().home(), RandomKey("start"));
    begin = state.arm().world_from_tip(start);
  }
  Transform tip(const Trajectory& trajectory, double step) const {
    return state.arm().world_from_tip(evaluate(trajectory, step, kHz).position);
  }
  double speed(const Trajectory& trajectory, double step) const {
    const JointState at = evaluate(trajectory, step, kHz);
    return (state.arm().jacobian(at.position).topRows<3>() * at.velocity).norm();
  }
  double turn_speed(const Trajectory& trajectory, double step) const {
    const JointState at = evaluate(trajectory, step, kHz);
    return (state.arm().jacobian(at.position).bottomRows<3>() * at.velocity).norm();
  }
};

ToolPiece line(const Transform& from, const Vector3& by, const std::string& name = "") {
  ToolPiece piece;
  piece.world_from_tip = [from, by](double share) { return Transform(translation(Vector3(share * by)) * from); };
  piece.name = name;
  return piece;
}

ToolPiece around(const Transform& from, const Vector3& centre, double angle, const std::string& name = "") {
  ToolPiece piece;
  piece.world_from_tip = [=](double share) {
    return Transform(translation(centre) * Eigen::AngleAxisd(share * angle, Vector3::UnitZ()) *
                     translation(Vector3(-centre)) * from);
  };
  piece.name = name;
  return piece;
}

double distance_to_line(const Vector3& point, const Vector3& from, const Vector3& along) {
  const double share = std::clamp((point - from).dot(along) / along.squaredNorm(), 0.0, 1.0);
  return (from + share * along - point).norm();
}

}  // namespace

TEST_CASE("the corner of two lines is passed without a stop, and cut within the blend alone") {
  const Space space;
  const Vector3 right(0, 0.2, 0), down(0, 0, -0.12);
  const std::vector<ToolPiece> pieces{line(space.begin, right, "corner"), line(translation(right) * space.begin, down)};
  const Vector3 corner = (translation(right) * space.begin).translation();
  for (const double blend : {0.03, 0.01}) {
    const auto motion = plan_pieces({space.state, space.start, {}, RandomKey("corner")}, pieces, {blend, false});
    INFO(motion.detail);
    REQUIRE(motion.reason == Reason::none);
    REQUIRE(motion.vias.size() == 1);
    CHECK(motion.vias[0].by_time);
    const double passed = static_cast<double>(motion.vias[0].step);
    CHECK(space.speed(motion.trajectory, passed) > 0.03);
    // Half way round it a quarter of |v - u| blend from the corner.
    CHECK((space.tip(motion.trajectory, passed).translation() - corner).norm() ==
          Approx(blend * std::sqrt(2.0) / 4).margin(0.0015));
    double off = 0;
    for (double step = 0; step <= static_cast<double>(motion.trajectory.steps()); ++step) {
      const Vector3 at = space.tip(motion.trajectory, step).translation();
      if ((at - corner).norm() < blend + 0.001) continue;
      off = std::max(
          off, std::min(distance_to_line(at, space.begin.translation(), right), distance_to_line(at, corner, down)));
    }
    CHECK(off < 0.001);
    const Vector3 end = space.tip(motion.trajectory, 1e9).translation();
    CHECK((end - corner - down).norm() < 2e-4);
    CHECK(limit_usage(motion.trajectory, space.state.arm().limits(), {}, kHz) <= 1.0);
  }
}

TEST_CASE("each piece keeps its own speed, and a stop is a stop") {
  const Space space;
  std::vector<ToolPiece> pieces{line(space.begin, {0, 0.2, 0}, "fast"),
                                line(translation(0, 0.2, 0) * space.begin, {0, 0.1, 0}, "slow")};
  pieces[0].speed = 0.3;
  pieces[1].speed = 0.05;
  const auto flowing = plan_pieces({space.state, space.start, {}, RandomKey("speed")}, pieces, {});
  REQUIRE(flowing.reason == Reason::none);
  double fastest[2] = {0, 0}, slowest = 1;
  for (double step = 0; step < static_cast<double>(flowing.trajectory.steps()); ++step) {
    const double y = space.tip(flowing.trajectory, step).translation().y() - space.begin.translation().y();
    const double speed = space.speed(flowing.trajectory, step);
    if (std::abs(y - 0.2) > 0.02) fastest[y > 0.2] = std::max(fastest[y > 0.2], speed);
    if (y > 0.05 && y < 0.25) slowest = std::min(slowest, speed);
  }
  CHECK(fastest[0] == Approx(0.3).margin(0.01));
  CHECK(fastest[1] == Approx(0.05).margin(0.003));
  CHECK(slowest > 0.045);
  pieces[0].stop = true;
  const auto halting = plan_pieces({space.state, space.start, {}, RandomKey("speed")}, pieces, {});
  REQUIRE(halting.reason == Reason::none);
  REQUIRE(halting.vias.size() == 2);
  const double halt = static_cast<double>(halting.vias[0].step);
  CHECK(space.speed(halting.trajectory, halt) < 1e-9);
  CHECK((space.tip(halting.trajectory, halt).translation() - space.begin.translation() - Vector3(0, 0.2, 0)).norm() <
        2e-4);
  CHECK(halting.vias[1].step == halting.trajectory.steps());
}

TEST_CASE("a full circle ends where it began, and its end is not taken for its beginning") {
  const Space space(above(0.5, -0.08, 0.25));
  const Vector3 centre = space.begin.translation() + Vector3(0, 0.08, 0);
  std::vector<ToolPiece> pieces{
      around(space.begin, centre, std::numbers::pi, "half"),
      around(around(space.begin, centre, std::numbers::pi).world_from_tip(1), centre, -std::numbers::pi, "back")};
  pieces[1].opening = 0.03;
  for (ToolPiece& piece : pieces) piece.turn_speed = 0.8;
  const auto motion = plan_pieces({space.state, space.start, {}, RandomKey("circle")}, pieces, {});
  INFO(motion.detail);
  REQUIRE(motion.reason == Reason::none);
  double off = 0, turning = 0;
  for (double step = 0; step < static_cast<double>(motion.trajectory.steps()); ++step) {
    off = std::max(off, std::abs((space.tip(motion.trajectory, step).translation() - centre).norm() - 0.08));
    turning = std::max(turning, space.turn_speed(motion.trajectory, step));
  }
  CHECK(off < 0.001);
  CHECK(turning == Approx(0.8).margin(0.03));
  CHECK((space.tip(motion.trajectory, 1e9).translation() - space.begin.translation()).norm() < 3e-4);
  REQUIRE(motion.vias.size() == 2);
  CHECK(motion.vias[0].step == Approx(motion.trajectory.steps() / 2.0).margin(12));
  CHECK(motion.vias[1].step == motion.trajectory.steps());
  REQUIRE(motion.hands.size() == 1);
  CHECK(motion.hands[0].step == motion.vias[0].step);
  CHECK(motion.hands[0].opening == 0.03);
}

TEST_CASE("what is wrong with a way names its piece") {
  const Space space;
  std::vector<ToolPiece> pieces{line(space.begin, {0, 0.1, 0}),
                                line(translation(0, 0.1, 0) * space.begin, {0, 2, 0}, "far")};
  const auto far = plan_pieces({space.state, space.start, {}, RandomKey("far")}, pieces, {});
  CHECK(far.reason == Reason::unreachable);
  CHECK_THAT(far.detail, Catch::StartsWith("piece 2 'far': the arm cannot follow beyond"));
  CHECK(far.trajectory.knots.empty());
  pieces[1] = line(translation(0, 0.1, 0) * space.begin, {0, 0, -0.3});
  const auto through = plan_pieces({space.state, space.start, {}, RandomKey("table")}, pieces, {0.01, true});
  CHECK(through.reason == Reason::no_path);
  CHECK_THAT(through.detail, Catch::StartsWith("piece 2: ") && Catch::Contains("table"));
  CHECK(plan_pieces({space.state, space.start, {}, RandomKey("table")}, pieces, {}).reason == Reason::none);
  CHECK_THROWS_WITH(plan_pieces({space.state, space.start, {}, RandomKey("none")}, {}, {}),
                    Catch::Contains("one piece"));
  pieces[0].speed = 0;
  CHECK_THROWS_WITH(plan_pieces({space.state, space.start, {}, RandomKey("slow")}, pieces, {}),
                    Catch::Contains("piece 1: the tool's speed"));
  CHECK_THROWS_AS(plan_pieces({space.state, space.start, {}, RandomKey("blend")}, pieces, {-1, false}), Error);
}

TEST_CASE("the same way is planned twice to the last bit") {
  const Space space;
  const std::vector<ToolPiece> pieces{line(space.begin, {0, 0.2, 0}),
                                      line(translation(0, 0.2, 0) * space.begin, {0.1, 0, 0})};
  const auto one = plan_pieces({space.state, space.start, {}, RandomKey("twice")}, pieces, {});
  const auto two = plan_pieces({space.state, space.start, {}, RandomKey("twice")}, pieces, {});
  REQUIRE(one.trajectory.knots.size() == two.trajectory.knots.size());
  for (std::size_t i = 0; i < one.trajectory.knots.size(); ++i)
    CHECK(one.trajectory.knots[i].position == two.trajectory.knots[i].position);
}
