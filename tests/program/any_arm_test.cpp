// Arms that are not a Panda, from their episodes to scores: a crane of four joints and an arm of six axes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "db/catalogue.h"
#include "db/plain_file.h"
#include "db/research/baseline.h"
#include "db/research/dataset.h"
#include "tests/program/say.h"
#include "tests/support/crane.h"

namespace stampede::program {
namespace {

using research::all_problems;
using research::ResearchProblem;

const char* const kCrane = R"(-- It turns at its foot, and bends at shoulder, elbow and wrist.
return robot {
  urdf = "crane.urdf",
  arm = { "turn", "shoulder", "elbow", "wrist" },
  fingers = { "left_slide", "right_slide" },
  pads = { "left", "right" },
  tip = { link = "palm", at = { 0.08, 0, 0 } },
  home = { 0, -0.6, 0.9, 0 },
  limits = { acceleration = 10, jerk = 5000 },
  opening = 0.06, grip_force = 20,
}
)";

const char* const kSwing = R"(-- Turn to the mark by the joints: four cannot choose how the hand stands.
return skill {
  params = { "place: target" },
  precondition = { is_not.at("place") },
  effect = { is.at("place"), forall("?other: target", when(is_not(equal("?other", "place")), is_not.at("?other"))) },
  label = "swing to the {place}",
  run = function(robot, p)
    local x, y = robot:view():pose(p.place):position()
    robot:move_joints { math.atan(y, x + 0.3), -0.6, 0.9, 0 }
  end,
}
)";

const char* const kYard = R"(-- The crane on a table.
return world {
  robot = { "crane", at = { -0.30, 0, 0.75 }, joints = { turn = between(-1.5, -0.5), elbow = between(0.3, 1.2) } },
  fixtures = { table = { "work_table", at = { 0.19, 0, 0.75 } } },
}
)";

const char* const kHoist = R"(-- Bring the tip of the crane to the far mark, then to the near one.
return task {
  world = "yard",
  objects = {
    mark = { "floating_target", at = { 0.1939, 0.2698, 1.2219 } },
    far_mark = { "floating_target", at = { 0.2628, 0, 1.2219 } },
  },
  init = { is.hand_empty() },
  steps = { act.swing("far_mark"), act.swing("mark") },
  goal = is.at("mark"),
  hold = 0.2, -- s
  instructions = { "go to the mark" },
}
)";

const char* const kCell = R"(-- A table with an arm of six axes.
return world {
  robot = { "six_axis", at = { -0.30, 0, 0.75 } },
  fixtures = { table = { "work_table", at = { 0.19, 0, 0.75 } } },
}
)";

const char* const kTake = R"(-- Take the cube.
return task {
  world = "cell",
  objects = { item = { "cube" } },
  init = { is.on("item", "table") },
  goal = is.lifted("item"),
  instructions = { "take the cube" },
}
)";

struct OwnArm {
  std::string file, robot;  // catalogue, name
  int joints;
};
const std::vector<OwnArm>& own_arms() {
  static const std::vector<OwnArm> arms = {{"crane.db", "crane", 4}, {"six_axis.db", "six_axis", 6}};
  return arms;
}

// Episodes of both, made once: each in a catalogue of its own, and all in one.
class MadeByArms {
 public:
  MadeByArms() {
    put(folder_, "my/worlds/robots/crane.urdf", test::kCraneUrdf);
    put(folder_, "my/worlds/robots/crane.lua", kCrane);
    put(folder_, "my/worlds/yard.lua", kYard), put(folder_, "my/worlds/cell.lua", kCell);
    put(folder_, "my/skills/swing.lua", kSwing);
    put(folder_, "my/tasks/hoist.lua", kHoist), put(folder_, "my/tasks/take_it.lua", kTake);
    done({"new", "robot", "six_axis", "--root", kRoot, "--path", path("my")});
    for (const std::string file : {"crane.db", "both.db"}) run("hoist", file);
    for (const std::string file : {"six_axis.db", "both.db"}) run("take_it", file);
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  static Said done(const std::vector<std::string>& words) {
    Said said = say(words);
    INFO(said.out << said.err);
    REQUIRE(said.code == kDone);
    return said;
  }
  // Folder of a data set, with `given` and `hidden` in it.
  std::string dataset(const std::string& problem, const std::string& file,
                      const std::vector<std::string>& more = {}) const {
    const std::string to = path(problem + "_" + file + (more.empty() ? "" : "_some"));
    std::vector<std::string> words = {"dataset",     problem,    path(file),    "--out",
                                      to + "/given", "--hidden", to + "/hidden"};
    words.insert(words.end(), more.begin(), more.end());
    done(words);
    return to;
  }

 private:
  void run(const std::string& task, const std::string& file) const {
    const Said said =
        done({"run", task, "--episodes", "6", "--root", kRoot, "--path", path("my"), "--out", path(file)});
    REQUIRE(says(said.out, "6 episodes, 6 succeeded"));
  }
  Folder folder_;
};

const MadeByArms& made_by_arms() {
  static const MadeByArms files;
  return files;
}

std::vector<std::string> columns_of(const PlainFile& file, const std::string& table) {
  return file.query("SELECT * FROM " + table + " LIMIT 0").columns;
}

std::int64_t count_in(const PlainFile& file, const std::string& rows) {
  return file.query("SELECT count(*) AS n FROM " + rows).integer(0, "n");
}

// Answers to behaviour or transfer that are the truth, as CSV; NULL is an empty cell.
std::string true_answers(const PlainFile& hidden, int joints) {
  std::string header = "episode,frame", select = "SELECT episode, frame";
  for (int j = 1; j <= joints; ++j) header += ",j" + std::to_string(j), select += ", action_j" + std::to_string(j);
  std::string text = "# dataset: " + research::dataset_id(hidden) + "\n" + header + ",gripper\n";
  const Rows rows = hidden.query(select + ", action_gripper FROM actions ORDER BY episode, frame");
  for (const std::vector<SqlValue>& row : rows.rows) {
    std::string line;
    for (const SqlValue& value : row) {
      if (!line.empty()) line += ",";
      if (const auto* integer = std::get_if<std::int64_t>(&value)) line += std::to_string(*integer);
      if (const auto* real = std::get_if<double>(&value)) line += nlohmann::json(*real).dump();
    }
    text += line + "\n";
  }
  return text;
}

double figure_of(const Said& scored, const std::string& name) {
  const auto json = nlohmann::json::parse(scored.out);
  for (const auto& figure : json["figures"])
    if (figure["name"] == name) return figure["value"].get<double>();
  FAIL("there is no figure " + name);
  return 0;
}

}  // namespace

// One test case: each is a program of its own, and what is made would be made again.
TEST_CASE("arms of four and six joints go all the way from episodes to scores") {
  const MadeByArms& made = made_by_arms();
  SECTION("steps and joints say what arrays say, by the robot that is stored with the episode") {
    for (const OwnArm& arm : own_arms()) {
      INFO(arm.robot);
      const Catalogue catalogue = Catalogue::open(made.path(arm.file));
      const Rows steps = catalogue.query("SELECT * FROM steps WHERE episode = 1 ORDER BY frame");
      const EpisodeArrays arrays =
          catalogue.read_arrays(1, {.columns = {"joint_positions", "action/joint_position", "action/tool_pose"}});
      const ArrayColumn& positions = arrays.column("joint_positions");
      const auto measured = positions.reals(), commanded = arrays.column("action/joint_position").reals(),
                 tool = arrays.column("action/tool_pose").reals();
      const auto width = static_cast<std::size_t>(arm.joints);
      REQUIRE(positions.shape == std::vector<std::int64_t>{static_cast<std::int64_t>(steps.size()), arm.joints});
      for (std::size_t i = 0; i < steps.size(); ++i)
        for (std::size_t j = 0; j < 7; ++j) {
          const std::string name = "j" + std::to_string(j + 1);
          const bool last = i + 1 == steps.size();
          REQUIRE(steps.is_null(i, name) == (j >= width));
          REQUIRE(steps.is_null(i, "action_" + name) == (j >= width || last));
          if (j < width) REQUIRE(steps.real(i, name) == measured[i * width + j]);
          if (j < width && !last) REQUIRE(steps.real(i, "action_" + name) == commanded[i * width + j]);
          if (!last) REQUIRE(steps.real(i, "action_x") == tool[i * 7]);
          if (!last) REQUIRE(steps.real(i, "action_qw") == tool[i * 7 + 6]);
        }
      const Rows names =
          catalogue.query("SELECT joint FROM joints WHERE episode = 1 AND frame = 0 AND arm_joint ORDER BY arm_joint");
      REQUIRE(names.size() == width);
      for (std::size_t j = 0; j < width; ++j) CHECK(names.text(j, "joint") == positions.labels[j]);
    }
  }
  SECTION("every problem has a data set, and every baseline answers it and is scored") {
    for (const OwnArm& arm : own_arms())
      for (const ResearchProblem& problem : all_problems()) {
        const std::string to = made.dataset(problem.name, arm.file);
        for (const research::Baseline& baseline : research::all_baselines()) {
          if (std::ranges::find(baseline.problems, problem.name) == baseline.problems.end()) continue;
          if (arm.robot == "crane" && baseline.name == "thresholds") continue;  // nothing but the arm moves there
          INFO(arm.robot << " " << problem.name << " " << baseline.name);
          made.done({"baseline", baseline.name, to + "/given", "--out", to + "/" + baseline.name});
          const Said scored =
              made.done({"score", problem.name, to + "/" + baseline.name, "--hidden", to + "/hidden", "--json"});
          CHECK_FALSE(nlohmann::json::parse(scored.out)["figures"].empty());
        }
      }
  }
  SECTION("a data set has a column for each joint of its arm, and says which joint is which") {
    for (const OwnArm& arm : own_arms()) {
      INFO(arm.robot);
      const std::string to = made.dataset("behaviour", arm.file);
      const PlainFile given = PlainFile::open(to + "/given/given.db"),
                      hidden = PlainFile::open(to + "/hidden/hidden.db");
      const std::string last = "j" + std::to_string(arm.joints), more = "j" + std::to_string(arm.joints + 1);
      for (const PlainFile* file : {&given, &hidden}) {
        const std::vector<std::string> columns = columns_of(*file, "actions");
        CHECK(std::ranges::find(columns, "action_" + last) != columns.end());
        CHECK(std::ranges::find(columns, "action_" + more) == columns.end());
        CHECK(count_in(*file, "actions WHERE action_j1 IS NOT NULL AND action_" + last + " IS NULL") == 0);
      }
      // What is commanded is nearly where the joint of that number is in the next frame.
      for (int j = 1; j <= arm.joints; ++j) {
        const std::string n = std::to_string(j);
        CHECK(count_in(given,
                       "actions a JOIN joints j ON j.episode = a.episode AND j.frame = a.frame + 1 AND j.arm_joint = " +
                           n + " WHERE abs(a.action_j" + n + " - j.position) > 0.1") == 0);
      }
      const std::string page = file_text(to + "/given/README.md");
      CHECK(says(page, "| `" + last + "` | real |"));
      CHECK_FALSE(says(page, "`" + more + "`"));
      CHECK(says(file_text(to + "/given/answers.example.json"), "\"" + last + "\""));
    }
  }
  SECTION("the truth scores without error, and answers of another arm are refused") {
    for (const OwnArm& arm : own_arms()) {
      INFO(arm.robot);
      const std::string to = made.dataset("transfer", arm.file), answers = to + "/answers.csv";
      const PlainFile hidden = PlainFile::open(to + "/hidden/hidden.db");
      const auto scored = [&](const std::string& text) {
        std::ofstream(answers, std::ios::binary) << text;
        return say({"score", "transfer", answers, "--hidden", to + "/hidden", "--json"});
      };
      const Said truth = scored(true_answers(hidden, arm.joints));
      INFO(truth.err);
      REQUIRE(truth.code == kDone);
      CHECK(figure_of(truth, "joint_rmse") == 0);
      CHECK(figure_of(truth, "gripper_right") == 1);
      const Said less = scored(true_answers(hidden, arm.joints - 1));
      CHECK(less.code == kBadInput);
      CHECK(says(less.err, "the column 'j" + std::to_string(arm.joints) + "' is missing"));
      std::string wide = true_answers(hidden, arm.joints);
      wide.replace(wide.find(",gripper"), 8, ",j7");
      const Said more = scored(wide);
      CHECK(more.code == kBadInput);
      CHECK(says(more.err, "there is no column 'j7'"));
    }
  }
  SECTION("two robots in one data set: smaller arms hold NULL, each is scored by its own joints") {
    const std::string to = made.dataset("transfer", "both.db"), answers = to + "/answers.csv";
    const PlainFile given = PlainFile::open(to + "/given/given.db"), hidden = PlainFile::open(to + "/hidden/hidden.db");
    CHECK(count_in(given, "actions WHERE action_j6 IS NOT NULL") > 0);
    CHECK(count_in(given, "actions WHERE action_j4 IS NOT NULL AND action_j5 IS NULL AND action_j6 IS NULL") > 0);
    const auto scored = [&](const std::string& text) {
      std::ofstream(answers, std::ios::binary) << text;
      return say({"score", "transfer", answers, "--hidden", to + "/hidden", "--json"});
    };
    const Said truth = scored(true_answers(hidden, 6));
    INFO(truth.err);
    REQUIRE(truth.code == kDone);
    CHECK(figure_of(truth, "joint_rmse") == 0);
    const Said less = scored(true_answers(hidden, 4));
    CHECK(less.code == kBadInput);
    CHECK(says(less.err, "'j5' is missing"));
    CHECK(says(less.err, "arm_joint"));
    made.done({"baseline", "stay", to + "/given", "--out", to + "/stay.json"});
    made.done({"score", "transfer", to + "/stay.json", "--hidden", to + "/hidden"});
    for (const std::string learner : {"nearest", "linear"}) {
      const Said refused = say({"baseline", learner, to + "/given", "--out", to + "/" + learner + ".json"});
      INFO(refused.err);
      CHECK(refused.code == kBadInput);
      CHECK(says(refused.err, "different numbers of joints"));
      CHECK(says(refused.err, "--where"));
    }
  }
  SECTION("--where takes the episodes of one of them") {
    const std::string to = made.dataset("transfer", "both.db", {"--where", "world = 'yard'"});
    const PlainFile given = PlainFile::open(to + "/given/given.db");
    CHECK(count_in(given, "episodes") == 6);
    const std::vector<std::string> columns = columns_of(given, "actions");
    CHECK(std::ranges::find(columns, "action_j4") != columns.end());
    CHECK(std::ranges::find(columns, "action_j5") == columns.end());
    CHECK(says(file_text(to + "/hidden/README.md"), "those where `world = 'yard'`"));
    made.done({"baseline", "linear", to + "/given", "--out", to + "/linear.json"});
    const auto refused = [&](const std::string& where, const std::string& why) {
      const Said said =
          say({"dataset", "transfer", made.path("both.db"), "--out", made.path("none"), "--where", where});
      INFO(said.err);
      CHECK(said.code == kBadInput);
      CHECK(says(said.err, why));
    };
    refused("world = 'moon'", "of those where world = 'moon'");
    refused("wrold = 'yard'", "wrold");
  }
}

}  // namespace stampede::program
