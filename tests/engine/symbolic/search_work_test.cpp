// What the planner does on its way to a plan, step by step as it ever did: grounding, landmarks, searches, shortening.
// A change that is meant changes the table too: the test leaves the new one beside the old one's name in the build
// folder.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "engine/base/hash.h"
#include "engine/symbolic/ground.h"
#include "engine/symbolic/landmark_graph.h"
#include "engine/symbolic/pddl.h"
#include "engine/symbolic/search.h"
#include "random_worlds.h"

using namespace stampede;

namespace {

struct Puzzle {
  std::string name;
  Domain domain;
  Problem problem;
};

// All texts are PDDL.
Puzzle puzzle_of(const std::string& name, const std::string& domain, const std::string& objects,
                 const std::string& init, const std::string& goal) {
  Domain read = domain_from_pddl("(define (domain d) " + domain + ")", name);
  Problem problem = problem_from_pddl(
      "(define (problem p) (:domain d) (:objects " + objects + ") (:init " + init + ") (:goal (and " + goal + ")))",
      name, read);
  return {name, std::move(read), std::move(problem)};
}

std::string numbered(const char* letter, std::int64_t i) { return letter + std::to_string(i); }

Puzzle blocks(Random& random, int count) {
  const auto towers = [&] {  // each block on one that is there already, or on the table
    std::string facts, last = "t";
    for (int i = 0; i < count; ++i) {
      const std::string block = numbered("b", i);
      const bool begins = random.below(3) == 0;
      facts += "(on " + block + " " + (begins ? "t" : last) + ")";
      last = block;
    }
    return facts;
  };
  std::string objects;
  for (int i = 0; i < count; ++i) objects += numbered("b", i) + " ";
  return puzzle_of(numbered("blocks", count),
                   "(:types block place) (:predicates (on ?b - block ?s) (clear ?s))"
                   "(:derived (clear ?s) (not (exists (?b - block) (on ?b ?s))))"
                   "(:action move :parameters (?b - block ?from ?to - block) :precondition (and (clear ?b) (clear ?to)"
                   " (on ?b ?from) (not (= ?b ?to))) :effect (and (on ?b ?to) (not (on ?b ?from))))"
                   "(:action lift :parameters (?b - block ?to - block) :precondition (and (clear ?b) (clear ?to)"
                   " (on ?b t) (not (= ?b ?to))) :effect (and (on ?b ?to) (not (on ?b t))))"
                   "(:action drop :parameters (?b - block ?from - block) :precondition (and (clear ?b) (on ?b ?from))"
                   " :effect (and (on ?b t) (not (on ?b ?from)))) (:constants t - place)",
                   objects + "- block", towers(),
                   "(on b0 b1)" + (count > 3 ? "(on b1 b2)(not (on b3 t))" : std::string()));
}

// Parcels by van within a town, by plane between towns, which costs nine times as much.
Puzzle parcels(Random& random, int count) {
  std::string objects, init, goal;
  for (int town = 0; town < 3; ++town) {
    const std::string t = numbered("t", town), hub = numbered("hub", town), van = numbered("van", town);
    objects += t + " - town " + van + " - van " + hub + " ";
    init += "(in " + hub + " " + t + ")(port " + hub + ")(at " + van + " " + hub + ")";
    for (int i = 0; i < 2; ++i) {
      objects += numbered("p", 2 * town + i) + " ";
      init += "(in " + numbered("p", 2 * town + i) + " " + t + ")";
    }
    objects += "- place ";
  }
  for (int i = 0; i < count; ++i) {
    objects += numbered("c", i) + " - parcel ";
    init += "(at " + numbered("c", i) + " " + numbered("p", random.below(6)) + ")";
    goal += "(at " + numbered("c", i) + " " + numbered("p", random.below(6)) + ")";
  }
  return puzzle_of(
      numbered("parcels", count),
      "(:types town place thing - object van plane - carrier carrier parcel - thing)"
      "(:predicates (at ?x - thing ?p - place) (in ?p - place ?t - town) (port ?p - place)"
      " (aboard ?c - parcel ?v - carrier)) (:functions (total-cost) - number)"
      "(:action drive :parameters (?v - van ?a ?b - place ?t - town) :precondition (and (at ?v ?a) (in ?a ?t)"
      " (in ?b ?t) (not (= ?a ?b))) :effect (and (at ?v ?b) (not (at ?v ?a)) (increase (total-cost) 1)))"
      "(:action fly :parameters (?v - plane ?a ?b - place) :precondition (and (at ?v ?a) (port ?a) (port ?b)"
      " (not (= ?a ?b))) :effect (and (at ?v ?b) (not (at ?v ?a)) (increase (total-cost) 9)))"
      "(:action load :parameters (?c - parcel ?v - carrier ?p - place) :precondition (and (at ?c ?p)"
      " (at ?v ?p)) :effect (and (aboard ?c ?v) (not (at ?c ?p)) (increase (total-cost) 1)))"
      "(:action unload :parameters (?c - parcel ?v - carrier ?p - place) :precondition (and (aboard ?c ?v)"
      " (at ?v ?p)) :effect (and (at ?c ?p) (not (aboard ?c ?v)) (increase (total-cost) 1)))",
      objects + "plane0 - plane", init + "(at plane0 hub0)", goal);
}

// A walk through locked doors: keys lie about, one is carried at a time, and light switches change with each step.
Puzzle doors(Random& random, int rooms) {
  std::string objects, init = "(here r0)(empty)";
  for (int i = 0; i < rooms; ++i) {
    objects += numbered("r", i) + " - room " + numbered("k", i) + " - key ";
    if (i == 0) continue;
    const std::string a = numbered("r", i), b = numbered("r", random.below(i));
    init += "(next " + a + " " + b + ")(next " + b + " " + a + ")(fits " + numbered("k", i) + " " + a + ")(locked " +
            a + ")";
    init += "(lies " + numbered("k", i) + " " + numbered("r", random.below(i)) + ")";
  }
  return puzzle_of(
      numbered("doors", rooms),
      "(:types room key) (:predicates (here ?r - room) (next ?a ?b - room) (fits ?k - key ?r - room)"
      " (locked ?r - room) (lies ?k - key ?r - room) (held ?k - key) (empty) (lit ?r - room) (way ?r - room))"
      "(:derived (way ?r - room) (or (here ?r) (exists (?o - room) (and (next ?o ?r) (way ?o)"
      " (not (locked ?r))))))"
      "(:action go :parameters (?a ?b - room) :precondition (and (here ?a) (way ?b) (not (= ?a ?b)))"
      " :effect (and (here ?b) (not (here ?a)) (when (lit ?a) (not (lit ?a)))"
      " (when (not (lit ?b)) (lit ?b))))"
      "(:action unlock :parameters (?a ?b - room ?k - key) :precondition (and (here ?a) (next ?a ?b)"
      " (locked ?b) (held ?k) (fits ?k ?b)) :effect (not (locked ?b)))"
      "(:action take :parameters (?k - key ?r - room) :precondition (and (here ?r) (lies ?k ?r) (empty))"
      " :effect (and (held ?k) (not (lies ?k ?r)) (not (empty))))"
      "(:action leave :parameters (?k - key ?r - room) :precondition (and (here ?r) (held ?k))"
      " :effect (and (lies ?k ?r) (not (held ?k)) (empty)))",
      objects, init,
      "(here " + numbered("r", rooms - 1) + ")(lit " + numbered("r", rooms - 1) +
          ")(not (locked r1))(forall (?k - key) (not (held ?k)))");
}

// Balls that nothing tells apart, but for two that are wanted; two hands.
Puzzle crowd(Random& random, int count) {
  std::string objects, init = "(at_robby a)(free left)(free right)", goal = "(exists (?x - ball) (at ?x a))";
  for (int i = 0; i < count; ++i) {
    objects += numbered("ball", i) + " ";
    init += "(at " + numbered("ball", i) + " " + (i < 2 ? "b" : random.below(2) == 0 ? "a" : "c") + ")";
  }
  goal += "(at ball0 a)(at ball1 c)(exists (?x ?y - ball) (and (not (= ?x ?y)) (at ?x b) (at ?y b)))";
  return puzzle_of(
      numbered("crowd", count),
      "(:types ball room hand) (:constants left right - hand a b c - room)"
      "(:predicates (at ?x - ball ?r - room) (at_robby ?r - room) (free ?h - hand) (carry ?x - ball ?h - hand))"
      "(:action walk :parameters (?from ?to - room) :precondition (and (at_robby ?from) (not (= ?from ?to)))"
      " :effect (and (at_robby ?to) (not (at_robby ?from))))"
      "(:action take :parameters (?x - ball ?r - room ?h - hand) :precondition (and (at ?x ?r) (at_robby ?r)"
      " (free ?h)) :effect (and (carry ?x ?h) (not (at ?x ?r)) (not (free ?h))))"
      "(:action put :parameters (?x - ball ?r - room ?h - hand) :precondition (and (carry ?x ?h)"
      " (at_robby ?r)) :effect (and (at ?x ?r) (free ?h) (not (carry ?x ?h))))",
      objects + "- ball", init, goal);
}

std::string hash_of(const Plan& plan) { return content_hash(to_text(plan)).substr(0, 8); }

std::string landmarks_of(const symbolic::GroundTask& task, const symbolic::Heuristic& heuristic,
                         const symbolic::Words& start) {
  const symbolic::LandmarkGraph graph(task, heuristic.relaxation(), start);
  Hasher hasher;
  for (const auto* list : {&graph.node, &graph.goals})
    for (const int number : *list) hasher.number(number);
  std::size_t orders = 0;
  for (const auto* lists : {&graph.before, &graph.needed_for, &graph.needs, &graph.takes_away}) {
    for (const std::vector<int>& list : *lists) {
      orders += list.size();
      hasher.number(list.size());
      for (const int number : list) hasher.number(number);
    }
  }
  return std::to_string(graph.size()) + " landmarks " + std::to_string(orders) + " orders " +
         hasher.digest().substr(0, 8);
}

// All that can be counted, in a line.
std::string work_on(const Puzzle& puzzle) {
  using namespace symbolic;
  const GroundTask task = ground(lift(puzzle.domain, puzzle.problem), {});
  std::string line = puzzle.name + ": " + std::to_string(task.basic) + " of " + std::to_string(task.facts) + " facts " +
                     std::to_string(task.operators.size()) + " operators " + std::to_string(task.axioms.size()) +
                     " axioms " + std::to_string(task.reachable.size()) + " reachable";
  if (task.solvable()) {
    const Semantics semantics(task);
    Heuristic heuristic(task);
    const int h = heuristic.evaluate(semantics.initial());
    line += ", h " + std::to_string(h) + " " + std::to_string(heuristic.applicable().size()) + " applicable " +
            std::to_string(heuristic.preferred().size()) + " preferred, " +
            landmarks_of(task, heuristic, semantics.initial());
    for (const int weight : {0, 1, 3}) {
      PlanLimits few;
      few.expansions = 3000;
      const SearchResult found =
          lazy_search(task, semantics, heuristic, few, {semantics.initial(), task.goal, weight, weight == 3 ? 40 : 0});
      line += ", " + std::to_string(found.evaluated) + "/" + std::to_string(found.expanded) + " to " +
              std::to_string(found.plan.size());
    }
    PlanLimits few;
    few.expansions = 2000;
    for (const bool strict : {false, true}) {
      Landmarks landmarks(task, heuristic.relaxation(), semantics.initial());
      const SearchResult found = lazy_search(task, semantics, heuristic, few,
                                             {semantics.initial(), task.goal, 0, 0, &landmarks, nullptr, strict});
      line += ", by landmarks " + std::to_string(found.evaluated) + "/" + std::to_string(found.expanded) + " to " +
              std::to_string(found.plan.size());
    }
    const SearchResult wide = width_search(task, semantics, heuristic, few, {semantics.initial(), task.goal});
    line += ", by width " + std::to_string(wide.evaluated) + "/" + std::to_string(wide.expanded) + " to " +
            std::to_string(wide.plan.size());
  }
  PlanLimits limits;
  limits.expansions = 20'000;
  const PlanOutcome outcome = solve(puzzle.domain, puzzle.problem, limits);
  line += "; " + to_text(outcome.end) + " " + std::to_string(outcome.evaluated) + "/" +
          std::to_string(outcome.expanded) + " cost " + std::to_string(outcome.cost) + " steps " +
          std::to_string(outcome.plan.size()) + " " + hash_of(outcome.plan);
  limits.memory_bytes = 200'000;
  const PlanOutcome small = solve(puzzle.domain, puzzle.problem, limits);
  line += "; in 200 kB " + to_text(small.end) + " " + std::to_string(small.evaluated);
  PlanLimits few;
  few.expansions = 2000, few.improve = 500;
  const std::vector<Plan> several = solve_many(puzzle.domain, puzzle.problem, 3, few);
  line += "; " + std::to_string(several.size()) + " plans";
  for (const Plan& plan : several) line += " " + hash_of(plan);
  return line;
}

}  // namespace

TEST_CASE("the planner does on its way what it ever did") {
  std::vector<Puzzle> puzzles;
  for (int i = 0; i < 8; ++i) {
    Random random(RandomKey("puzzle").with(i));
    puzzles.push_back(blocks(random, 3 + i));
    puzzles.push_back(parcels(random, 1 + i));
    puzzles.push_back(doors(random, 3 + i));
    puzzles.push_back(crowd(random, 4 + 2 * i));
  }
  for (int i = 0; i < 60; ++i) {
    Random random(RandomKey("world").with(i));
    test::RandomWorld world(random);
    puzzles.push_back({"random " + std::to_string(i), std::move(world.domain), std::move(world.problem)});
  }
  std::ifstream stored(STAMPEDE_SOURCE_DIR "/tests/engine/symbolic/search_work.txt");
  std::ofstream now("search_work.txt");
  INFO("meant? then: cp " << std::filesystem::current_path() / "search_work.txt"
                          << " tests/engine/symbolic/");
  for (const Puzzle& puzzle : puzzles) {
    const std::string line = work_on(puzzle);
    now << line << "\n";
    std::string expected;
    std::getline(stored, expected);
    CHECK(line == expected);
  }
  std::string more;
  CHECK_FALSE(std::getline(stored, more));
}
