// A small domain for the tests of this room: cups, a drawer, a hand.
#pragma once

#include "engine/symbolic/pddl.h"

namespace stampede::test {

inline const char* const kKitchen = R"((define (domain kitchen)
  (:requirements :strips :typing)
  (:types cup drawer shelf - thing)
  (:predicates
    (movable ?x - object) ;@ trait
    (surface ?x - object) ;@ trait
    (clear ?x) ;@ traits x:movable
    (closed ?d - drawer)
    (hand_empty)
    (holding ?o)
    (inside ?o - object ?d - drawer) ;@ label the {o} is in the {d}
    (on ?o ?s)
    (open ?d - drawer))
  (:derived (clear ?x) (and (movable ?x) (not (exists (?y) (on ?y ?x)))))
  (:action open ;@ skill open distinct
    :parameters (?d - drawer)
    :precondition (and (closed ?d) (hand_empty))
    :effect (and (open ?d) (not (closed ?d))))
  (:action pick ;@ skill pick distinct guards 3 traits o:movable s:surface
    :parameters (?o ?s)
    :precondition (and (movable ?o) (surface ?s) (not (= ?o ?s)) (hand_empty) (on ?o ?s) (clear ?o))
    :effect (and (holding ?o) (not (hand_empty)) (not (on ?o ?s))))
  (:action place ;@ skill place distinct guards 3 traits o:movable s:surface
    :parameters (?o ?s)
    :precondition (and (movable ?o) (surface ?s) (not (= ?o ?s)) (holding ?o))
    :effect (and (not (holding ?o)) (hand_empty) (on ?o ?s)))
  (:action put_in ;@ skill put_in distinct guards 2 traits o:movable
    :parameters (?o - object ?d - drawer)
    :precondition (and (movable ?o) (not (= ?o ?d)) (holding ?o) (open ?d))
    :effect (and (not (holding ?o)) (hand_empty) (inside ?o ?d)))))";

inline Domain kitchen() { return domain_from_pddl(kKitchen, "kitchen.pddl"); }

// cup1 stands on cup2, cup2 on the table; the drawer is closed.
inline Problem kitchen_problem(const Domain& domain, const std::string& goal) {
  return problem_from_pddl(
      "(define (problem tidy) (:domain kitchen) (:objects cup1 cup2 - cup chest--drawer - drawer "
      "table - shelf) (:init (movable cup1) (movable cup2) (surface cup1) (surface cup2) "
      "(surface table) (on cup1 cup2) (on cup2 table) (closed chest--drawer) (hand_empty)) (:goal " +
          goal + "))",
      "tidy.pddl", domain);
}

}  // namespace stampede::test
