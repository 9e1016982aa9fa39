// The nine mistakes that are made most: each is a file of tests/scripting/data/mistakes, found by `check` without
// physics.
#include <catch2/catch.hpp>

#include "tests/program/say.h"

namespace stampede::program {
namespace {

constexpr const char* kMistakes = STAMPEDE_SOURCE_DIR "/tests/scripting/data/mistakes";

struct Expected {
  const char *name, *said, *cure;
};

}  // namespace

TEST_CASE("each of nine mistakes is found with its line and its cure, one complaint a file") {
  const std::vector<Expected> nine = {
      {"grasp_it", "skills/grasp_it.lua:8: robot has no method 'grasp'\n", ""},
      {"look_at_it", "skills/look_at_it.lua:9: pos.x: 'position' gives its numbers one by one, and no table\n",
       "local x, y, z = …:position(…)"},
      {"lift_high", "skills/lift_high.lua:9: run: c.height is nothing that the skill declares in continuous\n", ""},
      {"take_and_forget",
       "skills/take_and_forget.lua:6: effect: it takes something into the hand, and does not say that this is no "
       "longer empty\n",
       "add is_not.hand_empty()"},
      {"weightless", "worlds/objects/weightless.lua:4: mass: 'weightless' can move, so it needs a mass\n",
       "mass = 0.1 (kg)"},
      {"nowhere",
       "tasks/nowhere.lua:4: objects.barbecue: nothing says where it is, and what does not move is not placed by "
       "init\n",
       "at = on_table { 0.2, 0 }"},
      {"turned_ninety", "tasks/turned_ninety.lua:6: objects.chest.yaw: 90 rad are more than two turns\n",
       "angles are in rad: deg(90)"},
      {"one_place", "tasks/one_place.lua:7: objects.second: 'second' and 'chest' stand in one place, ",
       "no start can be made of that: move one of them"},
      {"colour_axis", "tasks/colour_axis.lua:6: the variations have no axis 'colour': did you mean 'color'?\n", ""},
  };
  std::vector<std::string> words = {"check", "--root", kRoot, "--path", kMistakes};
  for (const Expected& one : nine) words.emplace_back(one.name);
  const Said said = say(words);
  INFO(said.out << said.err);
  CHECK(said.code == kBadInput);
  for (const Expected& one : nine) {
    CAPTURE(one.name);
    CHECK(says(said.out, one.said));
    CHECK(says(said.out, one.cure));
  }
}

}  // namespace stampede::program
