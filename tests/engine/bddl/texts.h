// Small problems of our own in both dialects.
#pragma once

#include <string>

#include "engine/base/error.h"
#include "engine/bddl/bddl.h"

constexpr const char* kTidyDesk = R"((define (problem LIBERO_Tabletop_Manipulation)
  (:domain robosuite)
  (:language Put the red mug in the top drawer and close it) ; one comment
  (:regions
    (mug_spot (:target desk) (:ranges ((-0.1 -0.02 -0.08 0))) (:yaw_rotation ((0 pi/2))))
    (plate_spot (:target desk) (:ranges ((0.1 0 0.2 0.1) (0.2 0 0.3 0.1))) (:rgba (1 0 0 0.5)))
    (top_region (:target cabinet_1)))
  (:fixtures desk - table cabinet_1 - wooden_cabinet)
  (:objects mug_1 mug_2 - mug plate_1 - plate)
  (:obj_of_interest mug_1 cabinet_1)
  (:init (On mug_1 desk_mug_spot) (On plate_1 desk_plate_spot) (On mug_2 plate_1) (Open cabinet_1_top_region))
  (:goal (And (In mug_1 cabinet_1_top_region) (Close cabinet_1_top_region))))
)";

constexpr const char* kTidyDeskBackwards = R"((define
  (:goal (and (in mug_1 cabinet_1_top_region) (close cabinet_1_top_region)))
  (:init (on mug_1 desk_mug_spot) (on plate_1 desk_plate_spot) (on mug_2 plate_1) (open cabinet_1_top_region))
  (:obj_of_interest mug_1 cabinet_1)
  (:objects mug_1 mug_2 - mug plate_1 - plate)
  (:fixtures desk - table cabinet_1 - wooden_cabinet)
  (:regions
    (mug_spot (:ranges ((-0.1 -0.02 -0.08 0))) (:yaw_rotation ((0 0.5*pi))) (:target desk))
    (plate_spot (:target desk) (:rgba (1 0 0 0.5)) (:ranges ((0.1 0 0.2 0.1) (0.2 0 0.3 0.1))))
    (top_region (:target cabinet_1)))
  (:language put the red mug in the top drawer and close it)
  (:domain robosuite)
  (problem libero_tabletop_manipulation)))";

constexpr const char* kClearKitchen = R"((define (problem clear_kitchen-0)
  (:domain behavior-1k)
  (:objects
    apple.n.01_1 apple.n.01_2 apple.n.01_3 - apple.n.01
    cabinet.n.01_1 cabinet.n.01_* - cabinet.n.01
    bowl.n.01_1 bowl.n.01_2 bowl.n.01_3 - bowl.n.01
    floor.n.01_1 - floor.n.01
    agent.n.01_1 - agent.n.01
  )
  (:init
    (inroom floor.n.01_1 kitchen)
    (inroom cabinet.n.01_1 kitchen)
    (inroom cabinet.n.01_* kitchen)
    (not (open cabinet.n.01_1))
    (ontop apple.n.01_1 floor.n.01_1)
    (ontop agent.n.01_1 floor.n.01_1)
  )
  (:goal
    (and
      (forall (?apple.n.01 - apple.n.01) (inside ?apple.n.01 ?cabinet.n.01_1))
      (forn (2) (?bowl.n.01 - bowl.n.01) (ontop ?bowl.n.01 ?floor.n.01_1))
      (fornpairs (2) (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01) (nextto ?apple.n.01 ?bowl.n.01))
      (imply (open ?cabinet.n.01_1) (exists (?apple.n.01 - apple.n.01) (cooked ?apple.n.01)))
      (or (not (open ?cabinet.n.01_1)) (forpairs (?apple.n.01 - apple.n.01) (?bowl.n.01 - bowl.n.01)
        (inside ?apple.n.01 ?bowl.n.01)))
    )
  )
))";

// A small LIBERO problem with one section replaced or added.
inline std::string desk_with(const std::string& section, const std::string& text) {
  std::string result = "(define (problem p)\n";
  bool known = false;
  const auto add = [&](const std::string& head, const std::string& usual) {
    known = known || head == section;
    result += "  (" + head + " " + (head == section ? text : usual) + ")\n";
  };
  add(":domain", "robosuite");
  add(":language", "do it");
  add(":regions", "(spot (:target desk) (:ranges ((0 0 0.1 0.1))))");
  add(":fixtures", "desk - table");
  add(":objects", "cup_1 cup_2 - cup");
  add(":obj_of_interest", "");
  add(":init", "(on cup_1 desk_spot)");
  add(":goal", "(and (on cup_1 desk))");
  if (!known) result += "  (" + section + " " + text + ")\n";
  return result + ")";
}

inline std::string kitchen_with_goal(const std::string& goal) {
  const std::string kitchen = kClearKitchen;
  return kitchen.substr(0, kitchen.find("(:goal")) + "(:goal " + goal + "))";
}

// Reads a kitchen, with the instance written out that its wildcard stands for.
inline stampede::BddlProblem kitchen_of(std::string text) {
  for (std::size_t at = 0; (at = text.find("_*", at)) != std::string::npos;) text.replace(at, 2, "_2");
  return stampede::read_bddl(text, "k").problem;
}

inline std::string complaint(const std::string& text) {
  try {
    stampede::read_bddl(text, "desk.bddl");
  } catch (const stampede::Error& error) {
    return error.what();
  }
  return "read";
}
