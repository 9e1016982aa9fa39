#include "engine/record/arrays.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <sstream>

#include "engine/base/error.h"
#include "engine/start/abstract_state.h"
#include "engine/symbolic/pddl.h"
#include "tests/support/plain_task.h"

using namespace stampede;
using namespace stampede::plain;

namespace {

// Nobody sees what the lower cube lies on during the first second.
class DimSymbols : public PlainSymbols {
 public:
  bool can_hide(const std::string& predicate) const override { return predicate == "on"; }
  bool observable(const Fact& fact, const WorldView& view) override {
    return fact.arguments[0] != "cube2" || view.time_s() >= 1.0;
  }
};

const EpisodeRecord& stacked() {
  static const EpisodeRecord episode = [] {
    const TaskDraw task = stack_draw();
    DimSymbols symbols;
    PlainSkills skills;
    RunOptions options;
    options.seed = 1;
    return run_episode(task, symbols, skills, options);
  }();
  return episode;
}

const EpisodeArrays& arrays() {
  static const EpisodeArrays all = [] {
    EpisodeArrays made = episode_arrays(stacked());
    EpisodeArrays more = episode_arrays(stacked(), {{"applicable"}});
    made.columns.push_back(more.column("applicable"));
    made.skills = more.skills;
    return made;
  }();
  return all;
}

std::string text_of_file(const std::string& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::int64_t size_of(const ArrayColumn& column) {
  return std::visit([](const auto& values) { return static_cast<std::int64_t>(values.size()); }, column.data);
}

Facts facts_in(const ArrayColumn& column, std::size_t frame) {
  Facts facts;
  const std::size_t width = arrays().atoms.size();
  for (std::size_t i = 0; i < width; ++i)
    if (column.booleans()[frame * width + i] != 0)
      facts.insert({arrays().atoms[i].predicate, arrays().atoms[i].arguments});
  return facts;
}

}  // namespace

TEST_CASE("every column has the shape that it says, a row a frame where its rate is the frames'") {
  for (const ArrayColumn& column : arrays().columns) {
    INFO(column.name);
    std::int64_t product = 1;
    for (const std::int64_t extent : column.shape) product *= extent;
    CHECK(size_of(column) == product);
    if (column.rate_hz == arrays().frame_hz) CHECK(column.shape.at(0) == arrays().frames);
    if (!column.labels.empty()) CHECK(static_cast<std::int64_t>(column.labels.size()) == column.shape.back());
  }
}

TEST_CASE("the README describes every column that an episode has") {
  const std::string readme = text_of_file(std::string(STAMPEDE_SOURCE_DIR) + "/engine/record/README.md");
  for (const ArrayColumn& column : arrays().columns) {
    std::string name = column.name;
    if (const std::size_t slash = name.find('/'); slash != std::string::npos && !name.starts_with("action/"))
      name = name.substr(0, slash) + "/NAME";
    for (const Camera& camera : stacked().scene.cameras)
      if (name.starts_with(camera.name + "_")) name = "CAMERA" + name.substr(camera.name.size());
    INFO(name);
    CHECK(readme.find("`" + name + "`") != std::string::npos);
  }
}

TEST_CASE("columns hold what the frames hold") {
  const EpisodeRecord& episode = stacked();
  REQUIRE(episode.outcome == Outcome::success);
  const auto arm = arrays().column("joint_positions").reals();
  const auto tip = arrays().column("gripper_pose").reals();
  const auto matrix = arrays().column("gripper_matrix").reals();
  const auto action = arrays().column("action/joint_position").reals();
  REQUIRE(arrays().column("joint_positions").shape == std::vector<std::int64_t>{arrays().frames, 7});
  CHECK(arrays().column("gripper_joint_positions").shape.at(1) == 2);
  for (std::size_t f = 0; f < episode.frames.size(); ++f) {
    const FrameRecord& frame = episode.frames[f];
    for (std::size_t j = 0; j < 7; ++j) REQUIRE(arm[f * 7 + j] == frame.joint_position[j]);
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(tip[f * 7 + k] == frame.hands[0].tip.position[k]);
      REQUIRE(matrix[f * 16 + 4 * k + 3] == Approx(frame.hands[0].tip.position[k]).margin(1e-15));
    }
    for (std::size_t j = 0; j < 7; ++j)
      REQUIRE((frame.action ? action[f * 7 + j] == frame.action->joint_position[j] : std::isnan(action[f * 7 + j])));
  }
  const auto open = arrays().column("gripper_open").reals();
  const auto opening = arrays().column("gripper_opening").reals();
  for (std::size_t f = 0; f < open.size(); ++f) {  // the first finger decides, not the sum of both
    if (opening[f] > 0.076) REQUIRE(open[f] == 1);
    if (opening[f] < 0.068) REQUIRE(open[f] == 0);
  }
}

TEST_CASE("an object is at rest in the tool's frame while it is carried, and poses compose") {
  const auto in_tool = arrays().column("object_pose_in_tool/cube1").reals();
  const auto skill = arrays().column("skill").integers();
  const auto held = arrays().column("facts").booleans();
  std::size_t place = 0;
  while (arrays().atoms.at(place).predicate != "holding" || arrays().atoms[place].arguments.back() != "cube1") ++place;
  double least = 1e9, most = -1e9;
  int frames = 0;
  for (std::size_t f = 0; f < skill.size(); ++f) {
    if (held[f * arrays().atoms.size() + place] == 0) continue;
    ++frames;
    least = std::min(least, in_tool[f * 7 + 2]);
    most = std::max(most, in_tool[f * 7 + 2]);
  }
  CHECK(frames > 10);
  CHECK(most - least < 0.01);
  const ArrayColumn seen = arrays().pose_in("cube1", "cube2");
  CHECK(seen.frame == "cube2");
  const std::size_t last = static_cast<std::size_t>(arrays().frames - 1) * 7;
  CHECK(seen.reals()[last + 2] == Approx(0.05).margin(0.02));  // one cube upon the other
  CHECK_THROWS_WITH(arrays().pose_in("cube9", "cube2"), Catch::Contains("did you mean"));
}

TEST_CASE("rows of facts and of what is known are the abstract states of the frames") {
  for (std::int64_t frame = 0; frame < arrays().frames; frame += 7) {
    INFO(frame);
    const AbstractState state = abstract_state(stacked(), frame);
    CHECK(facts_in(arrays().column("facts"), static_cast<std::size_t>(frame)) == state.facts);
    CHECK(facts_in(arrays().column("known"), static_cast<std::size_t>(frame)) == state.observed);
  }
}

TEST_CASE("progress and applicable skills are what the stored problem says of the facts") {
  const Domain domain = domain_from_pddl(*document_of(stacked(), DocumentKind::pddl_domain), "domain");
  const Problem problem = problem_from_pddl(*document_of(stacked(), DocumentKind::pddl_problem), "problem", domain);
  const auto progress = arrays().column("progress").reals();
  const auto applicable = arrays().column("applicable").booleans();
  const std::size_t width = arrays().skills.size();
  REQUIRE(width > 1);
  for (std::size_t frame = 0; frame < progress.size(); frame += 5) {
    INFO(frame);
    const Facts facts = facts_in(arrays().column("facts"), frame);
    CHECK((progress[frame] == 1) == holds(problem.goal, facts, domain, problem.objects));
    for (std::size_t i = 0; i < width; ++i) {
      const Action* action = domain.action(arrays().skills[i].predicate);
      REQUIRE(action != nullptr);
      Binding binding;
      for (std::size_t k = 0; k < action->parameters.size(); ++k)
        binding[action->parameters[k].name] = arrays().skills[i].arguments[k];
      CHECK((applicable[frame * width + i] != 0) ==
            holds(action->precondition, facts, domain, problem.objects, binding));
    }
  }
  CHECK(progress.front() < 1);
  CHECK(progress.back() == 1);
}

TEST_CASE("ids of segments name what runs") {
  const auto skill = arrays().column("skill").integers();
  for (const ArraySegment& segment : arrays().segments) {
    if (segment.kind != "skill" || segment.first_frame == segment.end_frame) continue;
    CHECK(skill[static_cast<std::size_t>(segment.first_frame)] >= segment.id);
    CHECK(skill[static_cast<std::size_t>(segment.end_frame - 1)] >= segment.id);
  }
}

TEST_CASE("what an agent asked for is told frame by frame, a policy's before that of who called its skill") {
  EpisodeRecord acted = stacked();
  const double nan = std::nan("");
  acted.agent_actions = {{{.space = "joint_delta", .values = {1, 2, 3, 4, 5, 6, 7}, .gripper = 0.04}, 0, 1, -1, 0.25},
                         {{.space = "skill", .gripper = 0.01, .frames = 4, .skill = "pick"}, 1, 5, -1, 0.5},
                         {{.space = "tool_path", .values = {1, 2, 3, 0, 0, 0, 1}, .frame = "tool"}, 2, 7, 1, {}},
                         {{.space = "go_on", .frames = 3}, 5, 8, -1, 0.75},
                         {{.space = "tool_path", .values = {4, 5, 6, 0, 0, 0, 1}}, 8, 9, -1, 1},
                         {{.space = "flight", .values = {8, 9}}, 9, 10, -1, 1},
                         {{.space = "gripper", .values = {0.07}}, 10, 10, -1, 1},
                         {{.space = "gripper", .values = {0.08}}, 10, 12, -1, 1}};
  const EpisodeArrays told = episode_arrays(acted, {{"agent_action", "agent_reward"}});
  CHECK(told.agent_actions == acted.agent_actions);
  const auto begins = [](const auto& values, const auto& expected) {
    for (std::size_t i = 0; i < expected.size(); ++i) {
      INFO(i);
      CHECK((values[i] == expected[i] || (values[i] != values[i] && expected[i] != expected[i])));
    }
    CHECK((values.back() == -1 || values.back() != values.back()));
  };
  begins(told.column("agent_action").integers(), std::vector<std::int64_t>{0, 1, 2, 2, 2, 2, 2, 3, 4, 5, 7, 7, -1, -1});
  begins(told.column("agent_action/gripper").reals(),
         std::vector<double>{0.04, nan, nan, nan, nan, nan, nan, nan, nan, nan, 0.08, 0.08, nan});
  begins(told.column("agent_reward").reals(),
         std::vector<double>{0.25, nan, nan, nan, 0.5, nan, nan, 0.75, 1, 1, nan, 1, nan});
  const ArrayColumn &delta = told.column("agent_action/joint_delta"), &path = told.column("agent_action/tool_path"),
                    &flight = told.column("agent_action/flight");
  CHECK(delta.labels == arrays().column("joint_positions").labels);
  CHECK((delta.unit == "rad" && delta.frame.empty() && delta.rate_hz == told.frame_hz));
  begins(delta.reals(), std::vector<double>{1, 2, 3, 4, 5, 6, 7, nan});
  CHECK(path.labels == arrays().column("gripper_pose").labels);
  CHECK((path.unit == "m, 1" && path.frame == "world or tool"));
  CHECK(std::isnan(path.reals()[7]));
  for (const std::size_t frame : {2, 6}) CHECK(path.reals()[frame * 7 + 1] == 2);
  CHECK(std::isnan(path.reals()[7 * 7]));
  CHECK(path.reals()[8 * 7 + 1] == 5);
  CHECK(flight.shape == std::vector<std::int64_t>{told.frames, 2});  // of another engine: as it is
  CHECK((flight.labels.empty() && flight.unit.empty() && flight.reals()[9 * 2] == 8));
  CHECK(told.columns.size() == 6);
  CHECK_THROWS_WITH(episode_arrays(stacked(), {{"agent_action"}}), Catch::Contains("no column of that name"));
  for (const ArrayColumn& column : arrays().columns) CHECK_FALSE(column.name.starts_with("agent_"));
}

TEST_CASE("only what is asked for is made, and what is not there is told with what is meant") {
  const EpisodeArrays some = episode_arrays(stacked(), {{"joint_positions", "object_pose"}});
  for (const ArrayColumn& column : some.columns)
    CHECK((column.name == "joint_positions" || column.name.starts_with("object_pose/")));
  CHECK(some.columns.size() == 1 + stacked().scene.posed.size());
  CHECK_THROWS_WITH(episode_arrays(stacked(), {{"joint_position"}}), Catch::Contains("did you mean 'joint_positions'"));
  CHECK_THROWS_WITH(some.column("gripper_pose"), Catch::Contains("no such column"));
  CHECK_THROWS_WITH(some.columns.front().integers(), Catch::Contains("float64"));
  const ArrayNeeds needs = needs_of({{"joint_positions"}});
  CHECK(needs.joints);
  CHECK_FALSE((needs.objects || needs.hands || needs.facts || needs.actions || needs.cameras || needs.pictures));
}
