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

TEST_CASE(
    "what is missing of a pose out of reach: so much nearer to the shoulder it can be reached, and not much before") {
  const Arm arm(panda_robot());
  const Vector3 shoulder(0, 0, 0.333);
  for (const double x : {0.95, 1.1, 1.3}) {
    const Transform target = translation(x, 0, 0.2) * rotation_rpy(3.14159, 0, 0);
    REQUIRE_FALSE(arm.solve(target, arm.home(), RandomKey("ik")));
    const auto missing = arm.shortfall(target, arm.home(), RandomKey("why"));
    REQUIRE(missing);
    REQUIRE(missing->joint < 0);
    const auto nearer = [&](double way) {
      Transform moved = target;
      moved.translation() += way * (shoulder - target.translation()).normalized();
      return arm.solve(moved, arm.home(), RandomKey("ik")).has_value();
    };
    CHECK(nearer(missing->way_m));
    CHECK_FALSE(nearer(0.8 * missing->way_m));
  }
}

TEST_CASE("what is missing of a pose that a joint's limit forbids: at most what one way to it goes beyond") {
  const Arm arm(panda_robot());
  constexpr double kBeyond = 0.04;  // rad
  Random random(RandomKey("beyond"));
  int by_joint = 0;
  for (int k = 0; k < 1400; ++k) {
    JointVector q = random_joints(arm, random);
    const Eigen::Index joint = k % q.size();
    q[joint] = arm.limits()[static_cast<std::size_t>(joint)].upper + kBeyond;
    const Transform target = arm.world_from_tip(q);
    if (arm.solve(target, arm.home(), RandomKey("ik"))) continue;  // another way stays within the limits
    const auto missing = arm.shortfall(target, q, RandomKey("why"));
    REQUIRE(missing);
    if (missing->joint < 0) {
      CHECK(missing->way_m < 0.3 * kBeyond + 1e-3);
      continue;
    }
    CHECK((missing->angle > 0 && missing->angle < kBeyond + 1e-3));
    ++by_joint;
  }
  CHECK(by_joint > 0);
}
