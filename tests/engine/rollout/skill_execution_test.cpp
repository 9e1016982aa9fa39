// One call of one skill, ticked by whoever drives it: here the test.
#include "engine/rollout/skill_execution.h"

#include <catch2/catch.hpp>

#include "engine/start/effects.h"
#include "engine/start/part_questions.h"
#include "engine/start/start.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

const PlanStep kPick{"pick", {"cube1", "table", "panda.hand"}};

// A running episode whose loop is the test's.
template <typename Words = plain::PlainSymbols>
struct RunningWith {
  explicit RunningWith(double horizon_s = 60) {
    const TaskDraw draw = [horizon_s](int) {
      Task task = plain::stack_task(2);
      task.horizon_s = horizon_s;
      return task;
    };
    options.seed = 1;
    start = prepare_start(draw, symbols, options);
    REQUIRE(start.reason == Reason::none);
    rollout.emplace(symbols, start, SensorReader(*start.scene, {}, RandomKey("test")), nullptr);
    execution.emplace(*rollout, symbols, skills, options);
  }

  SkillRequest request(const PlanStep& step) const {
    SkillRequest request;
    request.step = step;
    return request;
  }

  double height() const { return rollout->view().world_from("cube1").translation().z(); }

  const ParameterRecord& parameter(const std::string& name) {
    const auto& all = rollout->recorder().segment(execution->result().segment).parameters;
    return *std::find_if(all.begin(), all.end(), [&](const ParameterRecord& one) { return one.name == name; });
  }

  Words symbols;
  plain::PlainSkills skills;
  RunOptions options;
  PreparedStart start;
  std::optional<Rollout> rollout;
  std::optional<SkillExecution> execution;
};
using Running = RunningWith<>;

// How much the fingers close along x of the cube, 0 … 1.
double along_cube(const Transform& object_from_tip) { return std::abs(object_from_tip.linear().col(1).x()); }

// Knows a place on cube2 for what the hand holds along one side only.
struct OneSidePlaces : plain::PlainSymbols {
  std::vector<Placement> sample(const Fact& fact, const WorldView& view, const CollisionState& state, RandomKey key,
                                int most) override {
    const bool placing = fact == Fact{"on", {"cube1", "cube2"}};
    if (placing && view.grasped("cube1").holds) {
      const double along = along_cube(view.world_from("cube1").inverse() * view.world_from("panda.hand"));
      REQUIRE(state.held() == view.part_of("cube1").body);
      REQUIRE(state.opening() == view.opening());
      if ((along > 0.5) != wants_along) return {};
    }
    return PlainSymbols::sample(fact, view, state, key, most);
  }
  bool wants_along = true;
};

// All that begin() could have touched.
auto traces(Running& running) {
  Rollout& rollout = *running.rollout;
  return std::make_tuple(rollout.world().state_hash(), rollout.world().log().size(), rollout.recorder().segments.size(),
                         rollout.step(), running.execution->status());
}

}  // namespace

TEST_CASE("a skill is ticked to its end, a physics step at a time") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  std::int64_t ticks = 0;
  while (running.execution->tick() == SkillStatus::running) {
    CHECK(running.rollout->step() == ticks++);
    running.rollout->advance();
  }
  INFO(running.execution->result().detail);
  REQUIRE(running.execution->status() == SkillStatus::done);
  CHECK(running.rollout->facts().facts().contains({"holding", {"panda.hand", "cube1"}}));
  CHECK(running.execution->tick() == SkillStatus::done);  // once over, ticks change nothing
  CHECK(running.rollout->step() == ticks);
  REQUIRE_FALSE(running.execution->begin(running.request({"place", {"cube1", "cube2", "panda.hand"}})));
  CHECK(run_to_end(*running.execution, *running.rollout).ok());
}

TEST_CASE("a skill whose declared effects hold already ends at once: it succeeds, and nothing moves") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
  const std::string before = running.rollout->world().state_hash();
  const std::int64_t step = running.rollout->step();
  SkillRequest again = running.request(kPick);
  again.mode.refuse = false;
  REQUIRE_FALSE(running.execution->begin(again));
  CHECK(running.execution->tick() == SkillStatus::done);
  CHECK(running.rollout->step() == step);
  CHECK(running.rollout->world().state_hash() == before);
  const SegmentRecord& segment = running.rollout->recorder().segment(running.execution->result().segment);
  CHECK((segment.outcome == Outcome::success && segment.effect_held == true));
  CHECK(segment.precondition_held == false);
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));  // who minds its precondition is told so
  CHECK(running.execution->result().reason == Reason::precondition_false);
  REQUIRE_FALSE(running.execution->begin(running.request({"place", {"cube1", "table", "panda.hand"}})));
  CHECK(run_to_end(*running.execution, *running.rollout).ok());  // what has something to do does it
  CHECK(running.rollout->step() > step);
}

TEST_CASE("what is lost is dropped once: whoever goes on has an empty hand") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
  running.rollout->world().apply(operation::Hand{0.08, 20});
  SkillRequest place = running.request({"place", {"cube1", "cube2", "panda.hand"}});
  place.mode.refuse = false;
  REQUIRE_FALSE(running.execution->begin(place));
  CHECK(run_to_end(*running.execution, *running.rollout).reason == Reason::dropped);
  CHECK_FALSE(running.rollout->keep);
  REQUIRE_FALSE(running.execution->begin(place));
  CHECK(run_to_end(*running.execution, *running.rollout).reason != Reason::dropped);
}

TEST_CASE("a call that cannot be is an error value, and nothing has changed") {
  Running running;
  const auto before = traces(running);
  const auto refused = [&](const SkillRequest& request) {
    const std::optional<Error> refusal = running.execution->begin(request);
    REQUIRE(refusal);
    CHECK(traces(running) == before);
    return std::string(refusal->what());
  };
  CHECK_THAT(refused(running.request({"jump", {}})), Catch::Contains("no skill for the action 'jump'"));
  CHECK_THAT(refused(running.request({"pick", {"cube1"}})), Catch::Contains("takes 3 arguments"));
  CHECK_THAT(refused(running.request({"pick", {"cube9", "table", "panda.hand"}})), Catch::Contains("no 'cube9'"));
  CHECK_THAT(refused(running.request({"pick", {"table", "table", "panda.hand"}})), Catch::Contains("movable"));
  SkillRequest high = running.request(kPick);
  high.set.values = {{"height", 0, {0.9}}};
  CHECK_THAT(refused(high), Catch::Contains("pick.height is at most 0.3m, not 0.9"));
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));  // none of it was in the way
}

TEST_CASE("while one call is under way, and after the episode has ended, there is no other") {
  Running running(0.5);
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  SkillExecution other(*running.rollout, running.symbols, running.skills, running.options);
  const auto refusal = other.begin(running.request(kPick));
  REQUIRE(refusal);
  CHECK_THAT(refusal->what(), Catch::Contains("another skill is being executed"));
  const SkillResult& result = run_to_end(*running.execution, *running.rollout);
  CHECK(result.reason == Reason::timeout);
  CHECK(result.ends_episode);
  const auto before = traces(running);
  const auto late = running.execution->begin(running.request(kPick));
  REQUIRE(late);
  CHECK_THAT(late->what(), Catch::Contains("the episode has ended"));
  CHECK(traces(running) == before);
}

TEST_CASE("a call can be cut off between two ticks, the next one begins from rest") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  for (int i = 0; i < 120; ++i) {
    REQUIRE(running.execution->tick() == SkillStatus::running);
    running.rollout->advance();
  }
  REQUIRE(running.rollout->world().arm_velocity().cwiseAbs().maxCoeff() > 0.1);
  running.execution->interrupt("something better to do");
  CHECK(running.execution->status() == SkillStatus::failed);
  CHECK(running.execution->result().reason == Reason::interrupted);
  CHECK_FALSE(running.execution->result().ends_episode);
  for (const SegmentRecord& segment : running.rollout->recorder().segments) {
    INFO(segment.skill);
    CHECK(segment.reason == (segment.skill == "open_hand" ? Reason::none : Reason::interrupted));
    CHECK(segment.span.end_step <= running.rollout->step());
  }
  const std::size_t cut = running.rollout->recorder().segments.size();
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  const SkillResult& again = run_to_end(*running.execution, *running.rollout);
  INFO(again.detail);
  CHECK(again.ok());
  CHECK(running.rollout->recorder().segments.at(cut + 1).skill == "brake");
}

TEST_CASE("left alone after it was cut off, the arm comes to rest") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  for (int i = 0; i < 120 && running.execution->tick() == SkillStatus::running; ++i) running.rollout->advance();
  running.execution->interrupt("enough");
  for (int i = 0; i < 240; ++i) running.rollout->advance();
  CHECK(running.rollout->world().arm_velocity().cwiseAbs().maxCoeff() < 0.01);
}

TEST_CASE("a skill that another skill ran leaves it its own controller") {
  struct Twice : plain::PlainSkills {  // the first pick leaves all to a second one, which is compliant
    std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override {
      if (std::exchange(outer, false)) {
        AskedCall inner{call.skill, {}, call.arguments, {}};
        inner.set.controller = ControllerKind::joint_impedance;
        return std::make_unique<plain::CallList>(
            std::vector<RobotCall>{robot_call::RunSkill{inner}, robot_call::Wait{0.1}});
      }
      inside = view.world().controller().kind;
      return PlainSkills::start(call, view);
    }
    bool outer = true;
    ControllerKind inside = ControllerKind::joint_position;
  };
  Running running;
  Twice skills;
  SkillExecution execution(*running.rollout, running.symbols, skills, running.options);
  REQUIRE_FALSE(execution.begin(running.request(kPick)));
  const SkillResult& result = run_to_end(execution, *running.rollout);
  INFO(result.detail);
  CHECK(result.ok());
  CHECK(skills.inside == ControllerKind::joint_impedance);
  CHECK(running.rollout->world().controller().kind == ControllerKind::joint_position);
}

TEST_CASE("what a caller sets is not drawn, and says who chose it, the run's own words go first") {
  Running running;
  SkillRequest request = running.request(kPick);
  request.set.values = {{"height", 0, {0.2}}};
  request.set.controller = ControllerKind::joint_impedance;
  SECTION("the task's step") {
    const double before = running.height();
    REQUIRE_FALSE(running.execution->begin(request));
    REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
    CHECK(running.parameter("height").values == std::vector<double>{0.2});
    CHECK(running.parameter("height").chosen_by == ChosenBy::task);
    CHECK(running.parameter("grasp").chosen_by == ChosenBy::stream);
    CHECK(running.parameter("controller").text == "joint_impedance");
    CHECK(running.height() - before == Approx(0.2).margin(0.02));
  }
  SECTION("the run") {
    running.options.set["pick"].values = {{"height", 1, {0.05}}};
    REQUIRE_FALSE(running.execution->begin(request));
    REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
    CHECK(running.parameter("height").values == std::vector<double>{0.05});
    CHECK(running.parameter("height").chosen_by == ChosenBy::caller);
  }
  SECTION("a grasp that was drawn before is the same grasp when it is set") {
    REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
    REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
    const std::vector<double> drawn = running.parameter("grasp").values;
    Running second;
    SkillRequest same = second.request(kPick);
    same.set.values = {{"grasp", 0, drawn}};
    REQUIRE_FALSE(second.execution->begin(same));
    REQUIRE(run_to_end(*second.execution, *second.rollout).ok());
    CHECK(second.parameter("grasp").chosen_by == ChosenBy::task);
    for (std::size_t i = 0; i < drawn.size(); ++i)
      CHECK(second.parameter("grasp").values[i] == Approx(drawn[i]).margin(1e-9));
  }
}

TEST_CASE("what a precondition asked for is recorded literal by literal, as it was when the call began") {
  Running running;
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  const auto literals = [&] { return running.rollout->recorder().segments.front().preconditions; };
  const std::vector<PreconditionRecord> before{{{"on", {"cube1", "table"}}, false, true, -1},
                                               {{"hand_empty", {"panda.hand"}}, false, true, -1}};
  CHECK(literals() == before);
  REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
  CHECK(literals() == before);  // by now the hand holds it
}

TEST_CASE("the literals of a precondition: instances of forall, ways of a choice, negations and equality") {
  Domain domain = plain::domain();
  const auto on = [](Term a, Term b) { return atom("on", {std::move(a), std::move(b)}); };
  const Term obj{true, "obj"}, below{true, "below"}, other{true, "other"}, table{false, "table"};
  Formula covered;  // something movable is on it
  covered.kind = Formula::Kind::exists;
  covered.variables = {{"other", "", {"movable"}}};
  covered.parts = {on(other, obj)};
  Formula same;
  same.kind = Formula::Kind::equal;
  same.terms = {obj, below};
  Action action;
  action.parameters = {{"obj", "", {}}, {"below", "", {}}};
  action.precondition =
      conjunction({negation(covered), negation(same),
                   disjunction({on(obj, below), conjunction({on(obj, table), negation(atom("on", {below, obj}))})})});
  const std::vector<TypedObject> objects{{"a", "cube"}, {"b", "cube"}, {"table", "table"}};
  const Facts facts{{"movable", {"a"}}, {"movable", {"b"}}, {"on", {"a", "table"}}, {"on", {"b", "a"}}};
  const std::vector<PreconditionRecord> expected{
      {{"on", {"a", "a"}}, true, true, -1},     {{"on", {"b", "a"}}, true, false, -1},
      {{"=", {"a", "b"}}, true, true, -1},      {{"on", {"a", "b"}}, false, false, 0},
      {{"on", {"a", "table"}}, false, true, 0}, {{"on", {"b", "a"}}, true, false, 0}};
  CHECK(ground_precondition(action, {"a", "b"}, facts, domain, objects) == expected);
  action.precondition = {};
  CHECK(ground_precondition(action, {"a", "b"}, facts, domain, objects).empty());
}

TEST_CASE("a place that the arm cannot get to is drawn again, as long as it has not moved") {
  struct Skills : plain::PlainSkills {  // the first ways to each place lead where no arm reaches
    int bad = 0, started = 0;
    bool after_a_move = false;
    std::unique_ptr<SkillRun> start(const SkillCall& call, const WorldView& view) override {
      if (call.skill != "place" || started++ >= bad) return plain::PlainSkills::start(call, view);
      std::vector<RobotCall> calls{robot_call::MoveThrough{{{"far", translation(0, 0, 9)}}}};
      if (after_a_move) calls.insert(calls.begin(), robot_call::MoveLine{translation(0, 0, 0.02)});
      return std::make_unique<plain::CallList>(calls);
    }
  };
  const PlanStep place{"place", {"cube1", "table", "panda.hand"}};
  Skills skills;
  Running running;
  running.execution.emplace(*running.rollout, running.symbols, skills, running.options);
  REQUIRE_FALSE(running.execution->begin(running.request(kPick)));
  REQUIRE(run_to_end(*running.execution, *running.rollout).ok());

  skills.bad = 100;
  skills.after_a_move = true;
  REQUIRE_FALSE(running.execution->begin(running.request(place)));
  CHECK(run_to_end(*running.execution, *running.rollout).reason == Reason::unreachable);
  CHECK(skills.started == 1);
  const auto first = running.parameter("spot").values;

  skills.started = 0;
  skills.after_a_move = false;
  REQUIRE_FALSE(running.execution->begin(running.request(place)));
  CHECK(run_to_end(*running.execution, *running.rollout).reason == Reason::unreachable);
  CHECK((skills.started > 3 && skills.started < 20));

  skills.started = 0;
  skills.bad = 2;
  REQUIRE_FALSE(running.execution->begin(running.request(place)));
  CHECK(run_to_end(*running.execution, *running.rollout).ok());
  CHECK(skills.started == 3);
  const auto& spot = running.parameter("spot").values;  // what it says is where the cube went
  CHECK(spot != first);
  CHECK((running.rollout->view().world_from("cube1").translation() - Vector3(spot[0], spot[1], spot[2])).norm() < 0.01);
}

TEST_CASE("a hand can grasp what is within its reach") {
  Running running;
  CHECK(can_grasp(running.rollout->view(), "cube1"));
  World& world = running.rollout->world();
  world.apply(operation::Place{world.scene().body_index("cube1"), translation(2, 0, 0.1)});
  CHECK_FALSE(can_grasp(running.rollout->view(), "cube1"));
}

TEST_CASE("a grasp is chosen with which the plan's next step finds a place, and where none does any is taken") {
  for (const bool wants_along : {true, false}) {
    RunningWith<OneSidePlaces> running;
    running.symbols.wants_along = wants_along;
    SkillRequest request = running.request(kPick);
    request.mode.then = {{"pick", {"cube2", "table", "panda.hand"}}, {"place", {"cube1", "cube2", "panda.hand"}}};
    REQUIRE_FALSE(running.execution->begin(request));
    CHECK(running.rollout->view().grasped_object().empty());  // it was imagined for the draw alone
    CHECK_FALSE(running.rollout->keep);
    REQUIRE(run_to_end(*running.execution, *running.rollout).ok());
    const std::vector<double>& grasp = running.parameter("grasp").values;
    const Quaternion turn(grasp[6], grasp[3], grasp[4], grasp[5]);
    CHECK((std::abs((turn * Vector3::UnitY()).x()) > 0.5) == wants_along);
  }
  RunningWith<OneSidePlaces> running;
  SkillRequest request = running.request(kPick);
  request.mode.then = {{"place", {"cube1", "", "panda.hand"}}};  // left open: nobody knows yet
  REQUIRE_FALSE(running.execution->begin(request));
  CHECK(run_to_end(*running.execution, *running.rollout).ok());
}
