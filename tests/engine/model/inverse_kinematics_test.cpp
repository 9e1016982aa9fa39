#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/model/kinematics.h"
#include "tests/support/panda.h"

using namespace stampede;

namespace {

JointVector random_joints(const Arm& arm, Random& random) {
  JointVector q(arm.joints());
  for (Eigen::Index i = 0; i < q.size(); ++i)
    q[i] = random.between(arm.limits()[static_cast<std::size_t>(i)].lower,
                          arm.limits()[static_cast<std::size_t>(i)].upper);
  return q;
}

bool reaches(const Arm& arm, const JointVector& q, const Transform& target) {
  const Transform tip = arm.world_from_tip(q);
  return (tip.translation() - target.translation()).norm() < 1e-4 &&
         angle_between(Quaternion(tip.linear()), Quaternion(target.linear())) < 1e-3;
}

}  // namespace

TEST_CASE("at least 99.9 % of reachable poses are reached from home, within the limits") {
  const Arm arm(panda_robot(make_transform({-0.3, 0, 0.75}, Quaternion(0.8, 0, 0, 0.6))));
  Random random(RandomKey("reachable"));
  int found = 0;
  for (int k = 0; k < 2000; ++k) {
    const Transform target = arm.world_from_tip(random_joints(arm, random));
    const std::optional<JointVector> q = arm.solve(target, arm.home(), RandomKey("ik").with(k));
    if (!q) continue;
    REQUIRE(reaches(arm, *q, target));
    REQUIRE(arm.within_limits(*q));
    ++found;
  }
  CHECK(found >= 1998);
}

TEST_CASE("the same question has the same answer, bit for bit") {
  const Arm arm(panda_robot());
  Random random(RandomKey("repeat"));
  const Transform target = arm.world_from_tip(random_joints(arm, random));
  const auto first = arm.solve(target, arm.home(), RandomKey("ik"));
  for (int k = 0; k < 50; ++k)
    (void)arm.solve(arm.world_from_tip(random_joints(arm, random)), arm.home(), RandomKey("x"));
  const auto again = arm.solve(target, arm.home(), RandomKey("ik"));
  REQUIRE(first);
  REQUIRE(again);
  CHECK(*first == *again);
}

TEST_CASE("a pose beyond the arm's length has no solution") {
  const Arm arm(panda_robot());
  CHECK_FALSE(arm.solve(translation(2, 0, 0.5), arm.home(), RandomKey("far")));
  CHECK(arm.solutions(translation(2, 0, 0.5), arm.home(), RandomKey("far"), 4).empty());
}

TEST_CASE("several solutions are distinct, all reach, and come nearest first") {
  const Arm arm(panda_robot());
  const Transform target = arm.world_from_tip(arm.home());
  const auto solutions = arm.solutions(target, arm.home(), RandomKey("many"), 8);
  REQUIRE(solutions.size() == 8);
  CHECK((solutions.front() - arm.home()).norm() < 1e-6);  // home itself
  for (std::size_t i = 0; i < solutions.size(); ++i) {
    CHECK(reaches(arm, solutions[i], target));
    CHECK(arm.within_limits(solutions[i]));
    if (i > 0) CHECK((solutions[i] - arm.home()).norm() >= (solutions[i - 1] - arm.home()).norm());
    for (std::size_t j = 0; j < i; ++j) CHECK((solutions[i] - solutions[j]).cwiseAbs().maxCoeff() > 0.1);
  }
}

TEST_CASE("a pose that is not finite is an error") {
  const Arm arm(panda_robot());
  Transform target = Transform::Identity();
  target.translation().x() = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(arm.solve(target, arm.home(), RandomKey("nan")), Error);
}
