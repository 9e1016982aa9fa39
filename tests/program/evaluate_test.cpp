// How often tasks succeed: the command, the same from C++, and what is disturbed.
#include <atomic>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "db/catalogue.h"
#include "engine/record/record.h"
#include "scripting/session/evaluation.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using Words = std::vector<std::string>;

Said evaluated(const std::string& out, const Words& more) {
  Words words = {"evaluate", "--root", kRoot, "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return say(words);
}

SessionCore scripts(const std::string& catalogue = "") { return {STAMPEDE_SOURCE_DIR, {}, catalogue}; }

const EvaluationRow& row_of(const Evaluation& evaluation, const std::string& task, const std::string& perturbation) {
  return *std::find_if(evaluation.rows.begin(), evaluation.rows.end(), [&](const EvaluationRow& row) {
    return row.task == task && row.perturbation == perturbation && row.axis.empty();
  });
}

// Goes to the target as it is observed.
class Reach : public Policy {
 public:
  void begin(const PolicyCall& call) override { told = call; }
  std::optional<AgentAction> act(const EnvironmentObservation& now) override {
    const std::vector<double>&hand = now["gripper_pose"].reals(), &goal = now["object_pose/target"].reals();
    AgentAction action{.space = "tool_delta", .values = std::vector<double>(6)};
    for (std::size_t i = 0; i < 3; ++i) action.values[i] = std::clamp(0.5 * (goal[i] - hand[i]), -0.02, 0.02);
    return action;
  }
  PolicyCall told;
};

class Throws : public Policy {
 public:
  std::optional<AgentAction> act(const EnvironmentObservation&) override { throw std::runtime_error("out of ideas"); }
};

class Refused : public Policy {
 public:
  std::optional<AgentAction> act(const EnvironmentObservation&) override { return AgentAction{.space = "telepathy"}; }
};

class GivesUp : public Policy {
 public:
  std::optional<AgentAction> act(const EnvironmentObservation&) override { return std::nullopt; }
};

template <typename Kind>
EvaluationRequest by(std::int64_t episodes) {
  EvaluationRequest request;
  request.episodes = episodes;
  request.policy = [] { return std::make_unique<Kind>(); };
  request.settings.channels = {"gripper_pose", "object_pose"};
  request.settings.horizon_s = 20;
  return request;
}

}  // namespace

TEST_CASE("the parts of an evaluation are the whole, asked as one or merged") {
  const Folder folder;
  const Words more = {"reach_target", "push_buttons", "--episodes", "3", "--perturb", "start,layout", "--json"};
  const auto part = [&](const std::string& file, const std::string& shard) {
    Words words = more;
    if (!shard.empty()) words.insert(words.end(), {"--shard", shard});
    const Said said = evaluated(folder / file, words);
    INFO(said.err);
    REQUIRE(said.code == kDone);
    std::int64_t episodes = 0;
    const auto answer = nlohmann::json::parse(said.out);
    for (const auto& row : answer["rows"])
      if (row["axis"] == "" && row["task"] != "") episodes += row["episodes"].get<std::int64_t>();
    return episodes;
  };
  CHECK(part("whole.db", "") == 18);
  std::filesystem::create_directories(folder / "parts");
  CHECK(part("parts/1.db", "1/4") == 6);
  CHECK(part("parts/2.db", "2/4") == 6);
  CHECK(part("parts/3.db", "3/4") + part("parts/4.db", "4/4") == 6);
  const auto asked = [&](const std::string& of) {
    return say({"query", folder / of, "success_by_perturbation", "--format", "csv"}).out;
  };
  REQUIRE(say({"index", folder / "parts"}).code == kDone);
  CHECK(asked("parts") == asked("whole.db"));
  CHECK(says(asked("whole.db"), "reach_target,test,planner,layout=1,3,"));
  REQUIRE(say({"merge", folder / "all.db", folder / "parts/1.db", folder / "parts/2.db", folder / "parts/3.db",
               folder / "parts/4.db"})
              .code == kDone);
  CHECK(Catalogue::open(folder / "all.db").content_hash() == Catalogue::open(folder / "whole.db").content_hash());
  CHECK(evaluated(folder / "none.db", {"reach_target", "--shard", "5/4"}).code == kUsage);
  auto core = std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
  CHECK(row_of(core->evaluate({"reach_target"}, {.episodes = 5, .shard = {2, 2}}), "reach_target", "none").episodes ==
        2);
  CHECK_THROWS_WITH(core->evaluate({"reach_target"}, {.episodes = 5, .shard = {3, 2}}),
                    Catch::Contains("EvaluationRequest::shard"));
}

TEST_CASE("Wilson's interval is that of the textbook, and of nothing anything") {
  const auto [lower, upper] = wilson_interval(8, 10);
  CHECK(lower == Approx(0.4902).margin(1e-4));  // Newcombe, Statistics in Medicine 1998, method 3
  CHECK(upper == Approx(0.9433).margin(1e-4));
  CHECK(wilson_interval(10, 10).second == 1);
  CHECK(wilson_interval(10, 10).first == Approx(0.7225).margin(1e-4));
  CHECK(wilson_interval(0, 10).first == 0);
  CHECK(wilson_interval(0, 0) == std::pair(0.0, 1.0));
}

TEST_CASE("evaluate tells success per task, axis value and perturbation, and stores each episode") {
  const Folder folder;
  const std::string out = folder / "e.db";
  const Said said = evaluated(out, {"reach_target", "push_buttons", "--episodes", "2", "--perturb", "all", "--json"});
  CHECK(said.err.empty() == false);  // the progress
  REQUIRE(said.code == kDone);
  const nlohmann::json answer = nlohmann::json::parse(said.out);
  std::set<std::string> perturbations;
  for (const nlohmann::json& row : answer["rows"]) {
    perturbations.insert(row["perturbation"]);
    if (row["axis"] != "") continue;
    CHECK(row["episodes"] == (row["task"] == "" ? 4 : 2));
    CHECK(row["success"] == 1.0);
    CHECK(row["mean_return"] == 1.0);
    CHECK(row["lower"] < 1.0);
  }
  CHECK(perturbations == std::set<std::string>{"none", "layout=1", "camera=1", "start=1", "sentence=1", "light=1",
                                               "texture=1", "noise=1"});
  Catalogue catalogue = Catalogue::open(out);
  const Rows counts = catalogue.query(
      "SELECT coalesce(options->>'perturb', 'none') p, count(*) n, min(split) split FROM episodes GROUP BY p");
  CHECK(counts.size() == 8);
  for (std::size_t i = 0; i < counts.size(); ++i) {
    CHECK(counts.integer(i, "n") == 4);
    CHECK(counts.text(i, "split") == "test");
  }
  // What the layout adds is beside what was there; all else starts as it did.
  const Rows things = catalogue.query(
      "SELECT e.seed, x.object AS name, coalesce(e.options->>'perturb', 'none') p, round(x.x, 6) x, round(x.y, 6) y "
      "FROM "
      "episodes e "
      "JOIN poses x ON x.episode = e.episode AND x.frame = 0 WHERE e.task = 'push_buttons' AND p IN ('none', "
      "'layout=1') "
      "ORDER BY 1, 2, 3");
  int further = 0;
  std::map<std::string, std::pair<double, double>> undisturbed;
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::string name = std::to_string(things.integer(i, "seed")) + things.text(i, "name");
    if (things.text(i, "p") == "none") undisturbed[name] = {things.real(i, "x"), things.real(i, "y")};
  }
  for (std::size_t i = 0; i < things.size(); ++i) {
    const std::string name = std::to_string(things.integer(i, "seed")) + things.text(i, "name");
    if (things.text(i, "p") == "none") continue;
    if (things.text(i, "name").starts_with("clutter"))
      ++further;
    else if (!things.text(i, "name").starts_with("panda"))
      CHECK(undisturbed.at(name) == std::pair{things.real(i, "x"), things.real(i, "y")});
  }
  CHECK(further == 6);
  for (const EpisodeSummary& one : catalogue.episodes()) CHECK(replay_episode(catalogue.read_episode(one.id)).empty());
}

TEST_CASE("evaluate prints one table of success and one of robustness") {
  const Folder folder;
  const Said said = evaluated(folder / "e.db", {"reach_target", "--episodes", "1", "--perturb", "light=2,noise"});
  REQUIRE(said.code == kDone);
  CHECK(says(said.out, "95 % interval"));
  CHECK(says(said.out, "colour="));
  CHECK(says(said.out, "success %     none            light=2         noise=1"));
  CHECK(says(said.out, "reach_target  100.0 (21-100)  100.0 (21-100)  100.0 (21-100)"));
}

TEST_CASE("evaluate refuses what is no axis, no strength, no task") {
  const Folder folder;
  const std::string out = folder / "e.db";
  const auto fails = [&](const Words& words, ExitCode code, const std::string& part) {
    const Said said = evaluated(out, words);
    CHECK(said.code == code);
    CHECK_THAT(said.err, Catch::Contains(part));
  };
  fails({"reach_target", "--perturb", "lighting"}, kUsage, "light");
  fails({"reach_target", "--perturb", "light=0"}, kUsage, "no strength");
  fails({"reach_target", "--seed", "3"}, kUsage, "1000000");
  fails({"reach_the_target"}, kBadInput, "reach_target");
  fails({"reach_target", "--observe", "gripper_pose"}, kUsage, "--policy");
  CHECK_FALSE(std::filesystem::exists(out));
}

TEST_CASE("a program is evaluated like the planner") {
  const Folder folder;
  const std::string idle =
      "while read -r line; do case $line in *'\"terminated\":true'*|*'\"truncated\":true'*) ;; *) echo "
      "'{\"end\":true}';; "
      "esac; done";
  const Said said =
      evaluated(folder / "e.db", {"reach_target", "--episodes", "3", "--perturb", "noise", "--policy", idle, "--json"});
  REQUIRE(said.code == kDone);
  const nlohmann::json answer = nlohmann::json::parse(said.out);
  CHECK(answer["rows"].size() == 8);
  for (const nlohmann::json& row : answer["rows"]) {
    CHECK(row["succeeded"] == 0);
    CHECK(row["reasons"]["goal_false"] == row["episodes"]);
    CHECK(row["mean_return"] == 0.0);
  }
}

TEST_CASE("a policy in C++ is evaluated, the same by any number of workers") {
  SessionCore session = scripts();
  EvaluationRequest request = by<Reach>(4);
  request.perturb = {"start", "noise=2"};
  const Evaluation one = session.evaluate({"reach_target"}, request);
  CHECK(row_of(one, "reach_target", "none").success == 1);
  CHECK(row_of(one, "reach_target", "start=1").episodes == 4);
  CHECK_FALSE(one.interrupted);
  request.workers = 3;
  const Evaluation three = session.evaluate({"reach_target"}, request);
  REQUIRE(one.rows.size() == three.rows.size());
  for (std::size_t i = 0; i < one.rows.size(); ++i) {
    CHECK(one.rows[i].mean_length_s == three.rows[i].mean_length_s);
    CHECK(one.rows[i].succeeded == three.rows[i].succeeded);
    CHECK(one.rows[i].value == three.rows[i].value);
  }
}

TEST_CASE("a policy is told the task and one of its sentences, disturbed where that was asked for") {
  static std::vector<std::string> heard;
  class Listens : public GivesUp {
   public:
    void begin(const PolicyCall& call) override { heard.push_back(call.task + ": " + call.instruction); }
  };
  heard.clear();
  EvaluationRequest request = by<Listens>(1);
  request.perturb = {"sentence"};
  scripts().evaluate({"reach_target"}, request);
  REQUIRE(heard.size() == 2);
  CHECK(heard[0].starts_with("reach_target: "));
  CHECK(heard[0].size() > 25);
  CHECK(heard[1] != heard[0]);
}

TEST_CASE("what a policy throws, and what leads nowhere, fails its own episode and no other") {
  const Folder folder;
  const std::string out = folder / "e.db";
  SessionCore session = scripts(out);
  const Evaluation thrown = session.evaluate({"reach_target"}, by<Throws>(2));
  CHECK(row_of(thrown, "reach_target", "none").reasons == std::map<std::string, std::int64_t>{{"policy_error", 2}});
  const Evaluation refused = session.evaluate({"reach_target"}, by<Refused>(1));
  CHECK(row_of(refused, "reach_target", "none").reasons == std::map<std::string, std::int64_t>{{"policy_error", 1}});
  const Rows rows = session.query("SELECT reason, detail FROM episodes ORDER BY episode");
  CHECK(rows.text(0, "reason") == "policy_error");
  CHECK_THAT(rows.text(0, "detail"), Catch::Contains("out of ideas"));
  CHECK_THAT(scripts().evaluate({"reach_target"}, by<GivesUp>(1)).rows.front().reasons.begin()->first,
             Catch::Equals("goal_false"));
}

TEST_CASE("an evaluation that is stopped tells what had ended") {
  std::atomic<bool> stop = true;
  EvaluationRequest request = by<GivesUp>(3);
  request.stop = &stop;
  const Evaluation evaluation = scripts().evaluate({"reach_target"}, request);
  CHECK(evaluation.interrupted);
  CHECK(evaluation.rows.empty());
}

TEST_CASE("an environment can be reset into what is disturbed") {
  const auto core = std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, "");
  Environment world = core->environment("push_buttons", {.channels = {"object_pose", "joint_positions"}});
  const auto usual = world.reset({.seed = 5});
  const auto moved = world.reset({.seed = 5, .perturb = "start"});
  CHECK(usual["joint_positions"].reals() != moved["joint_positions"].reals());
  const auto more = world.reset({.seed = 5, .perturb = "layout=0.3"});
  CHECK_NOTHROW(more["object_pose/clutter1"]);
  CHECK(usual["joint_positions"].reals() == more["joint_positions"].reals());
  CHECK_THROWS_WITH(world.reset({.seed = 5, .perturb = "layuot"}), Catch::Contains("layout"));
}

}  // namespace stampede::program
