#include "planning_problems.h"

#include <algorithm>
#include <vector>

#include "engine/base/random.h"

namespace stampede::bench {
namespace {

const char* const kBlocks = R"((define (domain blocks) (:requirements :strips :typing) (:types block)
  (:predicates (on ?x ?y - block) (ontable ?x - block) (clear ?x - block) (handempty) (holding ?x - block))
  (:action pick-up :parameters (?x - block) :precondition (and (clear ?x) (ontable ?x) (handempty))
    :effect (and (not (ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))
  (:action put-down :parameters (?x - block) :precondition (holding ?x)
    :effect (and (not (holding ?x)) (clear ?x) (handempty) (ontable ?x)))
  (:action stack :parameters (?x ?y - block) :precondition (and (holding ?x) (clear ?y))
    :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))
  (:action unstack :parameters (?x ?y - block) :precondition (and (on ?x ?y) (clear ?x) (handempty))
    :effect (and (holding ?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y))))))";

const char* const kTabletop = R"((define (domain tabletop) (:requirements :strips :typing)
  (:types movable place hand - object region drawer - place)
  (:predicates (handempty ?h - hand) (holding ?h - hand ?o - movable) (at ?o - movable ?p - place) (flat ?o - movable)
    (on ?o ?b - movable) (clear ?o - movable) (accessible ?p - place) (opened ?d - drawer) (closed ?d - drawer))
  (:action pick :parameters (?h - hand ?o - movable ?p - place)
    :precondition (and (handempty ?h) (at ?o ?p) (flat ?o) (clear ?o) (accessible ?p))
    :effect (and (holding ?h ?o) (not (handempty ?h)) (not (at ?o ?p)) (not (flat ?o)) (not (clear ?o))))
  (:action place :parameters (?h - hand ?o - movable ?p - place)
    :precondition (and (holding ?h ?o) (accessible ?p))
    :effect (and (handempty ?h) (not (holding ?h ?o)) (at ?o ?p) (flat ?o) (clear ?o)))
  (:action stack :parameters (?h - hand ?o ?b - movable ?p - region)
    :precondition (and (holding ?h ?o) (clear ?b) (at ?b ?p))
    :effect (and (handempty ?h) (not (holding ?h ?o)) (on ?o ?b) (at ?o ?p) (clear ?o) (not (clear ?b))))
  (:action unstack :parameters (?h - hand ?o ?b - movable ?p - region)
    :precondition (and (handempty ?h) (on ?o ?b) (clear ?o) (at ?o ?p))
    :effect (and (holding ?h ?o) (not (handempty ?h)) (not (on ?o ?b)) (not (at ?o ?p)) (not (clear ?o)) (clear ?b)))
  (:action open-drawer :parameters (?h - hand ?d - drawer) :precondition (and (handempty ?h) (closed ?d))
    :effect (and (opened ?d) (accessible ?d) (not (closed ?d))))
  (:action close-drawer :parameters (?h - hand ?d - drawer) :precondition (and (handempty ?h) (opened ?d))
    :effect (and (closed ?d) (not (opened ?d)) (not (accessible ?d))))))";

const char* const kGripper = R"((define (domain gripper) (:requirements :strips :typing) (:types room ball gripper)
  (:predicates (at-robby ?r - room) (at ?b - ball ?r - room) (free ?g - gripper) (carry ?b - ball ?g - gripper))
  (:action move :parameters (?a ?b - room) :precondition (at-robby ?a)
    :effect (and (at-robby ?b) (not (at-robby ?a))))
  (:action pick :parameters (?b - ball ?r - room ?g - gripper)
    :precondition (and (at ?b ?r) (at-robby ?r) (free ?g))
    :effect (and (carry ?b ?g) (not (at ?b ?r)) (not (free ?g))))
  (:action drop :parameters (?b - ball ?r - room ?g - gripper) :precondition (and (carry ?b ?g) (at-robby ?r))
    :effect (and (at ?b ?r) (free ?g) (not (carry ?b ?g))))))";

std::vector<std::string> shuffled(const std::string& stem, std::int64_t count, Random& random) {
  std::vector<std::string> names;
  for (std::int64_t i = 0; i < count; ++i) names.push_back(stem + std::to_string(i));
  for (std::int64_t i = count - 1; i > 0; --i) std::swap(names[i], names[random.below(i + 1)]);
  return names;
}

std::string names_text(const std::string& stem, std::int64_t count, const std::string& type) {
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) text += stem + std::to_string(i) + " ";
  return text + "- " + type + " ";
}

std::string problem_text(const std::string& domain, const std::string& objects, const std::string& init,
                         const std::string& goal) {
  return "(define (problem p) (:domain " + domain + ") (:objects " + objects + ")\n  (:init" + init +
         ")\n  (:goal (and" + goal + ")))\n";
}

std::string towers(std::int64_t count, Random& random, bool goal) {
  std::string text, below;
  for (const std::string& name : shuffled("b", count, random)) {
    const bool on_table = below.empty() || random.below(4) == 0;
    if (!goal && !below.empty() && on_table) text += " (clear " + below + ")";
    if (!on_table) text += " (on " + name + " " + below + ")";
    if (on_table && !goal) text += " (ontable " + name + ")";
    below = name;
  }
  return goal ? text : text + " (clear " + below + ") (handempty)";
}

// Objects in regions, in stacks there, and in drawers.
std::string layout(std::int64_t count, std::int64_t regions, std::int64_t drawers, Random& random, bool goal) {
  std::string text, below, place;
  for (const std::string& name : shuffled("o", count, random)) {
    const bool stacked = !below.empty() && place[0] == 'r' && random.below(3) == 0;
    if (!below.empty() && !stacked && !goal) text += " (clear " + below + ")";
    if (!stacked) {
      place = random.below(5) == 0 ? "d" + std::to_string(random.below(drawers))
                                   : "r" + std::to_string(random.below(regions));
    }
    text += " (at " + name + " " + place + ")";
    if (stacked) text += " (on " + name + " " + below + ")";
    if (!stacked && !goal) text += " (flat " + name + ")";
    below = name;
  }
  return goal ? text : text + " (clear " + below + ")";
}

}  // namespace

PlanningProblem blocks(std::int64_t count, std::int64_t seed) {
  Random random(RandomKey("bench blocks").with(count).with(seed));
  const std::string init = towers(count, random, false), goal = towers(count, random, true);
  return {kBlocks, problem_text("blocks", names_text("b", count, "block"), init, goal)};
}

PlanningProblem tabletop(std::int64_t count, std::int64_t seed) {
  Random random(RandomKey("bench tabletop").with(count).with(seed));
  const std::int64_t regions = 4 + count / 5, drawers = 2 + count / 20;
  std::string init = layout(count, regions, drawers, random, false) + " (handempty hand0)";
  std::string goal = layout(count, regions, drawers, random, true);
  for (std::int64_t i = 0; i < regions; ++i) init += " (accessible r" + std::to_string(i) + ")";
  for (std::int64_t i = 0; i < drawers; ++i) {
    init += " (closed d" + std::to_string(i) + ")";
    goal += " (closed d" + std::to_string(i) + ")";
  }
  const std::string objects = names_text("o", count, "movable") + names_text("r", regions, "region") +
                              names_text("d", drawers, "drawer") + "hand0 - hand";
  return {kTabletop, problem_text("tabletop", objects, init, goal)};
}

PlanningProblem gripper(std::int64_t count, std::int64_t seed) {
  Random random(RandomKey("bench gripper").with(count).with(seed));
  std::string init = " (at-robby r0) (free left) (free right)", goal;
  for (std::int64_t i = 0; i < count; ++i) {
    const std::int64_t from = random.below(4) == 0 ? 1 : 0;
    init += " (at b" + std::to_string(i) + " r" + std::to_string(from) + ")";
    goal += " (at b" + std::to_string(i) + " r" + std::to_string(1 - from) + ")";
  }
  return {kGripper,
          problem_text("gripper", names_text("b", count, "ball") + names_text("r", 2, "room") + "left right - gripper",
                       init, goal)};
}

}  // namespace stampede::bench
