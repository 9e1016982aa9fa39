// A mapping of each dialect for these tests; those that ship are Lua (worlds/bddl).
#pragma once

#include "engine/bddl/mapping.h"

namespace stampede {

inline BddlMapping libero_words() {
  using enum BddlMeaning;
  BddlMapping mapping;
  mapping.domain = "robosuite";
  mapping.support = "on";
  mapping.within = "inside";
  mapping.hand = "panda.hand";
  mapping.problem_name = "libero_tabletop_manipulation";
  mapping.categories = {{"table", "work_table"},         {"main_table", "work_table"},
                        {"kitchen_table", "work_table"}, {"living_room_table", "work_table"},
                        {"study_table", "work_table"},   {"coffee_table", "work_table"},
                        {"wooden_cabinet", "chest"},     {"white_cabinet", "chest"},
                        {"flat_stove", "push_button"},   {"floor", "floor"},
                        {"wooden_block", "cube"},        {"porcelain_mug", "mug"},
                        {"red_coffee_mug", "mug"},       {"white_yellow_mug", "mug"},
                        {"alphabet_soup", "soup_can"},   {"chocolate_pudding", "chocolate_jelly"},
                        {"wooden_tray", "tray"}};
  mapping.sites = {{"top_region", "top_drawer"},
                   {"middle_region", "middle_drawer"},
                   {"bottom_region", "bottom_drawer"},
                   {"top_side", ""},
                   {"cook_region", ""}};
  mapping.parts = {{"chest", {"bottom_drawer", "middle_drawer", "top_drawer"}}};
  mapping.predicates = {
      {"on",
       "on",
       false,
       {},
       weaker,
       "theirs also asks that the centres are within 3 cm horizontally, or that the object is in the region's box"},
      {"in",
       "inside",
       false,
       {},
       equal,
       "both ask that the object's centre is in the box; of an object that is no region theirs also asks for contact"},
      {"open", "open", false, {}, equal, "of a fixture with several joints theirs asks for any of them"},
      {"close", "closed", false, {}, equal, "of a fixture with several joints theirs asks for all of them"},
      {"turnon",
       "pressed",
       false,
       {},
       weaker,
       "theirs asks that the knob is on now, ours that it has been pressed once"},
      {"turnoff", "pressed", true, {}, stronger, "ours asks that it was never pressed, theirs that it is off now"},
      {"up",
       "lifted",
       false,
       {},
       incomparable,
       "theirs asks for a height of 1 m in the world, ours that the hand holds it and nothing else holds it up"},
  };
  return mapping;
}

inline BddlMapping behavior_words() {
  using enum BddlMeaning;
  BddlMapping mapping;
  mapping.dialect = BddlDialect::behavior;
  mapping.domain = "behavior-1k";
  mapping.support = "on";
  mapping.within = "inside";
  mapping.hand = "panda.hand";
  mapping.room = "kitchen";
  mapping.categories = {{"table.n.02", "work_table"},
                        {"breakfast_table.n.01", "work_table"},
                        {"cabinet.n.01", "chest"},
                        {"chest.n.02", "chest"},
                        {"push_button.n.01", "push_button"},
                        {"floor.n.01", "floor"},
                        {"block.n.01", "cube"},
                        {"mug.n.04", "mug"},
                        {"plate.n.04", "plate"},
                        {"saucepan.n.01", "saucepan"},
                        {"chopping_board.n.01", "chopping_board"},
                        {"umbrella.n.01", "umbrella"},
                        {"tray.n.01", "tray"},
                        {"ashcan.n.01", "bin"},
                        {"agent.n.01", "hand"}};
  mapping.parts = {{"chest", {"bottom_drawer", "middle_drawer", "top_drawer"}}};
  mapping.predicates = {
      {"ontop",
       "on",
       false,
       {},
       stronger,
       "theirs asks for contact and that one is above the other, ours that the contact force carries it"},
      {"onfloor", "on", false, {}, stronger, "as for ontop; in the problems of 2021 only"},
      {"inside",
       "inside",
       false,
       {},
       incomparable,
       "theirs casts rays from the object that must meet the container, ours asks that its centre is in the inner box"},
      {"open",
       "open",
       false,
       {},
       stronger,
       "theirs asks that any joint has moved a small share of its range, ours that this one is open far enough to use"},
      {"open", "closed", true, {}, stronger, "ours asks for shut to within its play, theirs for not open"},
      {"toggled_on",
       "pressed",
       false,
       {},
       weaker,
       "theirs toggles with each press and asks for now, ours that it has been pressed once"},
      {"grasped", "holding", false, {}, equal, "theirs by an attached constraint, ours by friction between the pads"},
  };
  return mapping;
}

}  // namespace stampede
