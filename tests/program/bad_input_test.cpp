// What people get wrong, at the program's door: a clear complaint, the right exit code, and nothing lost.
#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

const std::string kTask = R"(-- Take the cup.
return task {
  world = "tabletop",
  objects = { cup = { "OBJECT" } },
  init = { INIT },
  goal = { GOAL },
  instructions = { "take it" },
}
)";

std::string task_of(std::string text, const std::string& object, const std::string& init, const std::string& goal) {
  text.replace(text.find("OBJECT"), 6, object);
  text.replace(text.find("INIT"), 4, init);
  text.replace(text.find("GOAL"), 4, goal);
  return text;
}

Said run_of(const Folder& mine) {
  return say({"run", "t", "--root", STAMPEDE_SOURCE_DIR, "--path", mine.text(), "--out", mine / "o.db"});
}

}  // namespace

TEST_CASE("check NAME tells of the modules that the file requires, and of no file whose name ends like it") {
  const Folder mine;
  put(mine, "worlds/lib/feet.lua", "-- Feet.\nlocal feet = {}\nfeet.high = 1 + nil\nreturn feet\n");
  put(mine, "worlds/objects/stool.lua",
      "-- A stool.\nlocal feet = require \"worlds.lib.feet\"\n"
      "return object { type = \"block\", shape = box { 0.1, 0.1, feet.high } }\n");
  put(mine, "worlds/objects/footstool.lua", "-- A footstool.\nreturn object { typ = \"block\" }\n");
  const Said said = say({"check", "stool", "--root", kRoot, "--path", mine.text()});
  INFO(said.out << said.err);
  CHECK(said.code == kBadInput);
  CHECK(says(said.out, "worlds/lib/feet.lua:3: attempt to perform arithmetic on a nil value"));
  CHECK_FALSE(says(said.out, "footstool"));
  CHECK(say({"check", "cube", "--root", kRoot, "--path", mine.text()}).code == kDone);
}

TEST_CASE("files with mistakes do not keep `list` from telling of all others") {
  const Folder mine;
  put(mine, "worlds/objects/stool.lua", "-- A stool.\nreturn object { typ = \"block\" }\n");
  put(mine, "tasks/begun.lua", "-- Begun.\nreturn task {");
  put(mine, "tasks/sit.lua", task_of(kTask, "stool", "is.on('cup', 'table')", "is.holding('cup')"));
  const auto list = [&](std::vector<std::string> words) {
    words.insert(words.end(), {"--root", STAMPEDE_SOURCE_DIR, "--path", mine.text()});
    return say(words);
  };
  const Said tasks = list({"list"});
  INFO(tasks.out << tasks.err);
  CHECK(tasks.code == kDone);
  CHECK(says(tasks.out, "reach_target"));
  CHECK_FALSE(says(tasks.out, "tasks/sit.lua"));
  CHECK(says(tasks.err, "tasks/begun.lua has mistakes, or uses what has; `stampede check begun` names them\n"));
  CHECK(says(tasks.err, "tasks/sit.lua has mistakes, or uses what has"));
  CHECK(says(tasks.err, "worlds/objects/stool.lua has mistakes"));
  CHECK(says(list({"list", "objects"}).out, "chest"));
  CHECK(list({"list", "chest"}).code == kDone);
  CHECK(list({"list", "reach_target", "--hash"}).code == kDone);
  const Said begun = list({"list", "begun"}), sit = list({"list", "sit", "--hash"});
  CHECK(begun.code == kBadInput);
  CHECK(says(begun.err, "tasks/begun.lua:2"));
  CHECK(sit.code == kBadInput);
  CHECK(says(sit.err, "worlds/objects/stool.lua:2"));
}

TEST_CASE("mistakes in a task are told with place and cure, by `check` and by `run` alike, and nothing is written") {
  struct Case {
    std::string init, goal, place, complaint;
  };
  const std::vector<Case> cases = {
      {"is.onn('cup', 'table')", "is.holding('cup')", "tasks/t.lua:5: init", "did you mean 'on'?"},
      {"is.on('cup')", "is.holding('cup')", "tasks/t.lua:5: init", "on takes 2 arguments, not 1"},
      {"is.on('cup', 'table')", "is.holding('cupp')", "tasks/t.lua:6: goal", "did you mean 'cup'?"},
      {"is.hand_empty()", "is.holding('cup')", "tasks/t.lua:5: init", "nothing places the free object 'cup'"},
      {"is.on('cup', 'table'", "is.holding('cup')", "tasks/t.lua:", "expected"},
      {"os.execute('true')", "is.holding('cup')", "tasks/t.lua:5", "os"},
      {"(function() while true do end end)()", "is.holding('cup')", "tasks/t.lua:5", "instruction budget"},
  };
  for (const Case& one : cases) {
    const Folder mine;
    put(mine, "tasks/t.lua", task_of(kTask, "cube", one.init, one.goal));
    const Said check = checked(mine), run = run_of(mine);
    INFO(one.init + " " + one.goal + "\n" + check.out + "\n" + run.err);
    CHECK(check.code == kBadInput);
    CHECK(run.code == kBadInput);
    for (const std::string& text : {check.out, run.err}) CHECK((says(text, one.place) && says(text, one.complaint)));
    CHECK_FALSE(std::filesystem::exists(mine / "o.db"));
  }
}

TEST_CASE("`check` builds what tasks use: a missing mesh, a broken mesh and a shape without size are found") {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"mesh { 'none.stl' }", "there is no mesh 'none.stl'"},
      {"mesh { 'bad.obj' }", "mesh"},
      {"box { -1, 1, 1 }", "positive"}};
  for (const auto& [shape, complaint] : cases) {
    const Folder mine;
    put(mine, "worlds/objects/mug.lua",
        "-- A mug.\nreturn object { type = \"thing\", traits = { \"movable\" }, mass = 0.1, shape = " + shape + " }\n");
    put(mine, "worlds/objects/bad.obj", "v 0 0 0\nf 1 2 99\n");
    put(mine, "tasks/t.lua", task_of(kTask, "mug", "is.on('cup', 'table')", "is.holding('cup')"));
    const Said check = checked(mine);
    INFO(check.out);
    CHECK(check.code == kBadInput);
    CHECK(says(check.out, complaint));
    CHECK(run_of(mine).code == kBadInput);
  }
}

TEST_CASE("a tip that is not on its tool is refused, with line and cure, whether a task uses the tool or not") {
  const Folder mine;
  put(mine, "worlds/objects/stick.lua",
      "-- A stick.\nreturn object {\n  type = \"thing\", traits = { \"movable\", \"tool\" }, mass = 0.1,\n"
      "  shape = box { 0.02, 0.02, 0.30 },\n  tip = { at = { 0, 0, -0.20 } },\n}\n");
  const Said check = checked(mine);
  INFO(check.out);
  CHECK(check.code == kBadInput);
  CHECK(says(check.out, "worlds/objects/stick.lua:5: tip: the tip is 50 mm outside the tool"));
  CHECK(says(check.out, "its shapes reach from { -0.01, -0.01, -0.15 } to { 0.01, 0.01, 0.15 } m: move `at` there"));
}

TEST_CASE("a slot that is smaller than what is to go into it is refused, in goals and in starts") {
  const auto said = [](const std::string& radius, const std::string& init, const std::string& goal) {
    const Folder mine;
    put(mine, "worlds/objects/rod.lua",
        "-- A rod.\nreturn object { type = \"peg\", traits = { \"movable\", \"graspable\" }, mass = 0.1, shape = "
        "cylinder { " +
            radius + ", 0.10 },\n  regions = { seat = { at = { 0, 0, -0.05 }, size = { 0.01, 0.01, 0.002 } } } }\n");
    put(mine, "worlds/objects/bored.lua",
        file_text(STAMPEDE_SOURCE_DIR "/tests/tasks/authors/worlds/objects/bored_block.lua"));
    put(mine, "tasks/t.lua",
        "-- Put it in.\nreturn task {\n  world = \"tabletop\",\n"
        "  objects = { block = { \"bored\", at = { 0.25, 0, 0.75 } }, rod = { \"rod\" } },\n  init = " +
            init + ",\n  goal = " + goal + ",\n  instructions = { \"put it in\" },\n}\n");
    return checked(mine);
  };
  const std::string on = "{ is.on(\"rod\", \"table\") }", in = "{ is.in_slot(\"rod\", \"block.bore\") }";
  for (const std::string radius : {"0.014", "0.010"}) CHECK(said(radius, on, in).code == kDone);
  const Said goal = said("0.018", on, in), start = said("0.018", in, "is.lifted(\"rod\")");
  INFO(goal.out << start.out);
  CHECK(goal.code == kBadInput);
  CHECK(says(goal.out, "tasks/t.lua:6: goal: 'rod' does not fit: it would touch 'block'"));
  CHECK(says(goal.out, "make the place wider, or the thing smaller"));
  CHECK(start.code == kBadInput);
  CHECK(says(start.out, "tasks/t.lua:5: init: 'rod' does not fit"));
}

TEST_CASE("a malformed URDF is one complaint, with its line and the cure") {
  const Folder mine;
  std::string arm = file_text(STAMPEDE_SOURCE_DIR "/worlds/robots/panda.lua");
  arm.replace(arm.find("panda.urdf"), 10, "arm.urdf");
  put(mine, "worlds/robots/arm.lua", arm);
  put(mine, "worlds/robots/arm.urdf", "<robot name=\"arm\">\n<link name=\"a\"><inertial>");
  put(mine, "worlds/w.lua", "-- A bare world.\nreturn world { robot = { \"arm\" }, fixtures = {} }\n");
  put(mine, "tasks/t.lua",
      "-- Nothing.\nreturn task { world = \"w\", objects = {}, goal = { is.hand_empty() }, instructions = { \"wait\" } "
      "}\n");
  const Said check = checked(mine);
  INFO(check.out);
  CHECK(check.code == kBadInput);
  CHECK(says(check.out, "worlds/robots/arm.urdf:2: malformed XML: "));
  CHECK(says(check.out, "close every element and quote every attribute"));
  CHECK(says(check.out, ", 1 mistake\n"));
}

TEST_CASE("a goal that no skill reaches names the literal and what is missing") {
  const Folder mine;
  put(mine, "worlds/predicates/poked.lua",
      "-- It was poked.\nreturn predicate {\n  params = { \"obj: movable\" },\n  label = \"the {obj} is poked\",\n"
      "  holds = function(w, obj) return false end,\n}\n");
  put(mine, "tasks/t.lua", task_of(kTask, "cube", "is.on('cup', 'table')", "is.poked('cup')"));
  const Said plan = say({"plan", "t", "--root", STAMPEDE_SOURCE_DIR, "--path", mine.text()});
  INFO(plan.err);
  CHECK(plan.code == kNo);
  CHECK(says(plan.err, "(poked cup)"));
  CHECK(says(plan.err, "no action adds"));
  const Said run = run_of(mine);
  CHECK(run.code == kNo);
  CHECK(says(run.err, "no_plan"));
}

TEST_CASE("every task that ships has a plan from its start") {
  for (const char* task :
       {"reach_target", "pick_and_lift", "stack_blocks", "put_item_in_drawer", "push_buttons", "close_drawer"}) {
    const Said plan = say({"plan", task, "--root", STAMPEDE_SOURCE_DIR});
    INFO(task + (": " + plan.err));
    CHECK(plan.code == kDone);
    CHECK(plan.out.front() == '(');
  }
}

TEST_CASE("numbers out of range are usage, whatever the command, and the word after an option's value is free") {
  const std::vector<std::vector<std::string>> cases = {
      {"run", "reach_target", "--seed", "99999999999999999999"},
      {"run", "reach_target", "--split", "test", "--seed", "9223372036854775807"},
      {"run", "reach_target", "--split", "test", "--episodes", "99999999999"},
      {"run", "reach_target", "--workers", "100000"},
      {"run", "reach_target", "--out", ""},
      {"run", "reach_target", "--out"},
      {"run", "reach_target", "--seed", "1", "--seed", "2"},
      {"plan", "reach_target", "--seed", "-5"},
      {"check", "--physics", "--episodes", "0", "reach_target"},
      {"check", "--physics", "--workers", "-3", "reach_target"},
  };
  for (const std::vector<std::string>& words : cases) {
    const Said said = say(words);
    INFO(words[0] + " " + words[2] + " -> " + said.err);
    CHECK(said.code == kUsage);
    CHECK_FALSE(says(said.err, "a bug of ours"));
  }
  CHECK(say({"list", "--root", STAMPEDE_SOURCE_DIR, "skills"}).code == kDone);
}

TEST_CASE("a byte order mark at the beginning of a text is no part of it") {
  const Folder mine;
  const std::string mark = "\xef\xbb\xbf";
  put(mine, "tasks/marked.lua", mark + file_text(std::string(kRoot) + "/tasks/reach_target.lua"));
  const Said task = checked(mine, {"marked"});
  INFO(task.out + task.err);
  CHECK(task.code == kDone);
  put(mine, "d.pddl", mark + "(define (domain d) (:predicates (p)) (:action a :parameters () :effect (p)))");
  put(mine, "p.pddl", mark + "(define (problem q) (:domain d) (:init) (:goal (p)))");
  put(mine, "plan", mark + "(a)\n");
  CHECK(say({"plan", mine / "d.pddl", mine / "p.pddl"}).code == kDone);
  const Said valid = say({"validate", mine / "d.pddl", mine / "p.pddl", mine / "plan"});
  INFO(valid.out + valid.err);
  CHECK(valid.code == kDone);
}

TEST_CASE("a question that would never end is ended by Ctrl-C, and one that would write is refused") {
  const Folder mine;
  REQUIRE(say({"run", "reach_target", "--root", STAMPEDE_SOURCE_DIR, "--out", mine / "d.db"}).code == kDone);
  const std::string before = file_text(mine / "d.db");
  for (const char* sql : {"DELETE FROM episode", "VACUUM", "PRAGMA user_version = 9", "ATTACH 'x.db' AS x",
                          "SELECT 1; DROP TABLE episode", "CREATE TEMP TABLE x(a)"}) {
    CHECK(say({"query", mine / "d.db", sql}).code == kBadInput);
  }
  std::atomic<bool> stop = false;
  std::ostringstream out, err;
  Console console{out, err, false, false, 100, &stop};
  std::thread hand([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    stop = true;
  });
  const std::string endless = "WITH RECURSIVE c(x) AS (SELECT 1 UNION ALL SELECT x + 1 FROM c) SELECT count(*) FROM c";
  const ExitCode code = run_program(all_commands(), {"query", mine / "d.db", endless}, console);
  hand.join();
  CHECK(code == kInterrupted);
  CHECK(says(err.str(), "interrupted"));
  CHECK(file_text(mine / "d.db") == before);
}

}  // namespace stampede::program
