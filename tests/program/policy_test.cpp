// A program of one's own that acts: the examples of POLICIES.md, and programs that do not keep to the protocol.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

#include "db/catalogue.h"
#include "scripting/session/policy_json.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using Words = std::vector<std::string>;

const std::string kTurn = R"({"space":"joint_velocity","values":[0.1,0,0,0,0,0,0],"gripper":0.02})";

Said acted(const std::string& policy, const std::string& out, const Words& more = {}) {
  Words words = {"run", "reach_target", "--root", kRoot, "--seed", "3", "--policy", policy, "--out", out};
  words.insert(words.end(), more.begin(), more.end());
  return say(words);
}

// What stands in the page between ```LANGUAGE and ```, of the first block in which `part` occurs.
std::string example(const std::string& language, const std::string& part) {
  const std::string page = file_text(STAMPEDE_SOURCE_DIR "/scripting/session/POLICIES.md");
  const std::string fence = "```" + language + "\n";
  for (std::size_t at = page.find(fence); at != std::string::npos; at = page.find(fence, at + 1)) {
    const std::size_t begin = at + fence.size();
    const std::string text = page.substr(begin, page.find("```\n", begin) - begin);
    if (says(text, part)) return text;
  }
  return {};
}

// Answers every line but the last of an episode with one text.
std::string always(const std::string& answer) {
  return "while read -r line; do case $line in *'\"terminated\":true'*|*'\"truncated\":true'*) ;; *) echo '" + answer +
         "';; esac; done";
}

// Ended processes whose parent does not look after them stay in the list.
bool runs(const std::string& process) {
  const std::string stat = file_text("/proc/" + std::to_string(std::stoi(process)) + "/stat");
  return !stat.empty() && !says(stat, ") Z ");
}

std::int64_t episodes_in(const std::string& file) {
  return static_cast<std::int64_t>(Catalogue::open(file).episodes().size());
}

std::vector<nlohmann::json> messages_in(const std::string& file) {
  std::vector<nlohmann::json> messages;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) messages.push_back(nlohmann::json::parse(line));
  return messages;
}

}  // namespace

TEST_CASE("the shell example plays a skill, succeeds, and its episodes replay") {
  const Folder folder;
  put(folder, "policy.sh", example("sh", "while read"));
  const Said run = acted("sh " + (folder / "policy.sh"), folder / "o.db", {"--episodes", "2"});
  INFO(run.err);
  REQUIRE(run.code == kDone);
  CHECK(says(run.out, "2 episodes, 2 succeeded"));
  CHECK(say({"replay", folder / "o.db"}).code == kDone);
  const Said asked = say({"query", folder / "o.db",
                          "SELECT outcome, options ->> 'behaviour', options ->> 'policy' LIKE 'sh %' FROM episodes",
                          "--format", "csv"});
  INFO(asked.err);
  CHECK(says(asked.out, "success,agent,1"));
  const Said actions = say({"query", folder / "o.db",
                            "SELECT space, skill, arguments, reward, terminated FROM "
                            "agent_actions WHERE episode = 1",
                            "--format", "csv"});
  CHECK(actions.out ==
        "space,skill,arguments,reward,terminated\n"
        "skill,reach,\"[\"\"target\"\",\"\"panda.hand\"\"]\",0.0,0\nhold,,[],1.0,1\n");
  const Said again = acted("sh " + (folder / "policy.sh"), folder / "o.db", {"--episodes", "2"});
  CHECK(says(again.out, "2 were there already"));
  CHECK(episodes_in(folder / "o.db") == 2);
}

TEST_CASE("the example in Python brings the hand to the target") {
  if (std::system("python3 -c '' >/dev/null 2>&1") != 0) return;
  const Folder folder;
  put(folder, "policy.py", example("python", "import json"));
  const Said run = acted("python3 " + (folder / "policy.py"), folder / "o.db",
                         {"--episodes", "2", "--observe", "gripper_pose,object_pose"});
  INFO(run.err << Catalogue::open(folder / "o.db").episodes().size());
  REQUIRE(run.code == kDone);
  CHECK(says(run.out, "2 episodes, 2 succeeded"));
  CHECK(say({"replay", folder / "o.db"}).code == kDone);
}

TEST_CASE("the example in SQL gives observation, action and reward of each frame") {
  const Folder folder;
  const std::string policy =
      "for i in 1 2 3; do read -r line; echo '" + kTurn + "'; done; read -r line; echo '{\"end\":true}'; cat";
  REQUIRE(acted(policy, folder / "o.db").code == kNo);
  const std::string question = example("sql", "agent_actions");
  const Rows rows = Catalogue::open(folder / "o.db").query(question);
  REQUIRE(rows.size() == 3);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    CHECK(rows.integer(i, "frame") == static_cast<std::int64_t>(i));
    CHECK(rows.text(i, "space") == "joint_velocity");
    CHECK(rows.text(i, "numbers") == "[0.1,0,0,0,0,0,0]");
    CHECK(rows.real(i, "reward") == 0);
    CHECK(rows.real(i, "j4") < 0);
    CHECK(rows.integer(i, "terminated") == 0);
  }
}

TEST_CASE("a reset says what there is to do and to see, a step what came of it") {
  const Folder folder;
  const std::string log = folder / "log";
  const std::string policy = "tee " + log + " | { for i in 1 2 3; do read -r line; echo '" + kTurn +
                             "'; done; read -r line; echo '{\"end\":true}'; cat; }";
  const Said run = acted(policy, folder / "o.db",
                         {"--observe", "joint_positions,facts,fact_names,applicable,front_rgb,front_depth,object_pose",
                          "--size", "32x24"});
  INFO(run.err);
  REQUIRE(run.code == kNo);
  CHECK(says(run.out, "1 goal_false"));
  const auto messages = messages_in(log);
  REQUIRE(messages.size() == 4);
  const auto& reset = messages.front();
  CHECK(reset.at("type") == "reset");
  CHECK(reset.at("task") == "reach_target");
  CHECK(reset.at("seed") == 3);
  CHECK_FALSE(reset.at("instructions").empty());
  CHECK(reset.at("spaces").at(0).at("name") == "joint_position");
  CHECK(reset.at("spaces").at(0).at("components").size() == 7);
  CHECK(reset.at("spaces").at(0).at("components").at(0).at("unit") == "rad");
  CHECK(reset.at("observation").at("facts").size() == reset.at("atoms").size());
  CHECK(reset.at("observation").at("applicable").size() == reset.at("ground_skills").size());
  CHECK(reset.at("observation").at("object_pose/target").size() == 7);
  std::map<std::string, nlohmann::json> channels;
  for (const auto& one : reset.at("channels")) channels[one.at("name")] = one;
  CHECK(channels.at("front_rgb").at("shape") == nlohmann::json({24, 32, 3}));
  CHECK(channels.at("front_rgb").at("type") == "uint8");
  CHECK(channels.at("front_depth").at("type") == "float32");
  const std::string picture = reset.at("observation").at("front_rgb");
  CHECK(picture.ends_with("/front_rgb.raw"));
  CHECK_FALSE(std::filesystem::exists(std::filesystem::path(picture).parent_path()));  // gone with the run
  const auto& step = messages.at(1);
  CHECK(step.at("type") == "step");
  CHECK(step.at("frames") == 1);
  CHECK(step.at("frame") == 1);
  CHECK(step.at("refusal").is_null());
  CHECK(step.at("observation").at("joint_positions") != reset.at("observation").at("joint_positions"));
  CHECK(say({"replay", folder / "o.db"}).code == kDone);
}

TEST_CASE("a policy that never gets there is ended by the horizon, and told so") {
  const Folder folder;
  const std::string log = folder / "log";
  const Said run = acted("tee " + log + " | { " + always(kTurn) + "; }", folder / "o.db");
  INFO(run.err);
  CHECK(run.code == kNo);
  CHECK(says(run.out, "1 timeout"));
  const auto messages = messages_in(log);
  REQUIRE(messages.size() > 10);
  CHECK(messages.back().at("truncated") == true);
  CHECK(messages.back().at("reason") == "timeout");
}

TEST_CASE("pictures are read while the program acts: raw numbers of the size that the reset says") {
  const Folder folder;
  const std::string size = folder / "size";
  const std::string policy = "read -r line; path=${line##*'\"front_depth\":\"'}; wc -c <\"${path%%'\"'*}\" >" + size +
                             "; echo '{\"end\":true}'";
  const Said run = acted(policy, folder / "o.db", {"--observe", "front_depth", "--size", "32x24"});
  INFO(run.err);
  CHECK(run.code == kNo);
  CHECK(says(run.out, "1 goal_false"));
  CHECK(std::stoi(file_text(size)) == 32 * 24 * 4);
}

TEST_CASE("a policy is told the reward that was asked for") {
  const Folder folder;
  const std::string log = folder / "log";
  const std::string reach = R"({"space":"skill","skill":"reach","arguments":["target","panda.hand"]})";
  const std::string policy =
      "tee " + log + " | { read -r line; echo '" + reach + "'; read -r line; echo '{\"space\":\"hold\"}'; cat; }";
  REQUIRE(acted(policy, folder / "o.db", {"--reward", "dense"}).code == kDone);
  auto messages = messages_in(log);
  REQUIRE(messages.size() >= 2);
  CHECK(messages[1].at("reward").get<double>() > 0.5);  // there, but not held for long enough
  CHECK(messages.back().at("reward") == 1.0);
  std::filesystem::remove(log);
  REQUIRE(acted(policy, folder / "o.db").code == kDone);
  messages = messages_in(log);
  CHECK(messages[1].at("reward") == (messages.size() == 2 ? 1.0 : 0.0));
}

TEST_CASE("a policy ends its episodes when it likes, and a refused action changes nothing") {
  const Folder folder;
  const std::string log = folder / "log";
  const std::string policy =
      "i=0; while read -r line; do i=$((i+1)); echo \"$line\" >>" + log +
      "; case $i in 1|3) echo '{\"space\":\"joint_delta\",\"values\":[9,0,0,0,0,0,0]}';; *) echo "
      "'{\"end\":true}';; esac; done";
  const Said run = acted(policy, folder / "o.db", {"--episodes", "2"});
  INFO(run.err);
  CHECK(run.code == kNo);
  CHECK(episodes_in(folder / "o.db") == 2);
  const auto messages = messages_in(log);
  REQUIRE(messages.size() == 4);
  CHECK(says(messages[1].at("refusal").at("what"), "out of its bounds"));
  CHECK(messages[1].at("frames") == 0);
  CHECK(messages[1].at("observation") == messages[0].at("observation"));
  CHECK(messages[2].at("type") == "reset");
  CHECK(messages[2].at("seed") != messages[0].at("seed"));
}

TEST_CASE("programs that do not keep to the protocol end the run, with what was awaited and the cure") {
  struct Case {
    std::string policy;
    Words told;
  };
  const std::string first = "the first action of reach_target seed 3";
  const std::vector<Case> cases = {
      {"/no/such/program", {"could not be started: the shell ended with code 127", "check its path"}},
      {"read -r line; exit 4", {"ended with code 4 where " + first + " was awaited"}},
      {"read -r line; kill -9 $$", {"was killed by signal 9"}},
      {"read -r line; printf '{\"end\"'", {"its last line has no end: \"{\\\"end\\\"\""}},
      {always("hello"),
       {"line 1 of the program, \"hello\": this is no JSON from here on: hello", first, "joint_delta"}},
      {always("[1,2]"), {"it is no object but of type array"}},
      {always("{\"values\":[1]}"), {"key 'space' is missing"}},
      {always("{\"spaces\":\"hold\"}"), {"there is no key 'spaces'", "did you mean 'space'?"}},
      {always("{\"space\":7}"), {"key 'space' is 7, not a text"}},
      {always("{\"space\":\"gripper\",\"values\":0.02}"), {"key 'values' is 0.02, not a list of numbers"}},
      {always("{\"space\":\"gripper\",\"values\":[\"a\"]}"), {"key 'values[0]' is \"a\", not a number"}},
      {always("{\"space\":\"hold\",\"frames\":1.5}"), {"key 'frames' is 1.5, not a whole number of frames"}},
      {always("{\"space\":\"skill\",\"parameters\":{\"height\":0.2}}"), {"key 'parameters.height' is 0.2"}},
      {always("{\"end\":1}"), {"key 'end' is 1"}},
      {"read -r line; head -c 1100000 /dev/zero | tr '\\0' x; echo", {"longer than 1000000 bytes: \"xxx"}},
      {"echo early; " + always("{\"end\":true}"), {"\"early\""}},
      {"read -r line; echo '{\"space\":\"hold\",\"frames\":1}'; echo two; cat", {"\"two\""}},
      {always("{\"space\":\"hand\"}"), {"100 actions in a row were refused", "there is no action space 'hand'"}}};
  for (const Case& one : cases) {
    const Folder folder;
    const Said run = acted(one.policy, folder / "o.db");
    INFO(one.policy << "\n" << run.err);
    CHECK(run.code == kBadInput);
    CHECK(says(run.err, "--policy: "));
    CHECK(says(run.err, "the command is `"));
    for (const std::string& part : one.told) CHECK(says(run.err, part));
  }
}

TEST_CASE("a program that says nothing is waited for no longer than --policy-timeout, and ended with all it started") {
  const Folder folder;
  const auto began = std::chrono::steady_clock::now();
  const Said run =
      acted("echo $$ >" + (folder / "pid") + "; sleep 1000 & sleep 1000", folder / "o.db", {"--policy-timeout", "1"});
  INFO(run.err);
  CHECK(run.code == kBadInput);
  CHECK(says(run.err, "said nothing for 1 s where the first action"));
  CHECK(says(run.err, "--policy-timeout"));
  CHECK(std::chrono::steady_clock::now() - began < std::chrono::seconds(60));
  CHECK_FALSE(runs(file_text(folder / "pid")));
}

TEST_CASE("what was over before a policy failed is kept") {
  const Folder folder;
  const Said run =
      acted("read -r line; echo '{\"end\":true}'; read -r line; echo oops", folder / "o.db", {"--episodes", "3"});
  INFO(run.err);
  CHECK(run.code == kBadInput);
  CHECK(says(run.err, "line 2 of the program, \"oops\""));
  CHECK(episodes_in(folder / "o.db") == 1);
  CHECK(say({"replay", folder / "o.db"}).code == kDone);
}

TEST_CASE("Ctrl-C ends a run that waits for a policy, and the policy") {
  const Folder folder;
  std::atomic<bool> stop = false;
  std::ostringstream out, err;
  Console console{out, err, false, false, 100, &stop};
  std::thread later([&] {
    for (int i = 0; i < 1200 && !std::filesystem::exists(folder / "pid"); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    stop = true;
  });
  const ExitCode code = run_program(all_commands(),
                                    {"run", "reach_target", "--root", kRoot, "--out", folder / "o.db", "--policy",
                                     "read -r line; echo $$ >" + (folder / "pid") + "; sleep 1000"},
                                    console);
  later.join();
  CHECK(code == kInterrupted);
  CHECK(says(err.str(), "interrupted: 0 of 1 episodes"));
  CHECK_FALSE(runs(file_text(folder / "pid")));
}

TEST_CASE("options that make no sense beside --policy, or without it, are wrong use") {
  const Folder folder;
  for (const Words& more :
       {Words{"--workers", "2"}, Words{"--behaviour", "random_skills"}, Words{"--on-failure", "stop"},
        Words{"--policy-timeout", "0"}, Words{"--observe", "a,,b"}}) {
    const Said run = acted("true", folder / "o.db", more);
    INFO(more.front() << "\n" << run.err);
    CHECK(run.code == kUsage);
    CHECK(says(run.err, more.front()));
  }
  CHECK(acted(" ", folder / "o.db").code == kUsage);
  CHECK(says(say({"run", "reach_target", "--root", kRoot, "--observe", "facts"}).err, "add --policy"));
  const Said unknown = acted(always("{\"end\":true}"), folder / "o.db", {"--observe", "joint_position"});
  CHECK(unknown.code == kBadInput);
  CHECK(says(unknown.err, "did you mean 'joint_positions'?"));
}

TEST_CASE("every line that is no action is told by the key that is wrong, and every action is read whole") {
  CHECK_FALSE(action_from_line(R"({"end":true})"));
  const auto action = action_from_line(
      R"({"space":"skill","values":[],"gripper":0.04,"frame":"tool","controller":"joint_impedance","frames":5,)"
      R"("skill":"pick","arguments":["block1","panda.hand"],"parameters":{"height":[0.2]}})");
  REQUIRE(action);
  CHECK(action->gripper == 0.04);
  CHECK(action->frame == "tool");
  CHECK(action->frames == 5);
  CHECK(action->arguments.size() == 2);
  REQUIRE(action->parameters.size() == 1);
  CHECK(action->parameters.front().name == "height");
  CHECK(action_from_line("{\"space\":\"hold\",\"gripper\":null}\r")->gripper == std::nullopt);
  const std::string nested(100'000, '[');
  for (const std::string& wrong : {std::string(), std::string("{"), std::string("{\"space\":\"\xff\"}"), nested,
                                   std::string("{\"space\":\"hold\"} x"), std::string("{\"space\":1e999}"),
                                   std::string("{\"space\":\"hold\",\"frames\":99999999999}"),
                                   std::string("{\"end\":true,\"space\":\"hold\"}"), std::string("{\"end\":false}")})
    CHECK_THROWS_AS(action_from_line(wrong), Error);
}

}  // namespace stampede::program
