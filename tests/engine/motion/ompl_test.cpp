// OMPL's planners by name: ways that hold, the same again, and names that are not offered.
#include <catch2/catch.hpp>
#include <thread>

#include "engine/base/error.h"
#include "tests/engine/motion/cluttered.h"

using namespace stampede;

namespace {

struct Ends {
  JointVector start, goal;
};

// Around posts, not in a straight line.
Ends ends(const CollisionState& state, int number) {
  Random random(RandomKey("ompl").with(number));
  const JointVector start = random_free(state, random);
  return {start, random_free(state, random)};
}

JointPath asked(const CollisionState& state, const std::string& planner, int number) {
  const Ends of = ends(state, number);
  MotionLimits limits;
  limits.planner = planner;
  limits.iterations = 4000;  // those that optimise use them all
  return plan_path({state, of.start, limits, RandomKey("way").with(number)}, of.goal);
}

}  // namespace

TEST_CASE("each planner of OMPL by its own name finds ways that are free, and the same again") {
  const World world(cluttered_scene(6));
  const CollisionState state = world.collision_state();
  const std::vector<std::string> names = motion_planner_names();
  CHECK(names.size() >= 30);
  for (const std::string& name : names) {
    INFO(name);
    int solved = 0;
    for (int k = 0; k < 1; ++k) {
      const JointPath path = asked(state, name, k), again = asked(state, name, k);
      CHECK(path.waypoints == again.waypoints);
      CHECK(path.reason == again.reason);
      if (path.reason != Reason::none) continue;
      ++solved;
      CHECK(path.waypoints.front() == ends(state, k).start);
      CHECK(path.waypoints.back() == ends(state, k).goal);
      for (std::size_t i = 1; i < path.waypoints.size(); ++i) {
        const JointVector step = path.waypoints[i] - path.waypoints[i - 1];
        const int count = 1 + static_cast<int>(step.cwiseAbs().maxCoeff() / 0.0025);
        for (int s = 0; s <= count; ++s)
          REQUIRE(state.free(path.waypoints[i - 1] + (static_cast<double>(s) / count) * step));
      }
    }
    CHECK(solved >= 1);
  }
}

TEST_CASE("what another planner did before, or does beside it, changes nothing") {
  const World world(cluttered_scene(6));
  const CollisionState state = world.collision_state();
  const JointPath alone = asked(state, "ompl:RRT", 0);
  asked(state, "ompl:PRM", 1);
  JointPath beside, other;
  std::thread busy([&] { other = asked(state, "ompl:EST", 1); });
  beside = asked(state, "ompl:RRT", 0);
  busy.join();
  CHECK(beside.waypoints == alone.waypoints);
  CHECK(other.waypoints == asked(state, "ompl:EST", 1).waypoints);
}

TEST_CASE("a planner that there is not is named with the nearest, one that is not offered with the reason") {
  CHECK_NOTHROW(check_motion_planner("", "--motion-planner"));
  CHECK_NOTHROW(check_motion_planner("ompl:BITstar", "--motion-planner"));
  CHECK_THROWS_WITH(check_motion_planner("ompl:RRTConect", "--motion-planner"),
                    Catch::Contains("--motion-planner: there is no motion planner 'ompl:RRTConect'\n") &&
                        Catch::Contains("did you mean 'ompl:RRTConnect'?"));
  CHECK_THROWS_WITH(check_motion_planner("RRTConnect", "world"), Catch::Contains("ompl:RRTConnect"));
  CHECK_THROWS_WITH(check_motion_planner("ompl:pRRT", "--motion-planner"),
                    Catch::Contains("'ompl:pRRT' is not offered: it runs in several threads: not reproducible"));
}
