// Every mistake is named with file, line, field and cure. Each test changes one line of a sound root.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "scripting/library/library.h"

using namespace stampede;
namespace fs = std::filesystem;

namespace {

using Files = std::map<std::string, std::string>;

Files sound_files() {
  return {
      {"worlds/types.lua",
       "-- Types.\nreturn {\n  types = { thing = {}, cube = { parent = \"thing\" }, fixture = {} },\n"
       "  traits = { movable = \"m\", surface = \"s\", openable = \"o\" },\n}\n"},
      {"worlds/colours.lua", "-- Colours.\nreturn { red = { 1, 0, 0 }, blue = { 0, 0, 1 } }\n"},
      {"worlds/robots/panda.lua",
       "-- Arm.\nreturn robot { urdf = \"panda.urdf\", arm = { \"joint1\" }, tip = { part = \"hand\" }, home = { 0 } "
       "}\n"},
      {"worlds/lab.lua",
       "-- A lab.\nreturn world {\n  robot = { \"panda\" },\n  fixtures = { table = { \"desk\" } },\n}\n"},
      {"worlds/objects/desk.lua",
       "-- A desk.\nreturn object { type = \"fixture\", traits = { \"surface\" }, shape = box { 1, 1, 0.1 } }\n"},
      {"worlds/objects/cube.lua",
       "-- A cube.\nreturn object { type = \"cube\", traits = { \"movable\" }, shape = box { 0.1, 0.1, 0.1 }, mass = "
       "0.1 }\n"},
      {"worlds/predicates/on.lua",
       "-- Rests.\nreturn predicate {\n  params = { \"obj: movable\", \"surface: surface\" },\n"
       "  label = \"the {obj} is on the {surface}\",\n  holds = function(w, a, b) return true end,\n"
       "  sample = function(w, a, b, rng) return {} end,\n}\n"},
      {"worlds/predicates/holding.lua",
       "-- Held.\nreturn predicate {\n  params = { \"hand: hand\", \"obj: movable\" },\n"
       "  label = \"holds the {obj}\",\n  holds = function(w, h, a) return true end,\n}\n"},
      {"worlds/predicates/clear.lua",
       "-- Free.\nreturn predicate {\n  params = { \"x: movable\" },\n  label = \"clear {x}\",\n"
       "  derived = is_not(exists(\"?y: movable\", is.on(\"?y\", \"x\"))),\n}\n"},
      {"skills/pick.lua",
       "-- Take.\nreturn skill {\n  params = { \"obj: movable\", \"from: surface\" },\n"
       "  precondition = { is.on(\"obj\", \"from\") },\n  effect = { is.holding(\"obj\"), is_not.on(\"obj\", \"from\") "
       "},\n"
       "  continuous = { spot = stream(\"sample\", is.on(\"obj\", \"from\")) },\n"
       "  label = \"take the {obj}\",\n  run = function(robot, p, c) end,\n}\n"},
      {"tasks/take.lua",
       "-- Take a cube.\nreturn task {\n  world = \"lab\",\n  variations = { n = { 1, 2 }, colour = colours.names },\n"
       "  objects = { block = { \"cube\", count = 2 }, lone = { \"cube\" } },\n"
       "  init = { is.on(\"block*\", \"table\"), is.on(\"lone\", \"table\") },\n"
       "  goal = is.holding(\"lone\"),\n  instructions = { \"take {n} {colour}\" },\n}\n"},
  };
}

// A folder of these files, gone at the end.
class Root {
 public:
  explicit Root(const Files& files) {
    std::string folder = (fs::temp_directory_path() / "stampede_library_XXXXXX").string();  // tests run side by side
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = folder;
    for (const auto& [name, text] : files) {
      fs::create_directories((path_ / name).parent_path());
      std::ofstream(path_ / name) << text;
    }
  }
  ~Root() { fs::remove_all(path_); }
  Root(const Root&) = delete;
  Root& operator=(const Root&) = delete;
  std::string complaints() const {
    std::vector<Error> errors;
    Library::check({{path_}}, errors);
    std::string text;
    for (const Error& error : errors) text += std::string(error.what()) + "\n";
    return text;
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

// What is said when `from` becomes `to` in one of the files (which must have it).
std::string said(const std::string& file, const std::string& from, const std::string& to) {
  Files files = sound_files();
  std::string& text = files[file];
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  text.replace(at, from.size(), to);
  return Root(files).complaints();
}

}  // namespace

TEST_CASE("a file is read as if it were the only one: what others did to lists and modules is not seen") {
  Files files = sound_files();
  files["worlds/lib/sizes.lua"] = "-- Sizes.\nreturn { wide = 0.1 }\n";
  for (const char* name : {"first", "second"})
    files[std::string("tasks/") + name + ".lua"] =
        "-- It looks at what it is given, and changes it.\nlocal sizes = require(\"worlds.lib.sizes\")\n"
        "assert(sizes.wide == 0.1 and #colours.names == 2, \"somebody was here\")\n"
        "sizes.wide = 9\ntable.remove(colours.names)\n"
        "return task {\n  world = \"lab\",\n  objects = { one = { \"cube\" } },\n"
        "  init = { is.on(\"one\", \"table\") },\n  goal = is.holding(\"one\"),\n  instructions = { \"take\" },\n}\n";
  CHECK(Root(files).complaints().empty());
}

TEST_CASE("the sound root has no complaints") { CHECK(Root(sound_files()).complaints().empty()); }

TEST_CASE("what a step sets is one of the skill's parameters, within its bounds") {
  const auto steps = [](const std::string& call) {
    return said("tasks/take.lua", "  goal", "  steps = { " + call + " },\n  goal");
  };
  CHECK(steps("act.pick(\"lone\", \"table\", { spot = { 0, 0, 1, 0, 0, 0, 1 } })").empty());
  CHECK(steps("act.pick { \"lone\", controller = \"joint_impedance\" }").empty());
  const std::string unknown = steps("act.pick(\"lone\", { spt = 1 })");
  CHECK(unknown.find("tasks/take.lua:7: steps: skill 'pick' has no continuous parameter 'spt'") == 0);
  CHECK(unknown.find("did you mean 'spot'?") != std::string::npos);
  CHECK(steps("act.pick(\"lone\", { spot = 1 })").find("pick.spot has 7 values, not 1") != std::string::npos);
  CHECK(steps("act.pick(\"lone\", { controller = \"magic\" })").find("no controller 'magic'") != std::string::npos);
}

TEST_CASE("golden: fields") {
  CHECK(said("tasks/take.lua", "  objects =", "  object =")
            .find("tasks/take.lua:5: object: a task has no field 'object'\n    did you mean 'objects'?\n") == 0);
  CHECK(
      said("tasks/take.lua", "count = 2", "cuont = 2")
          .find("tasks/take.lua:5: objects.block.cuont: an entry has no field 'cuont'\n    did you mean 'count'?\n") ==
      0);
  CHECK(said("tasks/take.lua", "world = \"lab\"", "world = 7") ==
        "tasks/take.lua:3: world: expects text, this is the number 7\n    such as world = \"kitchen\"\n");
  CHECK(said("skills/pick.lua", "  label = \"take the {obj}\",\n", "") ==
        "skills/pick.lua:2: label: a skill needs the field 'label': what it does in words, with {params}\n"
        "    such as label = \"pick up the {obj}\"\n");
}

TEST_CASE("a number may be drawn, and what is none is one complaint with its place") {
  const auto initial = [](const std::string& value) {
    return said("worlds/objects/desk.lua", "shape =",
                "parts = { flap = { shape = box { 0.1, 0.1, 0.1 }, mass = 1, hinge = { range = { 1, 2 }, initial = " +
                    value + " } } }, shape =");
  };
  const auto opening = [](const std::string& value) {
    return said("worlds/robots/panda.lua", "home =", "opening = " + value + ", home =");
  };
  CHECK(initial("between(1, 2)").empty());
  CHECK(opening("between(0.1, 0.2)").empty());
  CHECK(initial("0.5").find("worlds/objects/desk.lua:2: parts.flap.hinge.initial: the position at the start") == 0);
  const std::string wrong = initial("\"far\"");
  INFO(wrong);
  CHECK(wrong.find("worlds/objects/desk.lua:2: parts.flap.hinge.initial: expects number, this is") == 0);
  CHECK(std::count(wrong.begin(), wrong.end(), '\n') <= 2);
  CHECK(opening("\"wide\"").find("worlds/robots/panda.lua:2: opening: expects number, this is") == 0);
}

TEST_CASE("each root's types count, and its colours, however many roots there are") {
  const auto more = [](const std::string& type, const std::string& colour) {
    return Files{{"worlds/types.lua", "-- Types.\nreturn { types = { " + type + " = { parent = \"thing\" } } }\n"},
                 {"worlds/colours.lua", "-- Colours.\nreturn { " + colour + " = { 1, 1, 0 } }\n"}};
  };
  Files tasks = more("cone", "mauve");
  tasks["worlds/objects/hat.lua"] =
      "-- A hat.\nreturn object { type = \"cone\", traits = { \"movable\" }, shape = box { 0.1, 0.1, 0.1 }, mass = "
      "0.1, colour = \"mauve\" }\n";
  const Root first(sound_files()), second(more("orb", "plum")), third(tasks);
  std::vector<Error> errors;
  const auto library = Library::check({{first.path(), second.path(), third.path()}}, errors);
  for (const Error& error : errors) UNSCOPED_INFO(error.what());
  CHECK(errors.empty());
  CHECK(library->domain().types.contains("orb"));
  CHECK(library->domain().types.contains("cone"));
}

TEST_CASE("golden: how an episode starts") {
  const std::string only = said("worlds/predicates/on.lua", "  sample", "  start_only = true,\n  sample");
  INFO(only);
  CHECK(only.find("tasks/take.lua") == std::string::npos);  // its init may name it
  CHECK(only.find("skills/pick.lua:4: precondition: 'on' is only asked of starts and is no fact\n"
                  "    name it in init, or take start_only out of its file") != std::string::npos);
  CHECK(only.find("worlds/predicates/clear.lua") != std::string::npos);
  CHECK(said("worlds/predicates/holding.lua", "  holds", "  start_only = true, static = true,\n  holds")
            .find("static: a predicate that is only asked of starts has no 'static'\n"
                  "    leave it out, or leave start_only out") != std::string::npos);
  CHECK(said("worlds/lab.lua", "{ \"panda\" }", "{ \"panda\", joints = { joint1 = between(0, 1), jiont = 1 } }") ==
        "worlds/lab.lua:3: robot.joints: the arm has no joint 'jiont'\n    did you mean 'joint1'?\n");
  CHECK(said("worlds/lab.lua", "{ \"panda\" }", "{ \"panda\", joints = { joint1 = \"far\" } }")
            .find("robot.joints.joint1: expects a number, this is") != std::string::npos);
  const std::string place =
      "{ \"cube\", place = one_of { { at = { 0, 0, 1 }, yaw = between(0, 1) }, { att = { 1, 0, 1 } } } }";
  CHECK(said("tasks/take.lua", "lone = { \"cube\" }", "lone = " + place)
            .find("objects.lone.place.att: a place has no field 'att'\n    did you mean 'at'?") != std::string::npos);
}

TEST_CASE("golden: names") {
  CHECK(said("worlds/predicates/on.lua", "obj: movable", "obj: movible") ==
        "worlds/predicates/on.lua:3: params: 'movible' is neither a type nor a trait\n    did you mean 'movable'?\n");
  Files files = sound_files();
  files["worlds/predicates/forall.lua"] = files["worlds/predicates/holding.lua"];
  files["worlds/predicates/Is-Big.lua"] = files["worlds/predicates/holding.lua"];
  files["worlds/predicates/surface.lua"] = files["worlds/predicates/holding.lua"];
  const std::string text = Root(files).complaints();
  CHECK(text.find("worlds/predicates/forall.lua: the name 'forall' is a reserved word of Lua or PDDL\n"
                  "    rename the file, to forall_it.lua for example") != std::string::npos);
  CHECK(text.find("the name 'Is-Big' does not start with a letter a-z\n    rename the file, to is_big.lua") !=
        std::string::npos);
  CHECK(text.find("worlds/predicates/surface.lua:2: 'surface' is already a type or trait of worlds/types.lua\n"
                  "    rename the file, to surface_2.lua") != std::string::npos);
  CHECK(said("tasks/take.lua", "lone =", "table =").find("objects.table: the name 'table' is used twice") !=
        std::string::npos);
  CHECK(said("tasks/take.lua", "lone =", "block1 =").find("is used twice") != std::string::npos);
  CHECK(said("tasks/take.lua", "{ \"cube\" }", "{ \"cub\" }") ==  // and nothing about what a cub cannot do
        "tasks/take.lua:5: objects.lone: there is no object 'cub'\n    did you mean 'cube'?\n");
  CHECK(said("worlds/objects/cube.lua", "\"cube\"", "\"cubes\"")
            .find("type: there is no type 'cubes'\n    did you mean 'cube'?") != std::string::npos);
  CHECK(said("worlds/objects/cube.lua", "\"movable\"", "\"movble\"")
            .find("there is no trait 'movble'\n    did you mean 'movable'?") != std::string::npos);
  const std::string parts =
      said("tasks/take.lua", "  goal =", "  subgoals = { { \"it\", is.holding(\"lon\"), \"take {m}\" } },\n  goal =");
  INFO(parts);
  CHECK(parts.find("subgoals: there is no axis 'm'\n    did you mean 'n'?") != std::string::npos);
  CHECK(parts.find("'lon'") != std::string::npos);
  CHECK(said("tasks/take.lua", "  goal =", "  subgoals = { { \"two words\", is.holding(\"lone\") } },\n  goal =") ==
        "");
  CHECK(said("tasks/take.lua", "{n}", "{m}").find("instructions: there is no axis 'm'\n    did you mean 'n'?") !=
        std::string::npos);
}

TEST_CASE("golden: how a world is seen") {
  const auto lab = [](const std::string& fields) {
    return said("worlds/lab.lua", "  fixtures =", "  " + fields + ",\n  fixtures =");
  };
  const auto has = [](const std::string& text, const std::string& part) {
    INFO(text << "lacks\n" << part);
    return text.find(part) != std::string::npos;
  };
  CHECK(lab("cameras = { front = { at = { 1, 0, 1 }, look_at = \"tabel\" } }") ==
        "worlds/lab.lua:4: cameras.front.look_at: there is no object 'tabel'\n    did you mean 'table'?\n");
  CHECK(lab("cameras = { front = { at = { 1, 0, 1 }, mount = \"tabel\" } }") ==
        "worlds/lab.lua:4: cameras.front.mount: there is no object or link 'tabel'\n    did you mean 'table'?\n");
  CHECK(lab("cameras = { front = { at = { 1, 0, 1 }, mount = \"robot.link5\" } }").empty());  // links: by the URDF
  CHECK(lab("cameras = { front = { at = { 1, 0, 1 }, size = { 0, 128 } } }") ==
        "worlds/lab.lua:4: cameras.front.size: a picture has 1 to 4096 whole pixels a side\n    size = { 128, 128 "
        "}\n");
  CHECK(has(lab("cameras = { front = { at = { 1, 0, 1 }, size = { 5000, 128 } } }"), "1 to 4096"));
  CHECK(has(lab("cameras = { front = { at = { 1, 0, 1 }, fov = 4 } }"), "front.fov: a field of view lies between"));
  CHECK(has(lab("cameras = { front = { at = { 1, 0, 1 }, near = 5 } }"), "front.near: near must be above 0"));
  CHECK(has(lab("cameras = { front = { at = { 1, 0, 1 }, focal = { 0, 1 } } }"), "front.focal: expects two numbers"));
  CHECK(has(lab("cameras = { front = { at = { 1, 0, 1 }, focl = { 1, 1 } } }"), "did you mean 'focal'?"));
  CHECK(lab("sensors = { wrench = { \"force_torqe\" } }") ==
        "worlds/lab.lua:4: sensors.wrench: there is no sensor of kind 'force_torqe'\n    did you mean "
        "'force_torque'?\n");
  CHECK(lab("sensors = { wrench = { \"force_torque\", rate = 50 } }") ==
        "worlds/lab.lua:4: sensors.wrench.rate: 50 Hz does not divide 240 Hz\n    these do: 1 2 3 4 5 6 8 10 12 15 16 "
        "20 24 30 40 48 60 80 120 240\n");
  CHECK(has(lab("sensors = { t = { \"joint_torque\", on = \"robot.hand\" } }"), "is of all joints of the arm"));
  CHECK(has(lab("sensors = { margins = { \"joint_torque\" } }"), "the signed margins of facts are called so"));
  CHECK(lab("light = { ambiant = 0.5 }") ==
        "worlds/lab.lua:4: light.ambiant: a light has no field 'ambiant'\n    did you mean 'ambient'?\n");
  CHECK(lab("motion = { planner = \"ompl:RRT*\" }") ==
        "worlds/lab.lua:4: motion.planner: there is no motion planner 'ompl:RRT*'\n    did you mean 'ompl:RRT'?\n");
  CHECK(has(lab("motion = { planner = \"ompl:CForest\" }"), "not offered: it runs in several threads"));
  CHECK(lab("motion = { planner = \"ompl:RRTstar\" }").empty());
  CHECK(has(lab("light = { direction = { 0, 0, 0 } }"), "light.direction: has no length"));
  CHECK(has(lab("light = { diffuse = -1 }"), "is not negative"));
  CHECK(lab("randomise = { looks = { \"dsk\" } }") ==
        "worlds/lab.lua:4: randomise.looks: there is no object 'dsk'\n    did you mean 'desk'?\n");
  CHECK(lab("randomise = { looks = { \"*\", \"robot\", \"table\", \"cube\" }, colours = colours.names }").empty());
  CHECK(has(lab("randomise = { textures = { \"chequer\" } }"), "there is no kind of texture 'chequer'"));
  CHECK(has(lab("randomise = { colours = { \"rad\" } }"), "there is no colour 'rad'\n    did you mean 'red'?"));
  CHECK(has(lab("randomise = { mass = { 2, 1 } }"), "randomise.mass: its lower end lies above its upper"));
  CHECK(has(lab("randomise = { mass = { 0, 1 } }"), "randomise.mass: must be above 0"));
  CHECK(has(lab("randomise = { camera_position = -1 }"), "randomise.camera_position: is negative"));
  CHECK(lab("observe = { images = \"al\" }") ==
        "worlds/lab.lua:4: observe.images: there is no choice of frames 'al'\n    did you mean 'all'?\n");
  CHECK(
      has(lab("observe = { kinds = { \"dept\" } }"), "there is no kind of picture 'dept'\n    did you mean 'depth'?"));
  CHECK(has(lab("observe = { kinds = { \"points\" } }"), "points = true"));
  CHECK(has(lab("observe = { noise = { rbg = 1 } }"), "did you mean 'rgb'?"));
  CHECK(has(lab("observe = { noise = { rgb = -1 } }"), "a standard deviation is not negative"));
  CHECK(has(lab("observe = { channels = { \"wrench\" } }"), "there is no sensor 'wrench'"));
  CHECK(has(lab("observe = { channels = { \"margin\" } }"), "did you mean 'margins'?"));
  CHECK(lab("observe = { channels = { \"*\", \"margins\" } }").empty());
  CHECK(has(said("tasks/take.lua", "  goal", "  observe = { cameras = { \"front\" } },\n  goal"),
            "tasks/take.lua:7: observe.cameras: there is no camera 'front'"));
}

TEST_CASE("golden: looks of objects") {
  const auto cube = [](const std::string& fields) {
    return said("worlds/objects/cube.lua", "mass = ", fields + ", mass = ");
  };
  CHECK(cube("texture = checker { \"red\", \"blue\", size = 0.1 }").empty());
  const std::string beside = "'\n    it is looked for beside this file\n";
  CHECK(cube("texture = texture { \"wood.png\" }") ==
        "worlds/objects/cube.lua:2: texture: there is no picture 'wood.png" + beside);
  CHECK(cube("visual = { box { 1, 1, 1 }, mesh { \"a.obj\" } }") ==
        "worlds/objects/cube.lua:2: visual: there is no mesh 'a.obj" + beside);
  CHECK(
      cube("texture = \"wood\"") ==
      "worlds/objects/cube.lua:2: texture: expects texture such as checker { \"white\", \"black\" }, this is the text "
      "\"wood\"\n    such as texture = checker { \"white\", \"black\", size = 0.1 }\n");
  CHECK(cube("texture = stripes { sise = 0.1 }").find("a texture has no field 'sise'\n    did you mean 'size'?") !=
        std::string::npos);
}

TEST_CASE("golden: types") {
  CHECK(said("worlds/types.lua", "thing = {}", "thing = { parent = \"cube\" }")
            .find("worlds/types.lua:3: types.cube: a cycle of types: cube < thing < cube\n    every type ends at "
                  "object\n") == 0);
  CHECK(said("worlds/types.lua", "parent = \"thing\"", "parent = \"thin\"")
            .find("its parent 'thin' is not a type\n    did you mean 'thing'?") != std::string::npos);
}

TEST_CASE("golden: formulas") {
  const char* goal = "is.holding(\"lone\")";
  CHECK(said("tasks/take.lua", goal, "is.holdng(\"lone\")") ==
        "tasks/take.lua:7: goal: there is no predicate 'holdng'\n    did you mean 'holding'?\n");
  CHECK(said("tasks/take.lua", goal, "is.holding(\"loan\")") ==
        "tasks/take.lua:7: goal: there is no object 'loan'\n    did you mean 'lone'?\n");
  CHECK(said("tasks/take.lua", goal, "is.on(\"lone\")") ==
        "tasks/take.lua:7: goal: on takes 2 arguments, not 1\n    write is.on(obj, surface)\n");
  CHECK(said("tasks/take.lua", goal, "is.on(\"?x\", \"table\")").find("goal: unknown variable '?x'") !=
        std::string::npos);
  CHECK(said("tasks/take.lua", goal, "is.holding(\"block\")")
            .find("'block' is a group: write \"block*\" or \"block1\"") != std::string::npos);
  CHECK(said("tasks/take.lua", goal, "is.holding(\"lone*\")").find("'lone' is one object: give it count = n") !=
        std::string::npos);
  CHECK(said("tasks/take.lua", goal, "any_of(is.on(\"block*\", \"table\"), is.holding(\"lone\"))")
            .find("the group 'block*' stands for all its members, which any_of and exists cannot mean") !=
        std::string::npos);
  CHECK(said("tasks/take.lua", goal, "exists(\"?x: cube\", exists(\"?x: cube\", is.holding(\"?x\")))")
            .find("goal: the variable '?x' shadows another of that name\n    rename it") != std::string::npos);
  CHECK(said("tasks/take.lua", goal, "is.on(\"lone\", \"block1\")")
            .find("is.on: 'block1' has not the trait 'surface', which the surface must have") != std::string::npos);
  CHECK(said("tasks/take.lua", goal, "any_order(\"block*\", 3, function(b, i) return is.holding(b[i]) end)")
            .find("any_order chooses 3 of the 2 members of 'block*'") != std::string::npos);
  CHECK(said("tasks/take.lua", goal, "at_least(3, \"block*\", function(x) return is.holding(x) end)")
            .find("at_least asks for 3 of the 2 members of 'block*'\n    make the group larger: count = 3") !=
        std::string::npos);
  CHECK(said("tasks/take.lua", goal, "at_least(\"block*\", 1, is.holding(\"lone\"))")
            .find("at_least takes a whole number, a group and a function") != std::string::npos);
  // What is said of a group's members says nothing where there are none, however it is said; a start may have none.
  for (const char* test : {"is.holding(\"block*\")", "forall(\"?x: block*\", is.holding(\"?x\"))",
                           "at_least(1, \"block*\", function(x) return is.holding(x) end)"}) {
    Files empty = sound_files();
    std::string& take = empty["tasks/take.lua"];
    take.replace(take.find("count = 2"), 9, "count = 0");
    CHECK(Root(empty).complaints().empty());
    take.replace(take.find("is.holding(\"lone\")"), 18, test);
    CHECK(Root(empty).complaints().find(
              "tasks/take.lua:7: goal: the group 'block*' has no members, so what is asked of them says nothing\n"
              "    give it a count of at least 1, or leave the test out where there are none") != std::string::npos);
  }
  CHECK(said("tasks/take.lua", goal, "is.on(7, \"table\")") ==
        "tasks/take.lua:7: on: argument 1 is a number, arguments are names such as \"cup\" or \"?x\"\n    in "
        "tasks/take.lua:7: in main chunk\n");
  CHECK(said("skills/pick.lua", "is.on(\"obj\", \"from\") },\n  effect", "is.on(\"obj\", \"form\") },\n  effect")
            .find("skills/pick.lua:4: precondition: unknown parameter 'form'\n    did you mean 'from'?") == 0);
  CHECK(said("skills/pick.lua", "is_not.on(\"obj\", \"from\") }", "is.clear(\"obj\") }")
            .find("skills/pick.lua:5: effect: an effect cannot name the derived predicate 'clear'") == 0);
  CHECK(said("worlds/predicates/clear.lua", "is.on(\"?y\", \"x\")", "is.clear(\"?y\")")
            .find("derived: 'clear' depends on its own negation") != std::string::npos);
}

TEST_CASE("golden: no thing is related to itself, where that is asked for in any case") {
  const std::string goal = "is.holding(\"lone\")",
                    cure = "\n    no thing is related to itself or its own part: name another thing\n";
  Files files = sound_files();
  files["worlds/predicates/between.lua"] =
      "-- Amid.\nreturn predicate {\n  params = { \"obj: movable\", \"one\", \"other\" },\n"
      "  label = \"the {obj} is between\",\n  only_named = true,\n  made_by = { \"pick\" },\n"
      "  holds = function(w, a, b, c) return true end,\n}\n";
  const auto with = [&](const std::string& file, const std::string& from, const std::string& to) {
    Files changed = files;
    std::string& text = changed[file];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  CHECK(Root(files).complaints().empty());
  CHECK(with("tasks/take.lua", goal, "is.between(\"lone\", \"block1\", \"block2\")").empty());
  CHECK(with("tasks/take.lua", goal, "is.between(\"lone\", \"block1\", \"block1\")") ==
        "tasks/take.lua:7: there is no fact between of block1 and block1" + cure);
  CHECK(with("tasks/take.lua", goal, "{ is.holding(\"lone\"), is.between(\"lone\", \"lone\", \"block1\") }") ==
        "tasks/take.lua:7: there is no fact between of lone and lone" + cure);
  CHECK(
      with("tasks/take.lua", goal, "{ is.holding(\"lone\"), is_not.between(\"lone\", \"lone\", \"block1\") }").empty());
  CHECK(with("worlds/predicates/between.lua", "\"pick\"", "\"pik\"")
            .find("worlds/predicates/between.lua:6: made_by: there is no skill 'pik'\n    did you mean 'pick'?") == 0);
  CHECK(with("worlds/predicates/between.lua", "  holds = function(w, a, b, c) return true end",
             "  derived = is.clear(\"obj\")")
            .find("only_named: only a predicate whose `holds` is read all the time has it") != std::string::npos);
}

TEST_CASE("golden: tips of tools") {
  const std::string shape = "mass = 0.1 }";
  CHECK(said("worlds/objects/cube.lua", shape, "mass = 0.1, tip = { at = { 0, 0, -0.05 } } }").empty());
  CHECK(said("worlds/objects/cube.lua", shape, "mass = 0.1, tip = { pos = { 0, 0, -0.05 } } }")
            .find("worlds/objects/cube.lua:2: tip.pos: a tip has no field 'pos'") == 0);
  CHECK(said("worlds/objects/cube.lua", shape, "mass = 0.1, tip = {}, regions = { tip = { size = { 1, 1, 1 } } } }")
            .find("worlds/objects/cube.lua:2: tip: there is a region 'tip' too, and both are called OBJECT.tip\n"
                  "    rename the region") == 0);
}

TEST_CASE("golden: skills that extend or replace others") {
  Files files = sound_files();
  files["skills/wary.lua"] = "-- Wary.\nreturn skill { extends = \"pick\", precondition = { is.clear(\"obj\") } }\n";
  files["tasks/take.lua"].replace(files["tasks/take.lua"].find("  goal"), 6, "  skills = { \"wary\" },\n  goal");
  CHECK(Root(files).complaints().empty());
  const auto with = [&](const std::string& file, const std::string& from, const std::string& to) {
    Files changed = files;
    std::string& text = changed[file];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  CHECK(with("skills/wary.lua", "\"pick\"", "\"pik\"").find("skills/wary.lua: extends: there is no skill 'pik'") == 0);
  CHECK(with("skills/wary.lua", "\"pick\"", "\"wary\"").find("extends: 'wary' extends itself") != std::string::npos);
  CHECK(with("skills/wary.lua", "is.clear(\"obj\")", "is.clear(\"thing\")")
            .find("skills/wary.lua:2: precondition: unknown parameter 'thing'") == 0);
  CHECK(with("skills/wary.lua", "extends = \"pick\"", "extends = \"pick\", replaces = \"pick\"")
            .find("replaces: what extends a skill replaces that one") != std::string::npos);
  CHECK(with("skills/pick.lua", "  label", "  replaces = \"drop\",\n  label")
            .find("replaces: there is no other skill 'drop'") != std::string::npos);
  CHECK(with("tasks/take.lua", "{ \"wary\" }", "{ \"wry\" }")
            .find("tasks/take.lua:7: skills: there is no skill 'wry'\n    did you mean 'wary'?") == 0);
  CHECK(with("tasks/take.lua", "{ \"wary\" }", "{ \"pick\" }")
            .find("skills: 'pick' neither extends nor replaces another skill") != std::string::npos);
  CHECK(with("tasks/take.lua", "  goal", "  steps = { act.pick(\"lone\") },\n  goal")
            .find("steps: 'wary' takes the place of 'pick' here\n    write act.wary") != std::string::npos);
  CHECK(with("tasks/take.lua", "skills = { \"wary\" },\n  goal", "steps = { act.wary(\"lone\") },\n  goal")
            .find("steps: 'wary' is not among this task's skills\n    add skills = { \"wary\" }") != std::string::npos);
  CHECK(with("skills/pick.lua", "  label", "  moves = { \"ob\" },\n  label")
            .find("moves: there is no parameter 'ob'\n    did you mean 'obj'?") != std::string::npos);
  CHECK(said("worlds/predicates/on.lua", "  holds", "  ends_when = \"touched\",\n  holds")
            .find("ends_when: 'touched' is nothing that ends a fact\n    write \"moved\"") != std::string::npos);
  CHECK(said("worlds/predicates/clear.lua", "  derived", "  ends_when = \"moved\",\n  derived")
            .find("ends_when: only what holds by itself can end so") != std::string::npos);
}

TEST_CASE("golden: what scripts call and what does not exist") {
  const auto with = [](const std::string& file, const std::string& from, const std::string& to) {
    Files changed = sound_files();
    std::string& text = changed[file];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  const auto run = [&](const std::string& body) {
    return with("skills/pick.lua", "function(robot, p, c) end", "function(robot, p, c)\n    " + body + "\n  end");
  };
  CHECK(run("local w = robot:view() robot:lift(0.1) robot:move_to(c.spot, { about = p.obj, by = p.hand })").empty());
  CHECK(run("robot:lft(0.1)") == "skills/pick.lua:9: robot has no method 'lft'\n    did you mean 'lift'?\n");
  CHECK(run("robot:view():pos(p.obj)").empty());  // of what a call gives nothing is known
  CHECK(run("local w = robot:view() w:positon(p.obj)")
            .find("skills/pick.lua:9: w has no method 'positon'\n    did you mean 'position'?") == 0);
  CHECK(run("robot:lift(c.hight)")
            .find("skills/pick.lua:9: run: c.hight is nothing that the skill declares in continuous") == 0);
  CHECK(run("robot:wait(0.1) -- robot:lft(c.hight)").empty());
  CHECK(run("robot:close_hand(p.object)").find("run: p.object is nothing that the skill declares in params") !=
        std::string::npos);
  CHECK(run("local c = {} robot:wait(c.own)").empty());
  CHECK(run("robot:wait(other.c.own or 1)").empty());
  CHECK(with("worlds/predicates/on.lua", "return true", "return w:toching(a, b)")
            .find("worlds/predicates/on.lua:5: w has no method 'toching'\n    did you mean 'touching'?") == 0);
}

TEST_CASE("golden: angles in degrees, and things that stand nowhere") {
  const auto with = [](const std::string& to) {
    Files changed = sound_files();
    std::string& text = changed["tasks/take.lua"];
    const std::string from = "lone = { \"cube\" }";
    text.replace(text.find(from), from.size(), from + ", " + to);
    return Root(changed).complaints();
  };
  CHECK(with("side = { \"desk\", at = { 1, 0, 0 }, yaw = math.rad(90) }").empty());
  CHECK(with("side = { \"desk\", at = { 1, 0, 0 }, yaw = 90 }") ==
        "tasks/take.lua:5: objects.side.yaw: 90 rad are more than two turns\n    angles are in rad: deg(90)\n");
  CHECK(with("side = { \"desk\", at = { 1, 0, 0 }, rpy = { 0, 45, 0 } }").find("45 rad are more than two turns") !=
        std::string::npos);
  CHECK(with("side = { \"desk\" }") ==
        "tasks/take.lua:5: objects.side: nothing says where it is, and what does not move is not placed by init\n"
        "    at = on_table { 0.2, 0 }\n");
}

TEST_CASE("golden: predicates that extend others") {
  Files files = sound_files();
  files["worlds/predicates/under_all.lua"] =
      "-- Under.\nreturn predicate {\n  extends = \"on\", label = \"the {obj} is under all on the {surface}\",\n"
      "  holds = function(w, a, b) return true end,\n}\n";
  files["worlds/predicates/quite_clear.lua"] =
      "-- Clear.\nreturn predicate {\n  extends = \"clear\",\n  derived = is_not(exists(\"?h: hand\", "
      "is.holding(\"?h\", \"x\"))),\n}\n";
  CHECK(Root(files).complaints().empty());
  const auto with = [&](const std::string& file, const std::string& from, const std::string& to) {
    Files changed = files;
    std::string& text = changed[file];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  CHECK(with("worlds/predicates/under_all.lua", "\"on\"", "\"onn\"")
            .find("worlds/predicates/under_all.lua: extends: there is no predicate 'onn'\n    did you mean 'on'?") ==
        0);
  CHECK(with("worlds/predicates/on.lua", "  label", "  extends = \"under_all\",\n  label")
            .find("extends: 'on' extends itself\n    extend a predicate that does not extend this one") !=
        std::string::npos);
  CHECK(with("worlds/predicates/under_all.lua", "label", "params = { \"obj: movable\" }, label")
            .find("params: it takes as many things as 'on', which it extends: 2") != std::string::npos);
  CHECK(with("worlds/predicates/quite_clear.lua", "\"clear\"", "\"on\"")
            .find("'on', which it extends, is made with holds: this one too") != std::string::npos);
}

TEST_CASE("golden: numbers that things have and scripts read") {
  Files files = sound_files();
  files["worlds/types.lua"] =
      "-- Types.\nreturn {\n  types = { thing = {}, cube = { parent = \"thing\" }, fixture = {} },\n"
      "  traits = { movable = \"m\", surface = \"s\", openable = { \"o\", numbers = {\n"
      "    open_at = { \"where it is open\", unit = \"m or rad\" } } } },\n}\n";
  files["worlds/objects/chest.lua"] =
      "-- A chest.\nreturn object {\n  type = \"fixture\", traits = {}, fixed = true, shape = box { 0.1, 0.1, 0.1 },\n"
      "  parts = { lid = { type = \"fixture\", traits = { \"openable\" }, mass = 0.1, shape = box { 0.1, 0.1, 0.01 },\n"
      "    hinge = { range = { 0, 1 } }, numbers = { open_at = 0.8, give = 0.01 } } },\n}\n";
  files["worlds/predicates/open.lua"] =
      "-- Open.\nreturn predicate {\n  params = { \"part: openable\" }, label = \"{part} open\",\n"
      "  reads = { give = { \"how far it springs back\", of = \"part\", unit = \"m\", default = 0 } },\n"
      "  holds = function(w, part) return w:joint(part) > w:number(part, \"open_at\") - w:number(part, \"give\") "
      "end,\n}\n";
  CHECK(Root(files).complaints().empty());
  const auto with = [&](const std::string& file, const std::string& from, const std::string& to) {
    Files changed = files;
    std::string& text = changed[file];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  CHECK(with("worlds/objects/chest.lua", "open_at =", "opn_at =")
            .find("worlds/objects/chest.lua:5: parts.lid.numbers.opn_at: nobody declares a number 'opn_at'\n"
                  "    did you mean 'open_at'?") != std::string::npos);
  CHECK(
      with("worlds/objects/chest.lua", "open_at = 0.8,", "")
          .find("worlds/objects/chest.lua:4: parts.lid: what is openable needs the number 'open_at': where it is open "
                "[m or rad]") != std::string::npos);
  CHECK(with("worlds/objects/chest.lua", "0.8", "45")
            .find("parts.lid.numbers.open_at: 45 lies outside -12.5664 … 12.5664 m or rad\n"
                  "    a slider's position is in m, mm(60); a hinge's in rad, deg(60)") != std::string::npos);
  CHECK(with("worlds/objects/chest.lua", "give = 0.01", "give = 10")
            .find("give: 10 lies outside -5 … 5 m\n    lengths are in m") != std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "w:number(part, \"give\")", "w:number(part, \"giv\")") ==
        "worlds/predicates/open.lua:5: nobody declares a number 'giv'\n    did you mean 'give'?\n");
  CHECK(with("worlds/predicates/open.lua", "unit = \"m\"", "unit = \"mm\"")
            .find("worlds/predicates/open.lua:4: reads.give.unit: 'mm' is none of the units") == 0);
  CHECK(with("worlds/predicates/open.lua", "default = 0", "defalt = 0")
            .find("reads.give.defalt: a declared_number has no field 'defalt'\n    did you mean 'default'?") !=
        std::string::npos);
  // What is said of a faulty declaration is all that comes of it.
  CHECK(with("worlds/predicates/open.lua", "unit = \"m\"", "unit = \"mm\", max = 0.001").find("is none of the units") !=
        std::string::npos);
  CHECK(with("worlds/types.lua", "unit = \"m or rad\"", "unit = \"m or rad\", max = \"far\"")
            .find("traits.openable.numbers.open_at.max: expects number, this is the text \"far\"") !=
        std::string::npos);
  CHECK(with("worlds/types.lua", "{ \"where it is open\", unit = \"m or rad\" }", "7")
            .find("worlds/types.lua:5: traits.openable.numbers.open_at") != std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "of = \"part\"", "of = \"prt\"")
            .find("reads.give.of: there is no parameter 'prt'\n    did you mean 'part'?") != std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "\"how far it springs back\", of", "of")
            .find("reads.give: a declared number begins with what it says") != std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "default = 0", "default = 0, optional = true")
            .find("reads.give: a number with a default is there for all things") != std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "reads = {", "reads = { open_at = { \"x\", unit = \"m\" },")
            .find("reads.open_at: 'open_at' is another number here (m) than in worlds/types.lua:5 (m or rad)") !=
        std::string::npos);
  CHECK(with("worlds/predicates/open.lua", "reads = {", "reads = { open_at = {}, close_at = {},")
            .find("worlds/predicates/open.lua:4: reads.close_at: no other file declares the number 'close_at'") == 0);
  // Read and had, but declared by nobody: no mistake. Read and not had: one.
  Files own = files;
  own["worlds/objects/wire.lua"] =
      "-- A wire.\nreturn object { type = \"fixture\", traits = {}, fixed = true, shape = box { 0.1, 0.1, 0.1 }, "
      "numbers = { "
      "points = 4 } }\n";
  CHECK(Root(own).complaints().find("numbers.points: nobody declares a number 'points'") != std::string::npos);
  own["tasks/take.lua"].replace(own["tasks/take.lua"].find("  goal"), 6,
                                "  also = function(w) return w:number(\"wire\", \"points\") > 3 end,\n  goal");
  CHECK(Root(own).complaints().empty());
  own.erase("worlds/objects/wire.lua");
  CHECK(Root(own).complaints().find("tasks/take.lua:7: nobody declares a number 'points'") == 0);
  // A name that is put together is not read.
  CHECK(with("worlds/predicates/open.lua", "\"give\")", "\"gi\" .. \"ve\")").empty());
}

TEST_CASE("golden: two predicates that say different things of one number, and one in the wrong unit") {
  Files files = sound_files();
  const auto reads = [](const std::string& name, const std::string& unit) {
    return "-- It " + name + ".\nreturn predicate {\n  params = { \"obj: movable\" }, label = \"{obj} " + name +
           "\",\n  reads = { give = { \"how far it gives\", of = \"obj\", unit = \"" + unit +
           "\", default = 0 } },\n  holds = function(w, obj) return w:number(obj, \"give\") > 0 end,\n}\n";
  };
  files["worlds/predicates/bends.lua"] = reads("bends", "rad");
  files["worlds/predicates/gives.lua"] = reads("gives", "rad");
  CHECK(Root(files).complaints().empty());
  files["worlds/predicates/gives.lua"] = reads("gives", "m");
  CHECK(Root(files).complaints() ==
        "worlds/predicates/gives.lua:4: reads.give: 'give' is another number here (m, default 0) than in "
        "worlds/predicates/bends.lua:4 (rad, default 0)\n"
        "    give one of them another name; to read the same, write give = {}\n");
  files["worlds/predicates/gives.lua"] = reads("gives", "rad");
  std::string& cube = files["worlds/objects/cube.lua"];
  cube.replace(cube.find("mass = 0.1"), 10, "mass = 0.1, numbers = { give = 45 }");
  CHECK(Root(files).complaints() ==
        "worlds/objects/cube.lua:2: numbers.give: 45 lies outside -12.5664 … 12.5664 rad\n"
        "    angles are in rad: deg(60)\n");
}

TEST_CASE("golden: skills that extend one another in a circle") {
  Files files = sound_files();
  files["skills/wary.lua"] = "-- Wary.\nreturn skill { extends = \"warier\" }\n";
  files["skills/warier.lua"] = "-- Warier.\nreturn skill { extends = \"wary\" }\n";
  const std::string circle = Root(files).complaints();
  INFO(circle);
  CHECK(circle.find("skills/warier.lua: extends: 'warier' extends itself\n"
                    "    give it a name of its own, and name it in the skills of a task or world") !=
        std::string::npos);
  CHECK(circle.find("skills/wary.lua: extends: 'wary' extends itself") != std::string::npos);
}

TEST_CASE("golden: the variation knows its axes") {
  const auto objects = [](const std::string& written) {
    return said(
        "tasks/take.lua", "objects = { block = { \"cube\", count = 2 }, lone = { \"cube\" } }",
        "objects = function(v) return { block = { \"cube\", count = 2 }, lone = { \"cube\", " + written + " } } end");
  };
  CHECK(objects("colour = v.colour").empty());
  CHECK(objects("colour = v.color")
            .find("tasks/take.lua:5: the variations have no axis 'color': did you mean 'colour'?") == 0);
  CHECK(objects("mass = v.heaviness or 0.1")
            .find("tasks/take.lua:5: the variations have no axis 'heaviness': known: colour, n") == 0);
  CHECK(said("tasks/take.lua", "goal = is.holding(\"lone\")", "goal = function(v) return is.holding(v.which) end")
            .find("tasks/take.lua:7: the variations have no axis 'which'") == 0);
  CHECK(said("tasks/take.lua", "instructions = { \"take {n} {colour}\" }",
             "instructions = function(v) return { \"take \" .. v.hue } end")
            .find("tasks/take.lua:8: the variations have no axis 'hue'") == 0);
  CHECK(said("tasks/take.lua", "variations = {", "where = function(v) return v.m ~= 1 end, variations = {")
            .find("tasks/take.lua:4: the variations have no axis 'm': did you mean 'n'?") == 0);
  // Of a list, some of which lack an axis, that is nil.
  CHECK(said("tasks/take.lua", "{ n = { 1, 2 }, colour = colours.names },\n",
             "{ { n = 1, colour = \"red\", far = true }, { n = 2, colour = \"blue\" } },\n"
             "  horizon = function(v) return v.far and 20 or 10 end,\n")
            .empty());
}

TEST_CASE("golden: draws have no value, and places are numbers") {
  const auto at = [](const std::string& value) {
    return said("tasks/take.lua", "lone = { \"cube\" }", "lone = { \"cube\", at = on_table { " + value + ", 0 } }");
  };
  const auto names = [&](const std::string& text, const std::string& part) {
    INFO(text);
    return text.find("tasks/take.lua:5: ") == 0 && text.find(part) != std::string::npos;
  };
  CHECK(at("between(0.1, 0.2)").empty());
  CHECK(names(at("between(0.1, 0.2) + 0.1"), "Reckon with its bounds: between(low + 0.1, high + 0.1)"));
  CHECK(names(at("-one_of { 0.1, 0.2 }"), "one_of(each(list, function(x) return x + 0.1 end))"));
  CHECK(names(at("math.max(between(0, 1), 0.1)"), "between(…) has no value yet"));
  CHECK(names(at("#one_of { 0.1, 0.2 }"), "one_of(…) has no value yet"));
  CHECK(names(at("between(0.1, 0.2)[1]"), "on_table: value 1 is a nil, it takes numbers in m"));
  CHECK(names(at("\"0.1\""), "on_table: value 1 is a string, it takes numbers in m: on_table { 0.2, 0.1 }"));
  for (const char* word : {"math.random()", "math.randomseed(1)"})
    CHECK(names(at(word), "between(low, high), one_of { … } and sample_of(list, n) draw in the fields of a file"));
}

TEST_CASE("golden: what many say of things that can be said of one alone, and of anything") {
  for (const char* word : {"on_top", "in_surface"})  // a trait, as surface is one, is not said of two things
    CHECK(said("tasks/take.lua", "is.holding(\"lone\")", "is." + std::string(word) + "(\"lone\", \"table\")") ==
          "tasks/take.lua:7: goal: there is no predicate '" + std::string(word) +
              "'\n    known: clear, colour, holding, on, part_name, part_of\n");
  CHECK(said("tasks/take.lua", "is.holding(\"lone\")", "is.movble(\"lone\")").find("did you mean 'movable'?") !=
        std::string::npos);
  for (const char* word : {"anything", "any", "object"})
    CHECK(said("worlds/predicates/clear.lua", "\"x: movable\"", "\"x: " + std::string(word) + "\"") ==
          "worlds/predicates/clear.lua:3: params: '" + std::string(word) +
              "' is neither a type nor a trait\n    a parameter of any thing says none: \"x\"\n");
  CHECK(said("worlds/predicates/clear.lua", "\"x: movable\"", "\"x\"").empty());
}

TEST_CASE("golden: effects that leave open what holds, or forget the hand") {
  const std::string counted = said("skills/pick.lua", "is_not.on(\"obj\", \"from\")",
                                   "at_least(2, \"block*\", function(x) return is.on(x, \"from\") end)");
  CHECK(
      counted.find("skills/pick.lua:5: effect: at_least in an effect takes a type, and 'block*' is a group of a task\n"
                   "    at_least(2, \"block\", …)") == 0);
  const auto effect = [](const std::string& text) {
    return said("skills/pick.lua", "is_not.on(\"obj\", \"from\")", text);
  };
  const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
  const std::string some = "at_least(1, \"surface\", function(x) return is_not.on(\"obj\", x) end)";
  CHECK(effect(some) == "");
  CHECK(says(effect("at_least(1, \"surfce\", function(x) return is_not.on(\"obj\", x) end)"),
             "neither a type nor a trait"));
  CHECK(says(effect("forall(\"?s: surface\", " + some + ")"), "at_least inside a forall"));
  CHECK(says(effect("when(is.on(\"obj\", \"from\"), " + some + ")"), "at_least inside a when"));
  CHECK(says(effect("any_of { " + some + " }"), "this is any_of"));
  Files files = sound_files();
  files["worlds/predicates/hand_empty.lua"] =
      "-- Empty.\nreturn predicate {\n  params = { \"hand: hand\" },\n  label = \"the hand is empty\",\n"
      "  holds = function(w, h) return true end,\n}\n";
  std::string& holding = files["worlds/predicates/holding.lua"];
  std::string& panda = files["worlds/robots/panda.lua"];
  panda.replace(panda.find("tip ="), 5, "fingers = { \"left\", \"right\" }, tip =");
  holding.replace(holding.find("  holds"), 7, "  requires = \"held\",\n  holds");
  const std::string taken =
      "skills/pick.lua:5: effect: it takes something into the hand, and does not say that this is no longer empty\n"
      "    add is_not.hand_empty()\n";
  CHECK(Root(files).complaints() == taken);
  const auto with = [&](const std::string& from, const std::string& to) {
    Files changed = files;
    std::string& text = changed["skills/pick.lua"];
    REQUIRE(text.find(from) != std::string::npos);
    text.replace(text.find(from), from.size(), to);
    return Root(changed).complaints();
  };
  CHECK(with("is.holding(\"obj\"),", "is.holding(\"obj\"), is_not.hand_empty(),").empty());
  CHECK(with("is.on(\"obj\", \"from\") }", "is.holding(\"obj\") }").empty());  // it has it already
  CHECK(with("is.holding(\"obj\"),", "is_not.holding(\"obj\"),") ==
        "skills/pick.lua:5: effect: it lets go of what the hand holds, and does not say that this is empty then\n"
        "    add is.hand_empty()\n");
  CHECK(with("is.holding(\"obj\"),", "is_not.holding(\"obj\"), is.hand_empty(),").empty());
}

TEST_CASE("golden: what a task says can be seen") {
  const auto seen = [](const std::string& what) {
    return said("tasks/take.lua", "  goal =", "  observable = { " + what + " },\n  goal =");
  };
  CHECK(seen("on = function(w, obj) return true end, holding = false").empty());
  CHECK(seen("onn = false") ==
        "tasks/take.lua:7: observable.onn: there is no predicate 'onn'\n    did you mean 'on'?\n");
  CHECK(seen("clear = false").find("observable.clear: 'clear' is derived: what can be seen of it follows") !=
        std::string::npos);
  CHECK(seen("on = true").find("observable.on: expects function(w, …) or false, this is true") != std::string::npos);
}

TEST_CASE("remarks: parts of an order that may come true before their turn, and skills that take another's place") {
  const auto remarks = [](const Files& files, const Files& own) {
    const Root root(files), mine(own);
    std::vector<Error> errors;
    const auto library = Library::check({{root.path(), mine.path()}}, errors);
    for (const Error& error : errors) UNSCOPED_INFO(error.what());
    CHECK(errors.empty());
    std::string text;
    for (const Error& remark : library->remarks()) text += std::string(remark.what()) + "\n";
    return text;
  };
  const auto ordered = [&](const std::string& goal) {
    Files files = sound_files();
    std::string& text = files["tasks/take.lua"];
    text.replace(text.find("is.holding(\"lone\")"), 18, "in_order { " + goal + " }");
    return remarks(files, {});
  };
  CHECK(remarks(sound_files(), {}).empty());
  CHECK(ordered("is.holding(\"block1\"), is.holding(\"lone\")").empty());
  CHECK(ordered("is.holding(\"block1\"), all_of { is.holding(\"lone\"), is.on(\"block2\", \"table\") }").empty());
  CHECK(
      ordered("is.holding(\"block1\"), all_of { is.holding(\"lone\"), is.holding(\"block2\") }") ==
      "tasks/take.lua:7: goal: (holding panda.hand lone) or (holding panda.hand block2) may come true before the parts "
      "of in_order that stand before it: part 2 is met when all of it holds\n"
      "    what is to wait for its turn is a part by itself\n");

  const auto skill = [&](const std::string& params, const std::string& precondition, const std::string& effect) {
    return remarks(
        sound_files(),
        {{"skills/grab.lua", "-- Grab.\nreturn skill {\n  params = { " + params + " },\n  precondition = { " +
                                 precondition + " },\n  effect = { " + effect +
                                 " },\n  label = \"grab the {obj}\",\n  run = function(robot, p, c) end,\n}\n"}});
  };
  const std::string told =
      "skills/grab.lua:4: precondition: 'grab' may be done wherever 'pick' may, and makes true all that it does: plans "
      "of any task may take it instead\n"
      "    ask for more, or for types of your own; or extends = \"pick\", and skills = { \"grab\" } in the tasks that "
      "want it\n";
  CHECK(skill("\"obj: movable\"", "", "is.holding(\"obj\")") == told);
  CHECK(skill("\"under: surface\", \"obj: movable\"", "is.on(\"obj\", \"under\")", "is.holding(\"obj\")") == told);
  CHECK(skill("\"obj: cube\"", "", "is.holding(\"obj\")").empty());  // of its own things
  CHECK(skill("\"obj: movable\"", "is.clear(\"obj\")", "is.holding(\"obj\")").empty());
  CHECK(skill("\"obj: movable\"", "", "is_not.holding(\"obj\")").empty());
}

TEST_CASE("golden: screws, and joints that let go") {
  const auto lid = [](const std::string& joint) {
    return said(
        "worlds/objects/cube.lua", "mass = 0.1",
        "mass = 0.1,\n  parts = { lid = { type = \"thing\", traits = { \"movable\" }, mass = 0.1,\n  shape = box { "
        "0.1, 0.1, 0.1 },\n  " +
            joint + " } }");
  };
  CHECK(lid("screw = { range = { 0, 9 }, pitch = mm(4) }").empty());
  CHECK(lid("screw = { range = { 0, 9 }, pitch = mm(4), friction = 0.1, lets_go = 8 }").empty());
  CHECK(lid("hinge = { range = { 0, 9 }, lets_go = 8 }").empty());
  const std::string flat = lid("screw = { range = { 0, 9 } }");
  CHECK(flat.find(
            "worlds/objects/cube.lua:5: parts.lid.screw: a screw without pitch does not travel\n    pitch = mm(4)") ==
        0);
  CHECK(lid("screw = { range = { 0, 9 }, pitch = 0 }") == flat);
  CHECK(lid("hinge = { range = { 0, 9 }, pitch = mm(4) }").find("hinge.pitch: only a screw has a pitch") !=
        std::string::npos);
  CHECK(lid("hinge = { range = { 0, 9 }, lets_go = 12 }").find("hinge.lets_go: the joint never gets there") !=
        std::string::npos);
  CHECK(lid("hinge = { range = { 0, 9 }, lets_go = 0 }").find("hinge.lets_go: the joint never gets there") !=
        std::string::npos);
  CHECK(lid("hinge = { range = { 0, 9 }, lets_go = 8, spring = 1 }")
            .find("hinge.spring: a joint that lets go of its part has friction alone") != std::string::npos);
  CHECK(lid("hinge = { range = { 0, 9 } }, slider = { range = { 0, 1 } }")
            .find("a part needs one of slider, hinge, screw and fixed") != std::string::npos);
}

TEST_CASE("golden: facts that shapes are shown by") {
  const auto shows = [](const std::string& rule) {
    return said("worlds/objects/cube.lua", "shape = box { 0.1, 0.1, 0.1 }",
                "shapes = { box { 0.1, 0.1, 0.1, shows = " + rule + " } }");
  };
  CHECK(shows("is.clear(\"self\")").empty());
  CHECK(shows("is_not.clear(\"self\")").empty());
  CHECK(shows("is.claer(\"self\")").find("shows: there is no predicate 'claer'\n    did you mean 'clear'?") !=
        std::string::npos);
  CHECK(shows("is.on(\"self\", \"table\")").find("shows: 'on' is no fact of one thing") != std::string::npos);
  CHECK(shows("is.clear(\"bulb\")").find("shows: the object has no part or region 'bulb'") != std::string::npos);
  CHECK(shows("any_of { is.clear(\"self\") }").find("shows: what a shape is shown by is one fact") !=
        std::string::npos);
}

TEST_CASE("golden: parts of variables") {
  const std::string wrong = said("worlds/predicates/clear.lua", "is.on(\"?y\", \"x\")", "is.on(\"?y\", \"x.lid\")");
  CHECK(wrong.find("worlds/predicates/clear.lua:5: derived: nothing has a part or region 'lid'") == 0);
  CHECK(said("worlds/objects/cube.lua", "mass = 0.1", "mass = 0.1, regions = { lid = { size = { 0.1, 0.1, 0.1 } } }")
            .empty());
  Files files = sound_files();
  std::string& cube = files["worlds/objects/cube.lua"];
  cube.replace(cube.find("mass = 0.1"), 10, "mass = 0.1, regions = { lid = { size = { 0.1, 0.1, 0.1 } } }");
  std::string& pick = files["skills/pick.lua"];
  pick.replace(pick.find("is.holding(\"obj\")"), 17, "is.holding(\"obj.lid\")");
  INFO(Root(files).complaints());
  CHECK(Root(files).complaints().find("effect: an effect cannot name a part of a parameter: 'obj.lid'") !=
        std::string::npos);
}

TEST_CASE("golden: what nothing places") {
  CHECK(said("tasks/take.lua", ", is.on(\"lone\", \"table\")", "") ==
        "tasks/take.lua:6: init: nothing places the free object 'lone'\n"
        "    name it in init, such as is.on(\"lone\", \"table\"), or give it at = { x, y, z }\n");
  CHECK(said("tasks/take.lua", "{ \"cube\" }", "{ \"cube\", at = { 0, 0, 1 } }").empty());  // and at is enough
  // A formula may give it another place, but which things start where is not to hang on a draw.
  CHECK(said("tasks/take.lua", "is.on(\"lone\", \"table\")", "exists(\"?x: surface\", is.on(\"lone\", \"?x\"))")
            .find("nothing places the free object 'lone'") != std::string::npos);
  CHECK(said("tasks/take.lua", "is.on(\"lone\", \"table\")",
             "is.on(\"lone\", \"table\"), exists(\"?x: movable\", is.on(\"?x\", \"tabel\"))")
            .find("there is no object 'tabel'") != std::string::npos);
  CHECK(said("tasks/take.lua", "is.holding(\"lone\")", "in_order { is.clear(\"lone\"), is.holding(\"lone\") }")
            .find("tasks/take.lua:7: goal: 'clear' is derived: no action makes it true by itself") == 0);
  CHECK(said("tasks/take.lua", "is.on(\"lone\", \"table\")", "in_order { is.on(\"lone\", \"table\") }")
            .find("init: nothing comes in an order before the start\n    in_order belongs to the goal") !=
        std::string::npos);
  // is_not places nothing.
  CHECK(said("tasks/take.lua", "is.on(\"lone\"", "is_not.on(\"lone\"").find("nothing places the free object 'lone'") !=
        std::string::npos);
}

TEST_CASE("golden: scripts that fail or do not end") {
  CHECK(said("tasks/take.lua", "goal =", "goal = = ").find("tasks/take.lua:7: unexpected symbol near '='") == 0);
  CHECK(said("tasks/take.lua", "return task", "while true do end\nreturn task")
            .find("tasks/take.lua:2: the script ran for too long: its instruction budget is spent") == 0);
  CHECK(said("tasks/take.lua", "return task", "os.execute('true')\nreturn task")
            .find("tasks/take.lua:2: unknown name 'os'") == 0);
  CHECK(said("tasks/take.lua", "return task", "local t = {} for i = 1, 1e9 do t[i] = { i } end\nreturn task")
            .find("tasks/take.lua") == 0);
  CHECK(said("tasks/take.lua", "goal = is.holding(\"lone\")", "goal = function(v) while true do end end")
            .find("tasks/take.lua:7: the script ran for too long") == 0);
  CHECK(said("tasks/take.lua", "goal = is.holding(\"lone\")", "goal = function(v) return v.n.field.of end")
            .find("tasks/take.lua:7: attempt to index a number value (field 'n')") == 0);
  CHECK(said("tasks/take.lua", "return task {", "return skill {").find("the file returns a skill, not a task") !=
        std::string::npos);
}

TEST_CASE("all faults of all files come in one run, in the order of files and lines") {
  Files files = sound_files();
  files["tasks/take.lua"].replace(files["tasks/take.lua"].find("world ="), 7, "wrld  =");
  files["skills/pick.lua"].replace(files["skills/pick.lua"].find("label ="), 7, "lable =");
  files["worlds/objects/cube.lua"].replace(files["worlds/objects/cube.lua"].find("mass"), 4, "mas");
  const std::string text = Root(files).complaints();
  const std::size_t skill = text.find("skills/pick.lua:7: lable"), task = text.find("tasks/take.lua:3: wrld"),
                    object = text.find("worlds/objects/cube.lua:2: mas");
  REQUIRE(object != std::string::npos);
  CHECK(skill < task);
  CHECK(task < object);
  Root root(files);
  const auto library = Library::load({{root.path()}});
  CHECK_THROWS_AS(library->require_sound({library->file(DefinitionKind::task, "take")}), LibraryError);
}

TEST_CASE("a later root wins, file by file") {
  Root first(sound_files());
  Root second({{"tasks/take.lua", "-- Another.\n" + sound_files()["tasks/take.lua"]}});
  const auto library = Library::load({{first.path(), second.path()}});
  CHECK(library->task("take")->description == "Another");
  CHECK(library->file(DefinitionKind::object, "cube") != nullptr);
}

TEST_CASE("a link out of a root is refused") {
  Root outside(sound_files());
  Root root({{"worlds/types.lua", sound_files()["worlds/types.lua"]}});
  fs::create_symlink(outside.path() / "worlds/colours.lua", root.path() / "worlds/colours.lua");
  CHECK(root.complaints().find("a link that leads out of its root") != std::string::npos);
}
