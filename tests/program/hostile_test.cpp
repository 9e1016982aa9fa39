// Folders of scripts and models that nobody vouches for: each is a complaint that names the file, at once.
#include <catch2/catch.hpp>
#include <ctime>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::string task_with(const std::string& more, const std::string& object = "thing") {
  return "-- Take it.\nreturn task {\n  world = \"tabletop\",\n  objects = { b = { \"" + object +
         "\" } },\n  init = { is.on(\"b\", \"table\") },\n  goal = is.holding(\"b\"),\n  instructions = { \"take it\" "
         "},\n" +
         more + "}\n";
}

std::string object_with(const std::string& shape) {
  return "-- A thing.\nreturn object {\n  type = \"cube\", traits = { \"movable\", \"graspable\" }, mass = 0.1,\n  " +
         shape + ",\n}\n";
}

Said ran(const Folder& mine, const std::string& tasks = "t") {
  std::vector<std::string> words = {"run", "--episodes", "1", "--seed", "1"};
  words.insert(words.end(), {"--root", STAMPEDE_SOURCE_DIR, "--path", mine.text(), "--out", mine / "o.db", tasks});
  return say(words);
}

std::string told(const Said& said) { return said.out + said.err; }

const std::string kSmallTetrahedron =
    "v 0 0 0\nv 0.04 0 0\nv 0 0.04 0\nv 0 0 0.04\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

}  // namespace

TEST_CASE("models that crash, loop or are formats are refused with file and reason") {
  struct Case {
    std::string shape, name, text, reason;
  };
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  const std::vector<Case> cases = {
      {"shape = mesh { \"m.ply\" }", "m.ply", ply + "3 2 0 77777777\n", "m.ply"},
      {"urdf = \"m.urdf\"", "m.urdf",
       "<robot name='r'><link name='a'><inertial><mass value='%n%n%s'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
       "ixz='0' iyz='0'/></inertial></link></robot>",
       "'%'"},
  };
  for (const Case& one : cases) {
    const Folder mine;
    put(mine, "tasks/t.lua", task_with(""));
    put(mine, "worlds/objects/thing.lua", object_with(one.shape));
    put(mine, "worlds/objects/" + one.name, one.text);
    const std::clock_t start = std::clock();
    const Said said = ran(mine);
    INFO(one.shape << "\n" << told(said));
    CHECK(said.code == kBadInput);
    CHECK(says(told(said), one.name));
    CHECK(says(told(said), one.reason));
    CHECK(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC < 10);
  }
}

TEST_CASE("a mesh is found inside the roots, and nowhere else") {
  const Folder mine, elsewhere;
  put(elsewhere, "m.obj", kSmallTetrahedron);
  put(mine, "worlds/objects/m.obj", kSmallTetrahedron);
  put(mine, "tasks/t.lua", task_with(""));
  const std::string up = "../../../" + std::filesystem::path(elsewhere.text()).filename().string() + "/m.obj";
  for (const std::string& name : {elsewhere / "m.obj", up, std::string("gone.obj")}) {
    put(mine, "worlds/objects/thing.lua", object_with("shape = mesh { \"" + name + "\" }"));
    for (const Said& said : {checked(mine, {"t"}), ran(mine)}) {
      INFO(name << "\n" << told(said));
      CHECK(said.code == kBadInput);
      CHECK(says(told(said), "worlds/objects/thing.lua:"));
      CHECK(says(told(said), name == "gone.obj" ? "there is no mesh 'gone.obj'" : "--path FOLDER"));
    }
  }
  put(mine, "worlds/objects/thing.lua", object_with("shape = mesh { \"m.obj\" }"));
  CHECK(checked(mine, {"t"}).code == kDone);
  std::filesystem::create_symlink(elsewhere / "m.obj", mine / "worlds/objects/link.obj");
  put(mine, "worlds/objects/thing.lua", object_with("shape = mesh { \"link.obj\" }"));
  CHECK(says(told(checked(mine, {"t"})), "outside the roots"));
}

TEST_CASE("what would cost too much is said before it costs anything") {
  const Folder mine;
  std::string boxes = "shapes = {", rings = "shape = lathe {";
  for (int i = 0; i < 2000; ++i) boxes += " box { 0.01, 0.01, 0.01 },";
  for (int i = 0; i < 5000; ++i) rings += " { 0.02, " + std::to_string(0.00001 * i) + " },";
  put(mine, "tasks/t.lua", task_with(""));
  put(mine, "worlds/objects/thing.lua", object_with(boxes + " }"));
  CHECK(says(told(checked(mine, {"t"})), "2000 shapes"));
  put(mine, "worlds/objects/thing.lua", object_with(rings + " }"));
  CHECK(says(told(checked(mine, {"t"})), "lathe of 5000 rings"));
  put(mine, "worlds/objects/thing.lua", object_with("shape = box { 0.04, 0.04, 0.04 }"));
  CHECK(checked(mine, {"t"}).code == kDone);
  put(mine, "worlds/fast.lua", "-- A world.\nreturn world { robot = { \"panda\" }, physics_hz = 240000 }\n");
  CHECK(says(told(checked(mine, {"fast"})), "240000 Hz is beyond what is simulated"));
}

TEST_CASE("a skill that runs itself ends the skill, not the program") {
  const Folder mine;
  put(mine, "skills/again.lua",
      "-- Again.\nreturn skill { params = { \"obj: movable\" }, effect = { is.holding(\"obj\"), is_not.hand_empty() }, "
      "label = \"again "
      "{obj}\","
      " run = function(robot, p, c) robot:run(act.again(\"b\")) end }\n");
  put(mine, "tasks/t.lua", task_with("  steps = { act.again(\"b\") },\n", "cube"));
  const Said said = ran(mine);
  INFO(told(said));
  CHECK(says(told(said), "script_error"));
  const Said why = say({"query", mine / "o.db", "SELECT detail FROM episodes", "--format", "csv"});
  CHECK(says(why.out, "does it run itself?"));
}

TEST_CASE("a reward that is no number fails its own episode, with the script's name") {
  const Folder mine;
  put(mine, "tasks/t.lua", task_with("  reward = function(w, v) return 0 / 0 end,\n", "cube"));
  put(mine, "tasks/good.lua", task_with("", "cube"));
  const Said said = say({"run", "t", "good", "--episodes", "1", "--root", STAMPEDE_SOURCE_DIR, "--path", mine.text(),
                         "--out", mine / "o.db"});
  INFO(told(said));
  const auto rows = say(
      {"query", mine / "o.db", "SELECT task, outcome, reason, detail FROM episodes ORDER BY task", "--format", "csv"});
  CHECK(says(rows.out, "good,success"));
  CHECK(says(rows.out, "t,failure,script_error"));
  CHECK(says(rows.out, "tasks/t.lua: reward gives a number that is not finite"));
}

}  // namespace stampede::program
