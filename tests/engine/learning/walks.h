// What a random walk in a domain shows: transitions with labels, states, problems.
#pragma once

#include <algorithm>
#include <string>

#include "engine/base/random.h"
#include "engine/learning/experience.h"
#include "engine/learning/operator_score.h"
#include "engine/symbolic/evaluation.h"
#include "engine/symbolic/pddl.h"

namespace stampede::test {

// Blocks, a table, a hand; `clear` is derived, `under_lid` can forbid what nothing else tells.
inline const char* const kTable = R"((define (domain table)
  (:requirements :strips :typing :derived-predicates :negative-preconditions)
  (:types cube cylinder - block block table - thing hand - object drawer - object)
  (:predicates (empty ?h - hand) (holding ?h - hand ?b - block) (on ?b - block ?t - thing) (closed ?d - drawer)
    (open ?d - drawer) (inside ?b - block ?d - drawer) (clear ?b - block) (movable ?b - object) (stuck ?d - drawer))
  (:derived (clear ?b - block) (not (exists (?c - block) (on ?c ?b))))
  (:action open_it :parameters (?d - drawer ?h - hand)
    :precondition (and (empty ?h) (closed ?d) (not (stuck ?d)))
    :effect (and (open ?d) (not (closed ?d))))
  (:action pick :parameters (?b - block ?t - thing ?h - hand)
    :precondition (and (movable ?b) (empty ?h) (on ?b ?t) (clear ?b))
    :effect (and (holding ?h ?b) (not (empty ?h)) (not (on ?b ?t))))
  (:action put :parameters (?b - block ?t - table ?h - hand)
    :precondition (holding ?h ?b)
    :effect (and (not (holding ?h ?b)) (empty ?h) (on ?b ?t)))
  (:action put_in :parameters (?b - block ?d - drawer ?h - hand)
    :precondition (and (holding ?h ?b) (open ?d))
    :effect (and (not (holding ?h ?b)) (empty ?h) (inside ?b ?d)))
  (:action stack :parameters (?b ?c - block ?h - hand)
    :precondition (and (holding ?h ?b) (clear ?c) (not (= ?b ?c)))
    :effect (and (not (holding ?h ?b)) (empty ?h) (on ?b ?c)))))";

inline Domain table_domain() { return domain_from_pddl(kTable, "table.pddl"); }

// `blocks` on the table, some of them on each other; two drawers, one of which may be stuck.
inline Problem table_problem(const Domain& domain, int blocks, Random& random, const std::string& goal = "(and)") {
  std::string objects = "(:objects hand - hand board - table d1 d2 - drawer", init = "(:init (empty hand)";
  std::vector<std::string> tops = {"board"};
  for (int i = 1; i <= blocks; ++i) {
    const std::string name = "b" + std::to_string(i);
    objects += " " + name + (random.below(2) == 0 ? " - cube" : " - cylinder");
    const auto on = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(tops.size())));
    init += " (movable " + name + ") (on " + name + " " + tops[on] + ")";
    if (on > 0) tops.erase(tops.begin() + static_cast<std::ptrdiff_t>(on));
    tops.push_back(name);
  }
  init += " (closed d1) (closed d2)";
  if (random.below(2) == 0) init += " (stuck d1)";
  return problem_from_pddl("(define (problem p) (:domain table) " + objects + ") " + init + ") (:goal " + goal + "))",
                           "walk.pddl", domain);
}

struct Walk {
  learning::Experience experience;
  std::vector<learning::Sample> samples;
};

// `tries` calls of random actions with arguments of the right types; those that cannot be taken are failures.
inline Walk walk(const Domain& domain, int scenes, int tries, std::uint64_t seed) {
  Random random(RandomKey("walk").with(static_cast<std::int64_t>(seed)));
  Walk result;
  result.experience.types = domain.types;
  for (int scene = 0; scene < scenes; ++scene) {
    const Problem problem = table_problem(domain, 3 + static_cast<int>(random.below(3)), random);
    const auto objects = std::make_shared<const std::vector<TypedObject>>(problem.objects);
    Facts basic = problem.init;
    for (int i = 0; i < tries; ++i) {
      const auto which = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(domain.actions.size())));
      const Action& action = domain.actions[which];
      learning::Transition one;
      one.skill = action.name;
      for (const Parameter& parameter : action.parameters) {
        std::vector<std::string> fit;
        for (const TypedObject& object : *objects)
          if (domain.is_a(object.type, parameter.type)) fit.push_back(object.name);
        one.arguments.push_back(fit[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(fit.size())))]);
      }
      one.before = with_derived(basic, domain, *objects);
      one.objects = objects;
      Problem at = problem;
      at.init = basic;
      at.goal = {};
      one.success = validate(domain, at, {{action.name, one.arguments}}).valid;
      if (one.success) basic = apply(action, one.arguments, basic, domain, *objects);
      one.after = with_derived(basic, domain, *objects);
      result.samples.push_back({objects, one.before});
      result.experience.transitions.push_back(std::move(one));
    }
  }
  return result;
}

inline std::set<std::string> all_actions(const Domain& domain) {
  std::set<std::string> names;
  for (const Action& one : domain.actions) names.insert(one.name);
  return names;
}

}  // namespace stampede::test
