#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <set>

#include "engine/base/text_file.h"
#include "scripting/library/roots.h"
#include "scripting/session/episode_job.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::vector<EpisodeJob> all_of(const JobList& list) {
  std::vector<EpisodeJob> jobs;
  for (std::int64_t i = 0; i < list.size(); ++i) jobs.push_back(list[i]);
  return jobs;
}

}  // namespace

TEST_CASE("episode i has seed S+i, and the first V episodes meet each of V variations once") {
  const auto library = Library::load(make_roots(kRoot, {}));
  const auto count = static_cast<std::int64_t>(task_info(*library, "reach_target").variation_texts.size());
  const JobList list(*library, {{"reach_target"}, count, 50, ""});
  const std::vector<EpisodeJob> jobs = all_of(list);
  std::set<std::string> variations;
  std::set<std::int64_t> seeds;
  for (const EpisodeJob& job : jobs) {
    variations.insert(job.variation);
    seeds.insert(job.seed);
  }
  CHECK(std::is_sorted(jobs.begin(), jobs.end()));
  CHECK(static_cast<std::int64_t>(variations.size()) == count);
  CHECK(*seeds.begin() == 50);
  CHECK(*seeds.rbegin() == 50 + count - 1);
  for (const EpisodeJob& job : all_of({*library, {{"reach_target"}, 5, 0, "colour=red"}})) {
    CHECK(job.variation.find("colour=red") != std::string::npos);
  }
  CHECK_THROWS_AS(JobList(*library, {{"reach_targett"}, 1, 0, ""}), Error);
  CHECK_THROWS_AS(JobList(*library, {{"reach_target"}, 1, 0, "colour=rde"}), Error);
}

TEST_CASE("episodes of several tasks and more episodes than variations: in order, each seed once") {
  const auto library = Library::load(make_roots(kRoot, {}));
  for (const std::int64_t count : {1, 2, 7, 500}) {
    const std::vector<EpisodeJob> jobs = all_of({*library, {{"reach_target", "close_drawer", "reach_target"}, count}});
    CHECK(static_cast<std::int64_t>(jobs.size()) == 2 * count);
    CHECK(std::is_sorted(jobs.begin(), jobs.end()));
    std::map<std::string, std::set<std::int64_t>> seeds;
    for (const EpisodeJob& job : jobs) seeds[job.task].insert(job.seed);
    for (const auto& [task, own] : seeds) CHECK(static_cast<std::int64_t>(own.size()) == count);
  }
}

TEST_CASE("the shards of a run are the run, each job once") {
  const auto library = Library::load(make_roots(kRoot, {}));
  JobRequest request{{"reach_target", "close_drawer"}, 11};
  const std::vector<EpisodeJob> whole = all_of({*library, request});
  for (const std::int64_t count : {1, 2, 5, 40}) {
    std::vector<EpisodeJob> together;
    for (std::int64_t i = 1; i <= count; ++i) {
      request.shard = {i, count};
      const std::vector<EpisodeJob> part = all_of({*library, request});
      CHECK(part.size() <= whole.size() / static_cast<std::size_t>(count) + 1);
      together.insert(together.end(), part.begin(), part.end());
    }
    std::sort(together.begin(), together.end());
    CHECK(together == whole);
  }
}

TEST_CASE("a list of a million jobs is made at once") {
  const auto library = Library::load(make_roots(kRoot, {}));
  const JobList list(*library, {{"reach_target"}, 1'000'000});
  REQUIRE(list.size() == 1'000'000);
  CHECK(list[0] < list[1]);
  CHECK(list[499'999] < list[999'999]);
}

TEST_CASE("a shard that is not there is a mistake of usage") {
  for (const char* wrong : {"0/4", "5/4", "1/0", "-1/4", "1", "a/b", "1/", "/2", "1/2/3", "1.5/2", ""}) {
    INFO(wrong);
    CHECK(say({"run", "reach_target", "--root", kRoot, "--shard", wrong}).code == kUsage);
  }
  CHECK(says(say({"run", "reach_target", "--root", kRoot, "--shard", "5/4"}).err, "from 1/4 to 4/4"));
}

TEST_CASE("a key tells apart seed, variation, options and definitions, and nothing else") {
  const std::vector<DefinitionRecord> files = {{"task", "a", "a.lua", "", "h1"}, {"skill", "b", "b.lua", "", "h2"}};
  const std::vector<DefinitionRecord> reversed = {files[1], files[0]};
  const std::string key = episode_key(files, {"a", "v", 1}, {});
  CHECK(key == episode_key(reversed, {"a", "v", 1}, {}));
  CHECK(key != episode_key(files, {"a", "v", 2}, {}));
  CHECK(key != episode_key(files, {"a", "w", 1}, {}));
  RunOptions stop;
  stop.on_failure = OnFailure::stop;
  CHECK(key != episode_key(files, {"a", "v", 1}, stop));
  std::vector<DefinitionRecord> edited = files;
  edited[1].hash = "h3";
  CHECK(key != episode_key(edited, {"a", "v", 1}, {}));
}

TEST_CASE("with --set, what a caller chooses is used and named as the caller's") {
  const Folder mine;
  const Said run = say({"run", "pick_and_lift", "--seed", "3", "--set", "pick.height=0.2", "--set",
                        "pick.controller=joint_impedance", "--root", kRoot, "--out", mine / "o.db"});
  INFO(run.err);
  REQUIRE(run.code == kDone);
  const std::string question =
      "SELECT name, value, text, chosen_by FROM parameters WHERE undone = 0 AND name IN ('height', 'controller')";
  CHECK(say({"query", mine / "o.db", question, "--format", "csv"}).out ==
        "name,value,text,chosen_by\nheight,0.2,,caller\ncontroller,,joint_impedance,caller\n");
}

TEST_CASE("with --set, what there is not is a wrong use, before anything runs") {
  const Folder mine;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"pik.height=0.2", "there is no skill 'pik'\n    did you mean 'pick'?"},
      {"pick.hight=0.2", "did you mean 'height'?"},
      {"pick.height=2", "pick.height is at most 0.3m, not 2"},
      {"pick.height=", "is no number"},
      {"pick.height.2=0.1", "components 1 to 1"},
      {"pick.controller=magic", "there is no controller 'magic'"},
      {"height=0.2", "SKILL.PARAMETER=VALUE"},
  };
  for (const auto& [text, complaint] : cases) {
    const Said run = say({"run", "pick_up_cup", "--set", text, "--root", kRoot, "--out", mine / "o.db"});
    INFO(text << "\n" << run.err);
    CHECK(run.code == kUsage);
    CHECK(run.err.find(complaint) != std::string::npos);
    CHECK_FALSE(std::filesystem::exists(mine / "o.db"));
  }
}

TEST_CASE("a file that `new` writes passes `check`, and a misspelt field ends with 3") {
  const Folder mine;
  for (const char* kind : {"task", "skill", "predicate", "object"}) {
    const Said made = say({"new", kind, std::string("my_") + kind, "--root", kRoot, "--path", mine.text()});
    INFO(made.err);
    REQUIRE(made.code == kDone);
  }
  const Said sound = say({"check", "--root", kRoot, "--path", mine.text()});
  INFO(sound.out);
  CHECK(sound.code == kDone);
  CHECK(say({"new", "task", "my_task", "--root", kRoot, "--path", mine.text()}).code == kUsage);

  std::ofstream(mine / "tasks/my_task.lua") << "-- Wrong.\nreturn task {\n  object = {},\n}\n";
  const Said wrong = say({"check", "my_task", "--root", kRoot, "--path", mine.text()});
  CHECK(wrong.code == kBadInput);
  CHECK(wrong.out.find("did you mean 'objects'?") != std::string::npos);
}

TEST_CASE("a mistake in a file stops the tasks that use it, and no other, check tells all") {
  const Folder mine;
  std::filesystem::create_directories(mine / "tasks");
  std::filesystem::create_directories(mine / "worlds/objects");
  std::ofstream(mine / "tasks/broken.lua") << "-- Wrong.\nreturn task {\n  object = {},\n}\n";
  std::ofstream(mine / "tasks/unfinished.lua") << "-- Not yet.\nreturn task {\n  world =\n";
  std::ofstream(mine / "worlds/objects/thingy.lua")
      << "-- A thing.\nreturn object {\n  type = \"cube\", traits = { \"movable\", \"graspable\" },\n"
         "  shape = box { 0.04, 0.04, 0.04 }, mas = 0.1,\n}\n";
  std::ofstream(mine / "tasks/with_thingy.lua")
      << "-- Lift it.\nreturn task {\n  world = \"tabletop\",\n  objects = { a = { \"thingy\" }, b = { \"cube\" } },\n"
         "  init = { is.on(\"a\", \"table\"), is.on(\"b\", \"table\") },\n  goal = is.lifted(\"b\"),\n"
         "  instructions = { \"lift it\" },\n}\n";
  const auto with_mine = [&](std::vector<std::string> words) {
    for (const std::string& word : {std::string("--root"), std::string(kRoot), std::string("--path"), mine.text()})
      words.push_back(word);
    return say(words);
  };
  const Said ran = with_mine({"run", "reach_target", "--out", mine / "d.db"});
  INFO(ran.err);
  CHECK(ran.code == kDone);
  CHECK(with_mine({"plan", "reach_target"}).code == kDone);
  const Said all = with_mine({"check"});
  CHECK(all.code == kBadInput);
  for (const char* file : {"tasks/broken.lua", "tasks/unfinished.lua", "worlds/objects/thingy.lua"})
    CHECK(says(all.out, file));

  for (const char* task : {"broken", "unfinished", "with_thingy"}) {
    const Said refused = with_mine({"run", task, "--out", mine / "d.db"});
    INFO(task << ": " << refused.err);
    CHECK(refused.code == kBadInput);
    CHECK(says(refused.err, std::string(task) == "with_thingy" ? "worlds/objects/thingy.lua" : task));
    CHECK_FALSE(says(refused.err, std::string(task) == "broken" ? "unfinished" : "broken"));
  }
  // What it does not use harms no task.
  std::filesystem::create_directories(mine / "skills");
  std::ofstream(mine / "skills/mine.lua") << "-- Wrong.\nreturn skill { param = {} }\n";
  CHECK(with_mine({"run", "reach_target", "--out", mine / "d.db"}).code == kDone);
}

TEST_CASE("what a task tells is known: the drawer that is named is opened, and no other") {
  for (const std::string level : {"bottom", "middle", "top"}) {
    const Said plan = say({"plan", "take_item_out_of_drawer", "--variation", "level=" + level, "--root", kRoot});
    INFO(plan.out << plan.err);
    CHECK(plan.code == kDone);
    CHECK(says(plan.out, "(open chest." + level + "_drawer"));
    CHECK(plan.out.find("(open ") == plan.out.rfind("(open "));
  }
}

TEST_CASE("a failed step says how many of its grasps failed of what") {
  const Folder mine;
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "tasks/too_far.lua")
      << "-- Nobody reaches it.\nreturn task {\n  world = \"tabletop\",\n  "
         "objects = { far = { \"tray\", at = { 1.2, 0, 0.75 } }, a = { \"cube\", at = { 1.2, 0, 0.7702 } } },\n"
         "  goal = is.lifted(\"a\"),\n  instructions = { \"lift it\" },\n}\n";
  const Said said =
      say({"check", "too_far", "--physics", "--why", "--episodes", "1", "--root", kRoot, "--path", mine.text()});
  INFO(said.out << said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "grasps: "));
  CHECK(says(said.err, "out of reach"));
}

TEST_CASE("one run of check finds what five files have wrong, each with its line") {
  const Folder mine;
  std::filesystem::create_directories(mine / "worlds/objects");
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "worlds/objects/brick.lua")
      << "-- A brick.\nreturn object {\n  type = \"block\", traits = { \"movable\", \"graspable\" },\n"
         "  shape = box { 0.1, 0.1, 0.04 }, mass = \"heavy\", friction = -1,\n  grasps = { { width = 0.10 } },\n"
         "  parts = { lid = { hinge = { range = { 1, 0 }, damping = -1 },\n    shape = box { 0.1, 0, 0.01 } },\n"
         "    tray = { slider = { range = { 0, 1 }, follows = { part = \"needle\" } } },\n"
         "    needle = { hinge = { range = { 0, 1 }, follows = { part = \"tray\" } } },\n"
         "    door = { hinge = { range = { 0, 1 }, latch = { key = \"door\", open = 1 } } },\n"
         "    leaf = { hinge = { range = { 0, 1 }, follows = { part = \"dor\" } } } },\n}\n";
  const auto task = [&](const char* name, const std::string& entry, const std::string& goal) {
    std::ofstream(mine / ("tasks/" + std::string(name) + ".lua"))
        << "-- A task.\nreturn task {\n  world = \"tabletop\",\n  objects = { a = { " + entry +
               " }, b = { \"cube\" } },\n  init = { is.on(\"a\", \"table\"), is.on(\"b\", \"table\") },\n  goal = " +
               goal + ",\n  instructions = { \"do it\" },\n}\n";
  };
  task("light", "\"cube\", mass = \"light\"", "is.lifted(\"a\")");
  task("nested", "\"cube\"", "any_of { in_order { is.lifted(\"a\"), is.on(\"a\", \"b\") }, is.lifted(\"b\") }");
  task("unclear", "\"cube\"", "function(v) return in_order { is.lifted(\"a\"), { is.lifted(\"b\") } } end");
  task("choice", "\"cube\"", "in_order { any_of { is.lifted(\"a\"), is.lifted(\"b\") }, is.lifted(\"a\") }");
  const Said all = say({"check", "--root", kRoot, "--path", mine.text()});
  CHECK(all.code == kBadInput);
  INFO(all.out);
  for (const char* complaint :
       {"worlds/objects/brick.lua:4: mass: expects number", "worlds/objects/brick.lua:4: friction: is negative",
        "worlds/objects/brick.lua:5: grasps: grasp 1 is 0.1 m wide, no hand opens further than 0.080 m",
        "worlds/objects/brick.lua:6: parts.lid.hinge.range: ends before it begins",
        "worlds/objects/brick.lua:6: parts.lid.hinge.damping: is negative",
        "worlds/objects/brick.lua:7: a box has an edge of 0",
        "worlds/objects/brick.lua:8: parts.tray.slider.follows: couplings in a circle: tray -> needle -> tray",
        "worlds/objects/brick.lua:10: parts.door.hinge.latch: it names its own part",
        "worlds/objects/brick.lua:11: parts.leaf.hinge.follows: there is no other part 'dor' that moves",
        "tasks/light.lua:4: objects.a.mass: expects number",
        "tasks/nested.lua:6: goal: in_order stands inside another formula",
        "tasks/choice.lua:6: goal: a part of in_order is more than literals",
        "tasks/unclear.lua:6: goal: in_order takes a literal or formula, this is a table"})
    CHECK(says(all.out, complaint));
}

TEST_CASE("own types, traits and colours add to the library's, and objects may declare theirs") {
  const Folder mine;
  const auto with_mine = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--root", kRoot, "--path", mine.text()});
    return say(words);
  };
  for (const char* name : {"sponge", "cloth"}) REQUIRE(with_mine({"new", "type", name}).code == kDone);
  REQUIRE(with_mine({"new", "trait", "wipeable"}).code == kDone);
  const std::string types = file_text(mine / "worlds/types.lua");
  CHECK(says(types, "sponge = { parent = \"thing\" }"));
  CHECK(says(types, "wipeable = \""));
  for (const char* taken : {"sponge", "wipeable", "movable", "cube"})
    CHECK(with_mine({"new", "trait", taken}).code == kUsage);
  std::filesystem::create_directories(mine / "worlds/objects");
  std::ofstream(mine / "worlds/colours.lua") << "return { mine = { 0.1, 0.2, 0.3 } }\n";
  std::ofstream(mine / "worlds/objects/soap.lua")
      << "-- A bar of soap.\nreturn object {\n  type = \"soap_bar\", traits = { \"movable\", \"graspable\", "
         "\"wipeable\", "
         "\"slippery\" },\n  declares = { types = { soap_bar = { parent = \"sponge\" } }, traits = { slippery = "
         "\"slips\" } },\n"
         "  shape = box { 0.04, 0.04, 0.04 }, mass = 0.1, colour = \"mine\",\n}\n";
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "tasks/lift_soap.lua") << "-- Lift it.\nreturn task {\n  world = \"tabletop\",\n  objects = { a "
                                                 "= { \"soap\" }, b = { \"cube\", colour = \"red\" } },\n"
                                                 "  init = { is.on(\"a\", \"table\"), is.on(\"b\", \"table\") },\n  "
                                                 "goal = exists(\"?x: sponge & slippery\", is.lifted(\"?x\")),\n"
                                                 "  instructions = { \"lift it\" },\n}\n";
  const Said sound = with_mine({"check"});
  INFO(sound.out);
  CHECK(sound.code == kDone);
  CHECK(with_mine({"plan", "lift_soap"}).code == kDone);

  std::ofstream(mine / "worlds/objects/soap.lua")
      << "-- A bar of soap.\nreturn object {\n  type = \"soap_bar\", traits = {},\n"
         "  declares = { types = { soap_bar = \"spong\" } },\n  shape = box { 0.04, 0.04, 0.04 },\n}\n";
  const Said wrong = with_mine({"check"});
  CHECK(wrong.code == kBadInput);
  CHECK(says(wrong.out, "worlds/objects/soap.lua:4: declares.types.soap_bar: its parent 'spong' is not a type"));
  CHECK(says(wrong.out, "did you mean 'sponge'?"));
}

TEST_CASE("new keeps what editors read in an own folder current, and leaves their settings alone") {
  const Folder mine;
  const auto make = [&](const char* name) {
    return say({"new", "predicate", name, "--root", kRoot, "--path", mine.text()}).code;
  };
  REQUIRE(make("tilted") == kDone);
  CHECK(says(file_text(mine / ".luarc.json"), ".stampede"));
  std::ofstream(mine / ".luarc.json") << "{}";
  REQUIRE(make("upright") == kDone);
  CHECK(file_text(mine / ".luarc.json") == "{}");
  const std::string names = file_text(mine / ".stampede/names.lua");
  for (const char* name : {"field tilted fun(", "field upright fun(", "field inside fun("}) CHECK(says(names, name));
  const auto check = [&] { return say({"doc", "--check", "--root", kRoot, "--path", mine.text()}).code; };
  CHECK(check() == kDone);
  std::filesystem::remove(mine / "worlds/predicates/tilted.lua");
  CHECK(check() == kNo);
  const Said elsewhere = say({"doc", "--root", mine.text()});
  CHECK(elsewhere.code == kUsage);
  CHECK(says(elsewhere.err, "--path"));
}

TEST_CASE("a new robot is made from its URDF, or from a small arm's, and does a task") {
  const Folder mine;
  const auto made = [&](const std::string& name) {
    return say({"new", "robot", name, "--root", kRoot, "--path", mine.text()});
  };
  const std::filesystem::path robots = mine / "worlds/robots";
  REQUIRE(made("own_arm").code == kDone);
  CHECK(std::filesystem::exists(robots / "own_arm.urdf"));
  std::filesystem::create_directories(mine / "tasks");
  std::ofstream(mine / "worlds/cell.lua")
      << "-- A table with that arm.\nreturn world {\n"
         "  robot = { \"own_arm\", at = { -0.30, 0, 0.75 } },\n"
         "  fixtures = { table = { \"work_table\", at = { 0.19, 0, 0.75 } } },\n}\n";
  std::ofstream(mine / "tasks/take_it.lua")
      << "-- Take the cube.\nreturn task {\n  world = \"cell\", objects = { item = { \"cube\" } },\n"
         "  init = { is.on(\"item\", \"table\") }, goal = is.lifted(\"item\"), instructions = { \"take the cube\" "
         "},\n}\n";
  const Said checked = say({"check", "--root", kRoot, "--path", mine.text()});
  CHECK(says(checked.out, " 0 mistakes"));
  CHECK(say({"run", "take_it", "--root", kRoot, "--path", mine.text()}).code == kDone);

  std::filesystem::copy_file(std::filesystem::path(kRoot) / "worlds/robots/panda.urdf", robots / "copy.urdf");
  REQUIRE(made("copy").code == kDone);
  const std::string copy = read_text_file(robots / "copy.lua");
  CHECK(says(copy, "arm = { \"joint1\", \"joint2\", \"joint3\", \"joint4\", \"joint5\", \"joint6\", \"joint7\" }"));
  CHECK(says(copy, "pads = { \"left_finger\", \"right_finger\" }"));
  CHECK(says(copy, "tip = { link = \"hand\", at = { 0, 0, 0.10"));

  std::ofstream(robots / "post.urdf") << "<robot name=\"post\"><link name=\"base\"/></robot>";
  const Said post = made("post");
  CHECK(post.code == kBadInput);
  CHECK(says(post.err, "post.urdf: nothing in it turns or slides"));
  CHECK_FALSE(std::filesystem::exists(robots / "post.lua"));
  std::ofstream(robots / "torn.urdf") << "<robot name=\"torn\"><link";
  CHECK(made("torn").code == kBadInput);
}

TEST_CASE("a controller that a run names for a skill goes before the run's own, that before the skill's") {
  const Folder folder;
  const std::vector<std::string> run = {"run",   "stack_blocks",  "--root",      kRoot,
                                        "--out", folder / "d.db", "--variation", "height=2"};
  const auto controllers = [&](const std::vector<std::string>& more) {
    std::filesystem::remove(folder / "d.db");
    std::vector<std::string> words = run;
    words.insert(words.end(), more.begin(), more.end());
    REQUIRE(say(words).code == kDone);
    return say({"query", folder / "d.db", "--format", "csv",
                "SELECT DISTINCT skill, controller FROM segments WHERE kind = 'skill' AND skill IN ('pick', 'stack') "
                "ORDER BY skill"})
        .out;
  };
  CHECK(controllers({}) == "skill,controller\npick,joint_position\nstack,joint_position\n");
  const std::vector<std::string> all = {"--controller", "joint_impedance"};
  CHECK(controllers(all) == "skill,controller\npick,joint_impedance\nstack,joint_impedance\n");
  const std::vector<std::string> both = {"--controller", "joint_impedance", "--set",
                                         "pick.controller=cartesian_impedance"};
  CHECK(controllers(both) == "skill,controller\npick,cartesian_impedance\nstack,joint_impedance\n");
}

TEST_CASE("the exit code of a run is the same whether its episodes were there or not") {
  const Folder folder;
  const std::vector<std::string> fails = {"run",           "stack_blocks", "--root", kRoot,   "--behaviour",
                                          "random_skills", "--skills",     "1",      "--out", folder / "o.db"};
  CHECK(say(fails).code == kNo);
  CHECK(say(fails).code == kNo);
  const std::vector<std::string> works = {"run", "reach_target", "--root", kRoot, "--out", folder / "o.db"};
  CHECK(say(works).code == kDone);
  CHECK(say(works).code == kDone);
  CHECK(say(fails).code == kNo);
}

}  // namespace stampede::program
