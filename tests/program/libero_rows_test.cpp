// Every row of LIBERO's mapping stands for something that can be done: problems of its words are imported and start.
#include <catch2/catch.hpp>
#include <set>

#include "scripting/library/library.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

struct LiberoProblem {
  std::string table = "kitchen_table", fixtures, objects, regions, init, goal;
};

std::string text_of(const LiberoProblem& one) {
  return "(define (problem LIBERO_Kitchen_Tabletop_Manipulation)\n  (:domain robosuite)\n  (:language do it)\n  "
         "(:regions "
         "(a (:target " +
         one.table +
         ") (:ranges ((-0.06 -0.11 -0.04 -0.09))) (:yaw_rotation ((0.0 0.0))))\n"
         "    (b (:target " +
         one.table + ") (:ranges ((-0.02 0.17 0.02 0.21))) (:yaw_rotation ((0.0 0.0))))\n" + one.regions +
         ")\n  (:fixtures " + one.table + " - " + one.table + " " + one.fixtures + ")\n  (:objects " + one.objects +
         ")\n  (:obj_of_interest )\n  (:init " + one.init + ")\n  (:goal (And " + one.goal + ")))\n";
}

// Imports the problem and runs an episode. Result: what was said where it is no task here or does not start.
std::string fault(const Folder& mine, const std::string& name, const LiberoProblem& problem,
                  const char* episodes = "1") {
  put(mine, name + ".bddl", text_of(problem));
  const Said said = say({"import", mine / (name + ".bddl"), "--task", "t_" + name, "--root", kRoot, "--path",
                         mine.text(), "--episodes", episodes, "--out", mine / (name + ".db")});
  const std::string all = said.out + said.err;
  const bool started = said.code == kDone || (said.code == kNo && !says(all, "cannot be a task here"));
  return started && !says(all, "init_") ? "" : all + "\n" + text_of(problem);
}

}  // namespace

TEST_CASE("LIBERO's things with a joint or a place are found on the part that has it") {
  const Folder mine;
  const std::string mug = "mug_1 - porcelain_mug", on = "(On mug_1 kitchen_table_a) ";
  const std::string stove = "flat_stove_1 - flat_stove", oven = "microwave_1 - microwave";
  CHECK(fault(mine, "turn_on", {"kitchen_table", stove, mug, "", on, "(Turnon flat_stove_1)"}) == "");
  CHECK(fault(mine, "turn_off",
              {"kitchen_table", stove, mug, "", on + "(Turnon flat_stove_1)", "(Turnoff flat_stove_1)"}) == "");
  CHECK(fault(mine, "shut", {"kitchen_table", oven, mug, "", on + "(Open microwave_1)", "(Close microwave_1)"}) == "");
  CHECK(fault(mine, "open", {"kitchen_table", oven, mug, "", on + "(Close microwave_1)", "(Open microwave_1)"}) == "");
  CHECK(fault(mine, "serve",
              {"kitchen_table", "", mug + " tray_1 - wooden_tray", "    (contain_region (:target tray_1))\n",
               on + "(On tray_1 kitchen_table_b)", "(In mug_1 tray_1_contain_region)"}) == "");
}

TEST_CASE("each category that LIBERO's mapping has stands for a thing of ours, and its sites for parts") {
  const auto library = Library::load({{kRoot}});
  const BddlMapping mapping = bddl_mapping_of(*library, BddlDialect::libero);
  const std::set<std::string> tables = {"table",       "main_table",  "kitchen_table", "living_room_table",
                                        "study_table", "coffee_table"};
  const std::set<std::string> jointed = {"flat_stove", "wooden_tray", "floor"};  // above; what every arena has
  const Folder mine;
  LiberoProblem carried;
  carried.goal = "(On thing0 kitchen_table_b)";
  int things = 0;
  for (const BddlPair& pair : mapping.categories) {
    CAPTURE(pair.theirs, pair.ours);
    CHECK(library->file(DefinitionKind::object, pair.ours) != nullptr);
    if (tables.contains(pair.theirs)) {
      LiberoProblem one{pair.theirs, "", "m_1 - porcelain_mug", "", "(On m_1 " + pair.theirs + "_a)", ""};
      one.goal = "(On m_1 " + pair.theirs + "_b)";
      CHECK(fault(mine, pair.theirs, one, "0") == "");
    } else if (pair.ours == "chest") {
      LiberoProblem one{
          "kitchen_table", "c_1 - " + pair.theirs, "m_1 - porcelain_mug", "", "(On m_1 kitchen_table_a)", ""};
      for (const char* site : {"top_region", "middle_region", "bottom_region"})
        one.regions += std::string("    (") + site + " (:target c_1))\n";
      one.goal = "(Open c_1_top_region) (Close c_1_middle_region) (Close c_1_bottom_region)";
      CHECK(fault(mine, pair.theirs, one, "0") == "");
    } else if (!jointed.contains(pair.theirs)) {
      const std::string name = "thing" + std::to_string(things++);
      carried.objects += " " + name + " - " + pair.theirs;
      carried.init += " (On " + name + " kitchen_table)";
    }
  }
  REQUIRE(things > 0);
  CHECK(fault(mine, "carried", carried) == "");
}

}  // namespace stampede::program
