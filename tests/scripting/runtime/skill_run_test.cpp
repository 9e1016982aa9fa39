#include <catch2/catch.hpp>

#include "scripts_fixture.h"

using namespace stampede;
using test::SmallWorld;

namespace {

ContinuousValue number(const std::string& name, std::vector<double> values) {
  ContinuousValue value;
  value.record.name = name;
  value.record.values = std::move(values);
  return value;
}

ContinuousValue grasp() {
  ContinuousValue value;
  value.record.name = "grasp";
  GraspCandidate candidate;
  candidate.world_from_tip = translation(1, 2, 3);
  candidate.world_from_approach = translation(1, 2, 4);
  candidate.object_from_tip = Transform::Identity();
  candidate.force = 12;
  value.grasp = candidate;
  return value;
}

SkillCall everything() {
  SkillCall call{"everything", "", {"cube", "bench", "mini.hand"}, {}, ControllerKind::joint_impedance, 40};
  call.continuous = {grasp(), number("height", {0.125}), number("push", {1, 2, 3})};
  return call;
}

SkillCall wrong(double way) {
  SkillCall call{"wrong", "", {"cube", "mini.hand"}, {}, ControllerKind::joint_position, 0};
  call.continuous = {number("way", {way})};
  return call;
}

template <typename Call>
Call next(SkillRun& run, const WorldView& view) {
  const RobotCall call = run.next(view);
  if (const auto* fail = std::get_if<robot_call::Fail>(&call)) INFO("fail: " << fail->detail);
  REQUIRE(std::holds_alternative<Call>(call));
  return std::get<Call>(call);
}

void check_pieces(const robot_call::Follow& follow, const WorldView& view) {
  namespace piece = robot_call::piece;
  const Transform tip = view.world_from("mini.hand");
  CHECK((follow.blend == 0.02 && follow.press == 5.0 && follow.most_force == 30.0 && follow.press_along.isZero()));
  REQUIRE(follow.pieces.size() == 7);
  const auto& up = follow.pieces[0];
  CHECK(std::get<piece::Offset>(up.way).by == Vector3(0, 0, 0.1));
  CHECK((up.opening == 0.05 && up.speed == 0.4 && up.turn_speed == 2.0 && !up.stop));
  const auto& over = follow.pieces[1];
  CHECK((std::get<piece::Line>(over.way).target.translation() - tip.translation() - Vector3(0, 0.2, 0)).norm() < 1e-12);
  CHECK((over.stop && over.name == "over" && over.speed == 0.25 && !over.opening));
  const auto& arc = std::get<piece::Arc>(follow.pieces[2].way);
  CHECK((arc.axis == Vector3(0, 0, 1) && !arc.turn && arc.angle == Approx(std::acos(0.0))));
  CHECK(arc.point == view.world_from("cube").translation());
  const auto& round = std::get<piece::Arc>(follow.pieces[3].way);
  CHECK((round.point == Vector3(0.1, 0.2, 0.3) && round.turn && round.angle == -1.0));
  const auto& own = std::get<piece::Tilt>(follow.pieces[4].way);
  CHECK((own.axis == Vector3(0, 0, 1) && own.point == Vector3(0, 0, 0.05) && !own.in_world));
  CHECK(follow.pieces[4].turn_speed == 0.5);
  const auto& fixed = std::get<piece::Tilt>(follow.pieces[5].way);
  CHECK((fixed.in_world && fixed.point == tip.translation() && fixed.axis == Vector3(0, 1, 0)));
  CHECK((follow.pieces[6].opening == 0.01 && std::get<piece::Offset>(follow.pieces[6].way).by.isZero()));
}

}  // namespace

TEST_CASE("each robot method yields its call, one at a time") {
  SmallWorld small;
  const WorldView& view = small.view;
  const Vector3 tip = view.world_from("mini.hand").translation();
  const auto run = small.scripts.skills().start(everything(), view);

  CHECK(next<robot_call::Hand>(*run, view).opening == 0.06);  // as far as the hand goes
  CHECK(next<robot_call::Hand>(*run, view).opening == 0.02);
  const auto keyed = next<robot_call::MoveThrough>(*run, view).targets;
  REQUIRE(keyed.size() == 2);
  CHECK(keyed[0].name == "approach");  // first, whatever the table's own order
  CHECK(keyed[0].world_from_tip.translation() == Vector3(1, 2, 4));
  CHECK(keyed[1].name == "grasp");
  const auto listed_call = next<robot_call::MoveThrough>(*run, view);
  const auto& then = listed_call.then_follow;
  REQUIRE(then.size() == 2);
  CHECK(std::get<robot_call::piece::Offset>(then[0].way).by == Vector3(0, 0, 0.1));
  CHECK((std::get<robot_call::piece::Tilt>(then[1].way).angle == 2.0 && then[1].turn_speed == 0.5));
  const auto& listed = listed_call.targets;
  REQUIRE(listed.size() == 2);
  CHECK(listed[0].name == "second");
  CHECK(listed[1].name == "first");
  const auto close = next<robot_call::Hand>(*run, view);
  CHECK(close.expect == "cube");
  CHECK(close.force == 12.0);
  CHECK(close.opening == 0.0);
  const auto lift = next<robot_call::MoveLine>(*run, view);
  CHECK(lift.kind == "lift");
  CHECK((lift.target.translation() - tip - Vector3(0, 0, 0.125)).norm() < 1e-12);
  const auto line = next<robot_call::MoveLine>(*run, view);
  CHECK((line.target.translation() - tip - Vector3(0.1, 0, 0)).norm() < 1e-12);
  CHECK((line.speed == 0.05 && line.force == 7.0 && line.stop_on_contact && line.tolerate && !line.keep_clear));
  const auto retreat = next<robot_call::MoveLine>(*run, view);
  const Vector3 back = -view.world_from("mini.hand").linear().col(2);
  CHECK((retreat.target.translation() - tip - 0.08 * back).norm() < 1e-12);
  const auto to = next<robot_call::MoveThrough>(*run, view).targets;
  REQUIRE(to.size() == 1);
  CHECK((to[0].world_from_tip.translation() - tip - Vector3(0, 0, 0.25)).norm() < 1e-12);
  const Quaternion turned(to[0].world_from_tip.linear()), before(view.world_from("mini.hand").linear());
  CHECK(angle_between(turned, before) == Approx(std::acos(0.0)));
  const auto part = next<robot_call::MovePart>(*run, view);
  CHECK((part.object == "chest.drawer" && part.position == 0.1 && part.speed == 0.2 && part.pivot == 0.5));
  const auto reach = next<robot_call::ReachOfPart>(*run, view);
  CHECK((reach.object == "chest.drawer" && reach.position == 0.15 && reach.pivot == 0.2 && reach.retreat == 0.05));
  run->answer({0.125, {}});
  CHECK(next<robot_call::FindGrasp>(*run, view).object == "chest.drawer");
  GraspCandidate found = *grasp().grasp;
  found.reach = 0.0625;
  run->answer({{}, found});
  CHECK(next<robot_call::FindGrasp>(*run, view).position == 0.2);
  run->answer({});
  const auto as_far = next<robot_call::MovePart>(*run, view);
  CHECK((as_far.position == 0.125 && as_far.as_far_as_it_goes && !part.as_far_as_it_goes));
  const auto wipe = next<robot_call::MoveLine>(*run, view);
  CHECK((wipe.press == 8.0 && wipe.opening == 0.03 && wipe.press_along.normalized() == Vector3(0, 0, -1)));
  const auto search = next<robot_call::MoveLine>(*run, view);
  CHECK((search.search == 0.004 && search.search_pitch == 0.001 && search.force == 6.0));
  check_pieces(next<robot_call::Follow>(*run, view), view);
  const auto tilt = next<robot_call::Follow>(*run, view);
  REQUIRE(tilt.pieces.size() == 1);
  CHECK((tilt.pieces[0].name == "poured" && tilt.pieces[0].speed == 0.1));
  const auto& poured = std::get<robot_call::piece::Tilt>(tilt.pieces[0].way);
  CHECK((poured.angle == -1.5 && poured.axis == Vector3(1, 0, 0) && poured.in_world));
  CHECK(poured.point == view.world_from("cube").translation());
  CHECK(next<robot_call::Wait>(*run, view).seconds == 0.5);
  CHECK(next<robot_call::MoveJoints>(*run, view).target[2] == 1.0);
  const AskedCall child = next<robot_call::RunSkill>(*run, view).call;
  CHECK(child.skill == "counting");
  CHECK(child.arguments == std::vector<std::string>{"top", "bench", "mini.hand"});
  // The tip must rise by what the held object rises.
  const auto held = next<robot_call::MoveThrough>(*run, view).targets;
  CHECK((held[0].world_from_tip.translation() - tip - Vector3(0, 0, 1)).norm() < 1e-9);
  const auto fail = next<robot_call::Fail>(*run, view);
  CHECK(fail.reason == Reason::no_grasp);
  CHECK(fail.detail == "as planned");
}

TEST_CASE("a run that returns is done, and stays so") {
  SmallWorld small;
  const auto run =
      small.scripts.skills().start({"counting", "", {"cube", "bench", "mini.hand"}, {}, {}, 0}, small.view);
  CHECK(next<robot_call::Wait>(*run, small.view).seconds == 1.0);
  CHECK(next<robot_call::Wait>(*run, small.view).seconds == 2.0);
  next<robot_call::Done>(*run, small.view);
  next<robot_call::Done>(*run, small.view);
}

TEST_CASE("each run of a skill starts from fresh variables, also beside another run") {
  SmallWorld small;
  const SkillCall call{"counting", "", {"cube", "bench", "mini.hand"}, {}, {}, 0};
  const auto first = small.scripts.skills().start(call, small.view);
  CHECK(next<robot_call::Wait>(*first, small.view).seconds == 1.0);
  const auto second = small.scripts.skills().start(call, small.view);
  CHECK(next<robot_call::Wait>(*second, small.view).seconds == 1.0);
  CHECK(next<robot_call::Wait>(*first, small.view).seconds == 2.0);
}

TEST_CASE("what goes wrong in run is a failed call with a place, not an exception") {
  SmallWorld small;
  const std::pair<double, std::string> ways[] = {{1, "wrong.lua:2"},
                                                 {2, "instruction budget"},
                                                 {3, "finite"},
                                                 {4, "no option 'sped' here, there are: "},
                                                 {6, "not told its 'obj'"},
                                                 {5, "wrong.lua:29"},
                                                 {7, "expected a list of pieces"},
                                                 {8, "piece 2: no field 'up' here, there are: to by arc"},
                                                 {9, "piece 2: by must be three numbers"},
                                                 {10, "piece 1: 'chest.drawer' slides"},
                                                 {11, "piece 1: axis must have a length"},
                                                 {12, "piece 1: an arc needs about"},
                                                 {13, "piece 1: it goes nowhere"},
                                                 {14, "piece 1: to must be a pose"},
                                                 {15, "piece 1: tilt must be an angle"},
                                                 {16, "piece 1: it has several of to, by, arc and tilt"},
                                                 {17, "piece 1: speed and turn_speed must be positive"},
                                                 {18, "piece 1: expected a table"},
                                                 {19, "piece 1: 'cube' has no joint"},
                                                 {20, "search goes neither with press nor with stop_on_contact"},
                                                 {21, "cube: has no tip to move"},
                                                 {22, "top: is not in the hand, so its tip cannot be moved"},
                                                 {23, "piece 2: no field 'up' here, there are: to by arc"},
                                                 {24, "expected then_part or then_follow, not both"}};
  for (const auto& [way, expected] : ways) {
    const auto run = small.scripts.skills().start(wrong(way), small.view);
    next<robot_call::Wait>(*run, small.view);
    const auto fail = next<robot_call::Fail>(*run, small.view);
    CHECK(fail.reason == Reason::script_error);
    CHECK_THAT(fail.detail, Catch::Contains(expected));
    next<robot_call::Done>(*run, small.view);
  }
}

TEST_CASE("unknown skills and wrong numbers of arguments are told") {
  SmallWorld small;
  SkillLibrary& skills = small.scripts.skills();
  CHECK(skills.skill("nothing") == nullptr);
  CHECK_THROWS_AS(skills.start({"nothing", "", {}, {}, {}, 0}, small.view), Error);
  CHECK_THROWS_WITH(skills.start({"wrong", "", {"cube"}, {}, {}, 0}, small.view), Catch::Contains("arguments"));
}
