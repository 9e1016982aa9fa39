// `check` says what `run` refuses, and only that: for named files, for what they use, and for all.
#include <catch2/catch.hpp>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

Said check(const Folder& mine, std::vector<std::string> names = {}) {
  names.insert(names.begin(), {"check", "--root", kRoot, "--path", mine.text()});
  return say(names);
}

Said run_one(const Folder& mine, const std::string& task) {
  return say(
      {"run", task, "--episodes", "1", "--seed", "1", "--root", kRoot, "--path", mine.text(), "--out", mine / "o.db"});
}

std::string all(const Said& said) { return said.out + said.err; }

void put_task(const Folder& mine, const std::string& name, const std::string& goal = "is.holding(\"b\")",
              const std::string& object = "cube", const std::string& world = "tabletop") {
  put(mine, "tasks/" + name + ".lua",
      "-- Take it.\nreturn task {\n  world = \"" + world + "\",\n  objects = { b = { \"" + object +
          "\" } },\n  init = { is.on(\"b\", \"table\") },\n  goal = " + goal +
          ",\n  instructions = { \"take it\" },\n}\n");
}

std::string thing(const std::string& fields, const std::string& traits = "\"movable\", \"graspable\"") {
  return "-- A thing.\nreturn object {\n  type = \"cube\", traits = { " + traits + " },\n  " + fields + ",\n}\n";
}

const std::string kHugeTetrahedron = "v 0 0 0\nv 40 0 0\nv 0 40 0\nv 0 0 40\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

std::string link(const std::string& name, const std::string& inside) {
  return "<link name='" + name + "'>" + inside + "</link>";
}
const std::string kBox = "<collision><geometry><box size='0.05 0.05 0.05'/></geometry></collision>";
const std::string kInertial =
    "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' iyz='0'/></inertial>";

std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                  const std::string& type = "revolute") {
  return "<joint name='" + name + "' type='" + type + "'><parent link='" + parent + "'/><child link='" + child +
         "'/><axis xyz='0 0 1'/><origin xyz='0 0 0.1'/><limit lower='-0.5' upper='1' effort='50' "
         "velocity='2'/></joint>";
}

// Two joints, two jaws.
std::string arm_urdf(const std::string& hand_inertial = kInertial) {
  return "<robot name='r'>" + link("base", kBox) + link("one", kBox + kInertial) + link("two", kBox + hand_inertial) +
         link("left", kBox + kInertial) + link("right", kBox + kInertial) + joint("j1", "base", "one") +
         joint("j2", "one", "two") + joint("l", "two", "left", "prismatic") + joint("r", "two", "right", "prismatic") +
         "</robot>";
}

std::string arm_lua(const std::string& changed = "", const std::string& to = "") {
  std::string text =
      "-- An arm.\nreturn robot {\n  urdf = \"arm.urdf\",\n  arm = { \"j1\", \"j2\" },\n  fingers = { \"l\", \"r\" "
      "},\n  pads = { \"left\", \"right\" },\n  tip = { link = \"two\", at = { 0, 0, 0.1 } },\n  home = { 0, 0 },\n}\n";
  if (!changed.empty()) text.replace(text.find(changed), changed.size(), to);
  return text;
}

}  // namespace

TEST_CASE("a task that is nested too deep names its file, to `check` and to `run`") {
  const Folder mine;
  put(mine, "tasks/deep.lua", "-- Deep.\nlocal x = " + std::string(5000, '(') + "\nreturn task {}\n");
  for (const Said& said : {check(mine, {"deep"}), check(mine), run_one(mine, "deep")}) {
    INFO(all(said));
    CHECK(said.code == kBadInput);
    CHECK(says(all(said), "tasks/deep.lua: C stack overflow\n    its brackets"));
  }
}

TEST_CASE("objects and robots are built by name, whether a task uses them or not") {
  const Folder mine;
  put(mine, "worlds/objects/empty.lua", thing("urdf = \"empty.urdf\""));
  put(mine, "worlds/objects/empty.urdf", "not a robot at all\n");
  put(mine, "worlds/objects/gone.lua", thing("urdf = \"gone.urdf\""));
  put(mine, "worlds/objects/gone.urdf",
      "<robot name='r'><link name='a'><collision><geometry><mesh filename='gone.stl'/></geometry></collision></link>"
      "</robot>");
  put(mine, "worlds/objects/negative.lua", thing("urdf = \"negative.urdf\""));
  put(mine, "worlds/objects/negative.urdf",
      "<robot name='r'><link name='a'>" + kBox +
          "<inertial><mass value='-1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>"
          "</robot>");
  put(mine, "worlds/robots/arm.lua", arm_lua());
  put(mine, "worlds/robots/arm.urdf", "not a robot at all\n");
  for (const Said& said : {check(mine, {"empty", "gone", "negative", "arm"}), check(mine)}) {
    INFO(all(said));
    CHECK(said.code == kBadInput);
    CHECK(says(said.out, "empty.urdf"));
    CHECK(says(said.out, "link 'a': mesh"));
    CHECK(says(said.out, "gone.stl: there is no such mesh file"));
    CHECK(says(said.out, "link 'a': its mass is negative"));
    CHECK(says(said.out, "arm.urdf"));
    CHECK(says(said.out, ", 4 mistakes"));
  }
  CHECK(check(mine, {"cube"}).code == kDone);  // what others got wrong is not its mistake
}

TEST_CASE("what a robot's file names and its URDF has not is said with line and cure") {
  const Folder mine;
  put(mine, "worlds/robots/arm.urdf", arm_urdf());
  put(mine, "worlds/robots/arm.lua", arm_lua());
  const Said sound = check(mine, {"arm"});
  INFO(all(sound));
  CHECK(sound.code == kDone);
  struct Case {
    std::string changed, to, line, told;
  };
  for (const Case& one : std::vector<Case>{
           {"\"j2\"", "\"j3\"", "4", "no link or joint 'j3'"},
           {"link = \"two\"", "link = \"too\"", "7", "no link or joint 'too'"},
           {"{ \"l\", \"r\" }", "{ \"l\", \"q\" }", "5", "no link or joint 'q'"},
           {"\"left\", \"right\"", "\"left\", \"write\"", "6", "no link or joint 'write'"},
           {"{ \"l\", \"r\" }", "{ \"j2\" }", "5", "two sliding joints, not 1"},
           {"{ \"l\", \"r\" }", "{ \"l\", \"j2\" }", "5", "finger 'j2' turns"},
           {"{ \"j1\", \"j2\" }", "{ \"j2\", \"j1\" }", "", "do not lie in order"},
           {"{ \"j1\", \"j2\" }", "{ \"j1\", \"l\" }", "", "is not a hinge"},
           {"home = { 0, 0 }", "home = { 0, 2 }", "8", "joint 2 is outside its limits"},
       }) {
    put(mine, "worlds/robots/arm.lua", arm_lua(one.changed, one.to));
    const Said said = check(mine, {"arm"});
    INFO(one.to << "\n" << all(said));
    CHECK(said.code == kBadInput);
    CHECK(says(said.out, "worlds/robots/arm.lua" + (one.line.empty() ? "" : ":" + one.line)));
    CHECK(says(said.out, one.told));
  }
}

TEST_CASE("a robot without fingers is sound, and nothing held is asked of it") {
  const Folder mine;
  put(mine, "worlds/robots/arm.urdf", arm_urdf());
  put(mine, "worlds/robots/arm.lua", arm_lua("  fingers = { \"l\", \"r\" },\n  pads = { \"left\", \"right\" },\n", ""));
  put(mine, "worlds/cell.lua",
      "-- A cell.\nreturn world {\n  robot = { \"arm\" },\n  fixtures = { table = { \"work_table\" } },\n}\n");
  put_task(mine, "move", "is.on(\"b\", \"table\")", "cube", "cell");
  CHECK(check(mine, {"arm"}).code == kDone);
  CHECK(check(mine, {"move"}).code == kDone);
  put_task(mine, "take", "is.holding(\"b\")", "cube", "cell");
  const Said said = check(mine, {"take"});
  INFO(all(said));
  CHECK(said.code == kBadInput);
  CHECK(says(said.out,
             "tasks/take.lua:6: goal: it asks for something held, and the robot 'arm' has no fingers\n"
             "    fingers = { \"left\", \"right\" } in worlds/robots/arm.lua, or another goal"));
}

TEST_CASE("what a world mounts on its robot is there, whether a task uses the world or not") {
  const Folder mine;
  put(mine, "worlds/robots/arm.urdf", arm_urdf());
  put(mine, "worlds/robots/arm.lua", arm_lua());
  const auto world = [&](const std::string& more) {
    put(mine, "worlds/cell.lua",
        "-- A cell.\nreturn world {\n  robot = { \"arm\" },\n  fixtures = { table = { \"work_table\" } },\n  " + more +
            "\n}\n");
    return check(mine, {"cell"});
  };
  CHECK(world("").code == kDone);
  const Said camera = world("cameras = { eye = { mount = \"robot.nose\", at = { 0, 0, 0 } } },");
  INFO(all(camera));
  CHECK(camera.code == kBadInput);
  CHECK(says(camera.out, "worlds/cell.lua:5: cameras.eye.mount: the robot has no link 'nose'"));
  const Said sensor = world("sensors = { touch = { \"force_torque\", on = \"robot.toe\" } },");
  INFO(all(sensor));
  CHECK(sensor.code == kBadInput);
  CHECK(says(sensor.out, "the robot has no link 'toe'"));
}

TEST_CASE("every variation is built: a mistake of the last one is found") {
  const Folder mine;
  put(mine, "worlds/objects/flat.lua", thing("mass = 0.1, shape = mesh { \"flat.obj\", scale = 0.001 }"));
  put(mine, "worlds/objects/flat.obj", "v 0 0 0\nv 40 0 0\nv 0 40 0\nf 1 3 2\n");
  put(mine, "tasks/late.lua",
      "-- Take it.\nreturn task {\n  world = \"tabletop\",\n  variations = { kind = { \"cube\", \"mug\", \"tin\", "
      "\"flat\" } },\n  objects = function(v) return { b = { v.kind } } end,\n  init = { is.on(\"b\", \"table\") },\n"
      "  goal = is.holding(\"b\"),\n  instructions = { \"take the {kind}\" },\n}\n");
  const Said said = check(mine, {"late"});
  INFO(all(said));
  CHECK(said.code == kBadInput);
  CHECK(says(said.out, "worlds/objects/flat.lua:4: shape:"));
  CHECK(says(said.out, "is flat"));
}

TEST_CASE("mistakes of a task's own predicate and skill are its own, other tasks run without them") {
  const Folder mine;
  put_task(mine, "heap", "is.heaped(\"b\")");
  put_task(mine, "take");
  put(mine, "worlds/predicates/heaped.lua",
      "-- Heaped.\nreturn predicate {\n  params = { \"obj: mvable\" },\n  label = \"the {obj} is heaped\",\n"
      "  holds = function(w, obj) return false end,\n}\n");
  put(mine, "skills/heap_up.lua",
      "-- Heap it up.\nreturn skill {\n  params = { \"obj: movable\" },\n  effect = { is.heaped(\"obj\") },\n"
      "  label = \"heap the {obj} up\",\n  run = function(robot p, c) end,\n}\n");
  for (const Said& said : {check(mine, {"heap"}), run_one(mine, "heap")}) {
    INFO(all(said));
    CHECK(said.code == kBadInput);
    CHECK(says(all(said), "worlds/predicates/heaped.lua:3"));
  }
  CHECK(says(check(mine, {"heap"}).out, "skills/heap_up.lua:6"));  // nothing else could heap
  CHECK(says(check(mine).out, "skills/heap_up.lua:6"));
  const Said sound = check(mine, {"take"});
  INFO(all(sound));
  CHECK(sound.code == kDone);
  const Said ran = run_one(mine, "take");
  INFO(all(ran));
  CHECK(ran.code == kDone);
  CHECK(says(ran.err, "skills/heap_up.lua has mistakes, so nothing here uses it; `stampede check heap_up`"));

  put(mine, "skills/pick.lua", "-- Take it.\nreturn skill {\n");  // stands in the place of everybody's
  CHECK(run_one(mine, "take").code == kBadInput);
}

TEST_CASE("only what a task uses must be right: a broken file beside it is told, and does not stop it") {
  const auto beside = [](const std::string& name, const std::string& text) {
    const Folder mine;
    put_task(mine, "take");
    put(mine, name, text);
    for (const Said& said : {check(mine, {"take"}), run_one(mine, "take")}) {
      INFO(name << "\n" << all(said));
      CHECK(said.code == kDone);
      CHECK(says(said.err, name + " has mistakes, so nothing here uses it"));
    }
  };
  beside("worlds/objects/mug.lua", "-- In the place of everybody's.\nreturn object { type = \"mgu\" }\n");
  beside("worlds/objects/own.lua", "-- Mine.\nreturn object {\n");
  beside("worlds/lib/own.lua", "return {\n");
  const Folder mine;
  put_task(mine, "take");
  put(mine, "tasks/picture.lua", "\xff\xfe no text");
  std::filesystem::create_symlink(kRoot + std::string("/README.md"), mine / "tasks/linked.lua");
  CHECK(check(mine, {"take"}).code == kDone);
  CHECK(run_one(mine, "take").code == kDone);
  const Said both = check(mine);
  CHECK(says(both.out, "tasks/linked.lua: a link that leads out of its root"));
  CHECK(says(both.out, "tasks/picture.lua:1: this is UTF-16, no UTF-8"));
}

TEST_CASE(
    "a skill that could take the library's place in any plan is remarked on, also beside a task that does not name "
    "it") {
  const Folder mine;
  put_task(mine, "take");
  const auto grab = [&](const std::string& type) {
    put(mine, "skills/grab.lua",
        "-- Grab it.\nreturn skill {\n  params = { \"obj: " + type + "\" },\n  precondition = { is.hand_empty() },\n" +
            "  effect = { is.holding(\"obj\"), is.lifted(\"obj\"), is_not.hand_empty() },\n  label = \"grab the "
            "{obj}\",\n" +
            "  run = function(robot, p, c) robot:close_hand(p.obj) end,\n}\n");
    return check(mine, {"take"});
  };
  const Said said = grab("movable");
  INFO(all(said));
  CHECK(said.code == kDone);
  CHECK(says(said.err, "skills/grab.lua:4: precondition: 'grab' may be done wherever 'pick' may"));
  CHECK_FALSE(says(grab("cup").err, "'grab'"));
}

TEST_CASE("`check` of a task refuses what `run` refuses: what all share, and what stands in the place of others") {
  const auto both = [](const std::string& name, const std::string& text, const std::string& told,
                       const std::string& object = "cube") {
    const Folder mine;
    put_task(mine, "take", "is.holding(\"b\")", object);
    put(mine, name, text);
    for (const Said& said : {check(mine, {"take"}), run_one(mine, "take")}) {
      INFO(name << "\n" << all(said));
      CHECK(said.code == kBadInput);
      CHECK(says(all(said), told));
      CHECK(says(all(said), "1 mistake"));
    }
  };
  both("worlds/types.lua", "-- Mine.\nreturn { types = { own = { parent = \"nope\" } } }\n",
       "/worlds/types.lua:2: types.own: its parent 'nope' is not a type");
  both("worlds/colours.lua", "-- Mine.\nreturn { own = \n", "/worlds/colours.lua:3: unexpected symbol");
  both("worlds/colours.lua", "-- Mine.\nreturn 7\n",
       "/worlds/colours.lua:1: it returns a number, not a table of colours by name");
  both("worlds/objects/mug.lua", "-- A mug.\nreturn object {\n", "worlds/objects/mug.lua:3: unexpected symbol", "mug");
  both("skills/pick.lua", "-- Take it.\nreturn skill {\n", "skills/pick.lua:3: unexpected symbol");
}

TEST_CASE("inertias that no body has are put right with a remark, whatever the body") {
  const Folder mine;
  put(mine, "worlds/robots/arm.urdf",
      arm_urdf("<inertial><mass value='0.5'/><inertia ixx='0' iyy='0' izz='0' ixy='0' ixz='0' iyz='0'/></inertial>"));
  put(mine, "worlds/robots/arm.lua", arm_lua());
  const Said robot = check(mine, {"arm"});
  INFO(all(robot));
  CHECK(robot.code == kDone);
  CHECK(says(robot.err, "link 'two': no solid has its inertia: it is worked out from its 0.5 kg and its shapes"));

  put_task(mine, "take", "is.holding(\"b\")", "thing");
  put(mine, "worlds/objects/thing.lua", thing("urdf = \"thing.urdf\""));
  put(mine, "worlds/objects/thing.urdf",
      "<robot name='r'><link name='a'>" + kBox + "<inertial><mass value='0'/></inertial></link></robot>");
  for (const Said& said : {check(mine, {"thing"}), check(mine, {"take"}), run_one(mine, "take")}) {
    INFO(all(said));
    CHECK(said.code == kDone);
    CHECK(says(said.err, "link 'a': it moves and has no mass: 0.0625 kg are taken, from its shapes at 500 kg/m3"));
  }
  put(mine, "worlds/objects/thing.urdf",
      "<robot name='r'><link name='a'>" + kBox +
          "<inertial><mass value='0.1'/><inertia ixx='1' iyy='1' izz='0' ixy='0' ixz='0' iyz='0'/></inertial></link>"
          "<link name='b'>" +
          kBox +
          "<inertial><mass value='0.1'/></inertial></link>"
          "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
  const Said moving = check(mine, {"thing"});
  INFO(all(moving));
  for (const char* link : {"a", "b"})
    CHECK(says(moving.err, "link '" + std::string(link) +
                               "': no solid has its inertia: it is worked out from its 0.1 kg and its shapes"));
  CHECK_FALSE(says(all(moving), "cannot move"));
  put(mine, "worlds/objects/thing.lua", thing("urdf = \"thing.urdf\", fixed = true"));
  CHECK(says(check(mine, {"thing"}).err, "cannot move"));
}

TEST_CASE("what is in millimetres is said at once, with its sizes") {
  const Folder mine;
  put(mine, "worlds/objects/m.obj", kHugeTetrahedron);
  put_task(mine, "take", "is.holding(\"b\")", "thing");
  const auto both = [&](const std::string& fields) {
    put(mine, "worlds/objects/thing.lua", thing(fields));
    const Said said = check(mine, {"take"});
    CHECK((run_one(mine, "take").code == kBadInput) == (said.code == kBadInput));
    return said;
  };
  const Said large = both("mass = 0.1, shape = mesh { \"m.obj\" }");
  INFO(all(large));
  CHECK(large.code == kBadInput);
  CHECK(says(large.out, "it is 40 x 40 x 40 m: too large to be moved"));
  CHECK(says(large.out, "scale = 0.001"));
  const Said small = both("mass = 0.1, shape = mesh { \"m.obj\", scale = 0.000001 }");
  INFO(all(small));
  CHECK(small.code == kBadInput);
  CHECK(says(small.out, "too small for a scene"));
  CHECK(both("mass = 0.1, shape = mesh { \"m.obj\", scale = 0.001 }").code == kDone);
}

}  // namespace stampede::program
