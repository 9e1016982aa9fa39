// `check --physics --why`: what failed, how near it came, and pictures of what was turned down.
#include <catch2/catch.hpp>

#include "engine/geometry/drawn_mesh.h"
#include "tests/program/say.h"

using namespace stampede;
using namespace stampede::program;

namespace {

const std::string kCube = "{ \"cube\", at = { 0.25, 0, 0.7702 } }";

void put_bad_task(const Folder& mine, const std::string& objects, const std::string& init, const std::string& goal) {
  put(mine, "tasks/t.lua",
      "-- A task that cannot be done.\nreturn task {\n  world = \"tabletop\",\n  objects = { " + objects +
          " },\n  init = { " + init + " },\n  goal = " + goal + ",\n  instructions = { \"do it\" },\n}\n");
}

// A surface of so many metres a side.
void put_slab(const Folder& mine, const std::string& side) {
  put(mine, "worlds/objects/slab.lua",
      "-- A slab.\nreturn object {\n  type = \"tray\", traits = { \"surface\", \"support\" }, fixed = true,\n"
      "  shapes = { box { " +
          side + ", " + side + ", 0.02, at = { 0, 0, -0.01 } } },\n}\n");
}

Said why(const Folder& mine, std::vector<std::string> more = {}) {
  std::vector<std::string> words = {"check", "t",      "--physics", "--why",  "--episodes",
                                    "1",     "--root", kRoot,       "--path", mine.text()};
  words.insert(words.end(), more.begin(), more.end());
  return say(words);
}

// How many pixels of a picture are nearly of this colour.
int pixels_like(const Image& picture, int red, int green, int blue) {
  int count = 0;
  for (std::size_t i = 0; i + 3 < picture.rgba.size(); i += 4)
    count += std::abs(picture.rgba[i] - red) < 12 && std::abs(picture.rgba[i + 1] - green) < 12 &&
             std::abs(picture.rgba[i + 2] - blue) < 12;
  return count;
}

int pictures_in(const std::string& folder) {
  int count = 0;
  for ([[maybe_unused]] const auto& file : std::filesystem::directory_iterator(folder)) ++count;
  return count;
}

}  // namespace

TEST_CASE("a thing out of reach: how far, and grey ghosts of the hand") {
  const Folder mine;
  put_bad_task(mine, "far = { \"tray\", at = { 0.75, 0, 0.75 } }, a = { \"cube\", at = { 0.75, 0, 0.7702 } }", "",
               "is.lifted(\"a\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "out of reach"));
  CHECK((says(said.err, "out of reach by ") || says(said.err, "'s limit")));
  CHECK(says(said.err, mine / "why/t-pick-a-far-panda.hand-no_grasp.png"));
  const Image picture = load_image(mine / "why/t-pick-a-far-panda.hand-no_grasp.png");
  CHECK(picture.width > 1000);
  CHECK(pixels_like(picture, 107, 112, 122) > 150);  // its square in the legend
}

TEST_CASE("a thing between walls: what the hand touches, by how much, and red ghosts") {
  const Folder mine;
  put(mine, "worlds/objects/walls.lua",
      "-- Four walls close around a cube.\nlocal s = {}\n"
      "for k = 0, 3 do\n  local a = k * math.pi / 2\n"
      "  s[#s + 1] = box { 0.01, 0.07, 0.06, at = { 0.032 * math.cos(a), 0.032 * math.sin(a), 0.03 }, yaw = a }\nend\n"
      "return object { type = \"fixture\", traits = {}, fixed = true, shapes = s }\n");
  put_bad_task(mine, "walls = { \"walls\", at = { 0.25, 0, 0.75 } }, a = " + kCube, "", "is.lifted(\"a\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "touch walls"));
  CHECK(says(said.err, "touch walls ("));
  CHECK(says(said.err, " mm at least)"));
  CHECK(pixels_like(load_image(mine / "why/t-pick-a-table-panda.hand-no_grasp.png"), 140, 13, 77) >
        150);  // the second thing
}

TEST_CASE("a place that is too small: by how much, and ghosts of the thing") {
  const Folder mine;
  put_slab(mine, "0.03");
  put_bad_task(mine, "slab = { \"slab\", at = { 0.25, 0.2, 0.80 } }, a = " + kCube, "", "is.on(\"a\", \"slab\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "no_placement"));
  CHECK(says(said.err, "too wide for the place by "));
  CHECK(pixels_like(load_image(mine / "why/t-place-a-slab-panda.hand-no_placement.png"), 242, 148, 26) > 150);
}

TEST_CASE("a start that cannot be made: which literal, what is in the way, and a picture") {
  const Folder mine;
  put_slab(mine, "0.07");
  put_bad_task(mine, "slab = { \"slab\", at = { 0.25, 0.2, 0.80 } }, a = { \"cube\", count = 3 }",
               "is.on(\"a*\", \"slab\")", "is.lifted(\"a1\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "init (on a2 slab)"));
  CHECK(says(said.err, "touches a1 by "));
  CHECK(pixels_like(load_image(mine / "why/t-init-on-a2-slab-init_impossible.png"), 217, 26, 26) > 150);
  CHECK(pictures_in(mine / "why") == 1);
}

TEST_CASE("a condition that something else stands in the way of: by how much, without a picture") {
  const Folder mine;
  put_bad_task(mine, "a = " + kCube + ", b = { \"cube\", at = { 0.25, 0.1, 0.7702 } }", "is.spaced(\"a\", \"b\")",
               "is.lifted(\"a\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(says(said.err, "(spaced a b) failed 100 times, by 20 mm at least"));
  CHECK(pictures_in(mine / "why") == 0);
}

TEST_CASE("what an own predicate's sample does wrong, and what nothing makes, is told at the line that asks for it") {
  const Folder mine;
  put(mine, "worlds/predicates/beside_itself.lua",
      "-- Draws nonsense.\nreturn predicate {\n  params = { \"obj: movable\", \"below: support\" },\n"
      "  label = \"the {obj} is beside itself on the {below}\",\n  holds = function() return true end,\n"
      "  sample = function(w, obj) return w:size(obj) + nil end,\n}\n");
  put_bad_task(mine, "a = { \"cube\" }", "is.beside_itself(\"a\", \"table\")", "is.lifted(\"a\")");
  const Said wrong = why(mine);
  INFO(wrong.out << wrong.err);
  CHECK(says(wrong.out + wrong.err, "tasks/t.lua:5: (beside_itself a table): worlds/predicates/beside_itself.lua:6"));
  put(mine, "worlds/predicates/polished.lua",
      "-- Never so.\nreturn predicate {\n  params = { \"obj: movable\" }, label = \"the {obj} is polished\",\n"
      "  holds = function() return false end,\n}\n");
  put_bad_task(mine, "a = " + kCube, "is.polished(\"a\")", "is.lifted(\"a\")");
  const Said nothing = why(mine);
  INFO(nothing.out << nothing.err);
  CHECK(says(nothing.err,
             "tasks/t.lua:5: (polished a) failed 100 times; nothing makes it so: 'polished' has no `sample`"));
}

TEST_CASE("a step that found a grasp and failed after that: green ghosts of the hand") {
  const Folder mine;
  put(mine, "skills/give_up.lua",
      "-- Finds a grasp, and gives up.\nreturn skill {\n  params = { \"obj: movable & graspable\" },\n"
      "  precondition = { is.hand_empty() }, effect = { is.holding(\"obj\"), is_not.hand_empty() },\n"
      "  continuous = { grasp = stream(\"grasps\") }, label = \"give up\",\n"
      "  run = function(robot) robot:fail(\"no more\") end,\n}\n");
  put_bad_task(mine, "a = " + kCube, "", "is.lifted(\"a\"), steps = act.give_up(\"a\")");
  const Said said = why(mine, {"--pictures", mine / "why"});
  INFO(said.out << said.err);
  CHECK(says(said.err, "no more"));
  CHECK_FALSE(says(said.err, "nearest miss"));
  const Image picture = load_image(mine / "why/t-give_up-a-panda.hand-failed_by_skill.png");
  CHECK(pixels_like(picture, 26, 158, 64) > 150);
}

TEST_CASE("what is told does not depend on the number of workers, and without --why nothing is told") {
  const Folder mine;
  put_slab(mine, "0.03");
  put_bad_task(mine, "slab = { \"slab\", at = { 0.25, 0.2, 0.80 } }, a = { \"cube\" }", "is.on(\"a\", \"table\")",
               "is.on(\"a\", \"slab\")");
  const auto table = [&](const std::string& workers) {
    const Said said = why(mine, {"--workers", workers, "--seed", "5"});
    return said.err.substr(said.err.find("times"));
  };
  CHECK(table("1") == table("2"));
  const Said plain = say({"check", "t", "--physics", "--episodes", "1", "--root", kRoot, "--path", mine.text()});
  CHECK_FALSE(says(plain.err, "nearest_miss"));
}
