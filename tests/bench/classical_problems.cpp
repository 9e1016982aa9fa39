#include "classical_problems.h"

#include <vector>

#include "engine/base/random.h"

namespace stampede::bench {
namespace {

const char* const kLogistics = R"((define (domain logistics) (:requirements :strips :typing)
  (:types truck airplane - vehicle package vehicle - thing airport - place city place thing - object)
  (:predicates (in-city ?p - place ?c - city) (at ?t - thing ?p - place) (in ?p - package ?v - vehicle))
  (:action drive :parameters (?t - truck ?a ?b - place ?c - city)
    :precondition (and (at ?t ?a) (in-city ?a ?c) (in-city ?b ?c))
    :effect (and (not (at ?t ?a)) (at ?t ?b)))
  (:action fly :parameters (?p - airplane ?a ?b - airport) :precondition (at ?p ?a)
    :effect (and (not (at ?p ?a)) (at ?p ?b)))
  (:action load :parameters (?o - package ?v - vehicle ?p - place) :precondition (and (at ?v ?p) (at ?o ?p))
    :effect (and (not (at ?o ?p)) (in ?o ?v)))
  (:action unload :parameters (?o - package ?v - vehicle ?p - place) :precondition (and (at ?v ?p) (in ?o ?v))
    :effect (and (not (in ?o ?v)) (at ?o ?p)))))";

const char* const kTravel = R"((define (domain travel) (:requirements :strips :typing)
  (:types aircraft person - thing city level thing - object)
  (:predicates (at ?t - thing ?c - city) (in ?p - person ?a - aircraft) (fuel ?a - aircraft ?l - level)
    (next ?l ?m - level))
  (:action board :parameters (?p - person ?a - aircraft ?c - city) :precondition (and (at ?p ?c) (at ?a ?c))
    :effect (and (not (at ?p ?c)) (in ?p ?a)))
  (:action leave :parameters (?p - person ?a - aircraft ?c - city) :precondition (and (in ?p ?a) (at ?a ?c))
    :effect (and (not (in ?p ?a)) (at ?p ?c)))
  (:action fly :parameters (?a - aircraft ?c ?d - city ?l ?m - level)
    :precondition (and (at ?a ?c) (fuel ?a ?l) (next ?m ?l))
    :effect (and (not (at ?a ?c)) (at ?a ?d) (not (fuel ?a ?l)) (fuel ?a ?m)))
  (:action hurry :parameters (?a - aircraft ?c ?d - city ?l ?m ?n - level)
    :precondition (and (at ?a ?c) (fuel ?a ?l) (next ?m ?l) (next ?n ?m))
    :effect (and (not (at ?a ?c)) (at ?a ?d) (not (fuel ?a ?l)) (fuel ?a ?n)))
  (:action refuel :parameters (?a - aircraft ?c - city ?l ?m - level)
    :precondition (and (fuel ?a ?l) (next ?l ?m) (at ?a ?c))
    :effect (and (fuel ?a ?m) (not (fuel ?a ?l))))))";

const char* const kStorage = R"((define (domain storage) (:requirements :typing)
  (:types hoist surface place area - object container depot - place store transit - area area crate - surface)
  (:predicates (clear ?s - store) (in ?x - surface ?p - place) (free ?h - hoist) (lifting ?h - hoist ?c - crate)
    (at ?h - hoist ?a - area) (on ?c - crate ?s - store) (linked ?a ?b - area))
  (:action lift :parameters (?h - hoist ?c - crate ?a - store ?b - area ?p - place)
    :precondition (and (linked ?b ?a) (at ?h ?b) (free ?h) (on ?c ?a) (in ?a ?p))
    :effect (and (not (on ?c ?a)) (clear ?a) (not (free ?h)) (lifting ?h ?c) (not (in ?c ?p))))
  (:action drop :parameters (?h - hoist ?c - crate ?a - store ?b - area ?p - place)
    :precondition (and (linked ?b ?a) (at ?h ?b) (lifting ?h ?c) (clear ?a) (in ?a ?p))
    :effect (and (not (lifting ?h ?c)) (free ?h) (not (clear ?a)) (on ?c ?a) (in ?c ?p)))
  (:action move :parameters (?h - hoist ?a ?b - store) :precondition (and (at ?h ?a) (clear ?b) (linked ?a ?b))
    :effect (and (not (at ?h ?a)) (at ?h ?b) (not (clear ?b)) (clear ?a)))
  (:action leave :parameters (?h - hoist ?a - store ?b - transit) :precondition (and (at ?h ?a) (linked ?a ?b))
    :effect (and (not (at ?h ?a)) (at ?h ?b) (clear ?a)))
  (:action enter :parameters (?h - hoist ?a - transit ?b - store)
    :precondition (and (at ?h ?a) (linked ?a ?b) (clear ?b))
    :effect (and (not (at ?h ?a)) (at ?h ?b) (not (clear ?b))))))";

const char* const kSatellite = R"((define (domain satellite) (:requirements :strips :typing)
  (:types satellite instrument mode direction)
  (:predicates (aboard ?i - instrument ?s - satellite) (supports ?i - instrument ?m - mode)
    (target ?i - instrument ?d - direction) (points ?s - satellite ?d - direction) (power ?s - satellite)
    (running ?i - instrument) (calibrated ?i - instrument) (picture ?d - direction ?m - mode))
  (:action turn :parameters (?s - satellite ?to ?from - direction) :precondition (points ?s ?from)
    :effect (and (points ?s ?to) (not (points ?s ?from))))
  (:action switch-on :parameters (?i - instrument ?s - satellite) :precondition (and (aboard ?i ?s) (power ?s))
    :effect (and (running ?i) (not (calibrated ?i)) (not (power ?s))))
  (:action switch-off :parameters (?i - instrument ?s - satellite) :precondition (and (aboard ?i ?s) (running ?i))
    :effect (and (not (running ?i)) (power ?s)))
  (:action calibrate :parameters (?s - satellite ?i - instrument ?d - direction)
    :precondition (and (aboard ?i ?s) (target ?i ?d) (points ?s ?d) (running ?i)) :effect (calibrated ?i))
  (:action take :parameters (?s - satellite ?d - direction ?i - instrument ?m - mode)
    :precondition (and (calibrated ?i) (aboard ?i ?s) (supports ?i ?m) (running ?i) (points ?s ?d))
    :effect (picture ?d ?m))))";

const char* const kAssembly = R"((define (domain assembly) (:requirements :adl)
  (:types part resource)
  (:predicates (ready ?p - part) (in ?p ?whole - part) (part-of ?p ?whole - part) (before ?p ?q ?whole - part)
    (braces ?p ?whole - part) (needs ?whole - part ?r - resource) (free ?r - resource)
    (held ?r - resource ?whole - part))
  (:action hold :parameters (?r - resource ?whole - part) :precondition (free ?r)
    :effect (and (not (free ?r)) (held ?r ?whole)))
  (:action release :parameters (?r - resource ?whole - part) :precondition (held ?r ?whole)
    :effect (and (not (held ?r ?whole)) (free ?r)))
  (:action put-in :parameters (?p ?whole - part)
    :precondition (and (ready ?p) (or (part-of ?p ?whole) (braces ?p ?whole))
      (forall (?r - resource) (imply (needs ?whole ?r) (held ?r ?whole)))
      (forall (?q - part) (imply (before ?q ?p ?whole) (in ?q ?whole))))
    :effect (and (in ?p ?whole) (not (ready ?p))
      (when (and (forall (?q - part) (imply (part-of ?q ?whole) (or (= ?q ?p) (in ?q ?whole))))
                 (forall (?q - part) (imply (braces ?q ?whole) (and (not (in ?q ?whole)) (not (= ?q ?p))))))
        (ready ?whole))))
  (:action take-out :parameters (?p ?whole - part)
    :precondition (and (in ?p ?whole) (or (braces ?p ?whole) (part-of ?p ?whole))
      (forall (?r - resource) (imply (needs ?whole ?r) (held ?r ?whole)))
      (forall (?q - part) (imply (and (braces ?p ?whole) (before ?p ?q ?whole)) (in ?q ?whole)))
      (forall (?q - part) (imply (and (part-of ?p ?whole) (before ?q ?p ?whole)) (in ?q ?whole))))
    :effect (and (ready ?p) (not (in ?p ?whole))
      (when (and (braces ?p ?whole) (forall (?q - part) (imply (part-of ?q ?whole) (in ?q ?whole)))
                 (forall (?q - part) (imply (braces ?q ?whole) (or (= ?q ?p) (not (in ?q ?whole))))))
        (ready ?whole))))))";

const char* const kElevator = R"((define (domain elevator) (:requirements :adl)
  (:types passenger floor - object hurried alone escort child - passenger)
  (:predicates (from ?p - passenger ?f - floor) (to ?p - passenger ?f - floor) (above ?f ?g - floor)
    (boarded ?p - passenger) (served ?p - passenger) (lift-at ?f - floor) (barred ?p - passenger ?f - floor)
    (apart ?p ?q - passenger))
  (:action stop :parameters (?f - floor)
    :precondition (and (lift-at ?f)
      (forall (?p - passenger) (imply (barred ?p ?f) (not (boarded ?p))))
      (imply (exists (?p - child) (or (and (from ?p ?f) (not (served ?p))) (and (boarded ?p) (not (to ?p ?f)))))
             (exists (?q - escort) (or (and (boarded ?q) (not (to ?q ?f))) (and (from ?q ?f) (not (served ?q))))))
      (forall (?p ?q - passenger)
        (imply (apart ?p ?q) (or (not (boarded ?p)) (served ?q) (not (from ?q ?f)) (to ?p ?f))))
      (imply (exists (?p - hurried) (and (boarded ?p) (not (to ?p ?f))))
             (exists (?p - hurried) (and (boarded ?p) (to ?p ?f)))))
    :effect (and
      (forall (?p - passenger) (when (and (boarded ?p) (to ?p ?f)) (and (not (boarded ?p)) (served ?p))))
      (forall (?p - passenger) (when (and (from ?p ?f) (not (served ?p))) (boarded ?p)))))
  (:action up :parameters (?f ?g - floor) :precondition (and (lift-at ?f) (above ?g ?f))
    :effect (and (lift-at ?g) (not (lift-at ?f))))
  (:action down :parameters (?f ?g - floor) :precondition (and (lift-at ?f) (above ?f ?g))
    :effect (and (lift-at ?g) (not (lift-at ?f))))))";

std::string numbered(const char* stem, std::int64_t i) { return stem + std::to_string(i); }

std::string objects_of(const char* stem, std::int64_t count, const char* type) {
  std::string text;
  for (std::int64_t i = 0; i < count; ++i) text += numbered(stem, i) + " ";
  return text + "- " + type + "\n    ";
}

std::string fact(std::initializer_list<std::string> words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? " (" : " ") + word;
  return text + ")";
}

PlanningProblem of(const char* domain, const char* name, const std::string& objects, const std::string& init,
                   const std::string& goal) {
  return {domain, std::string("(define (problem p) (:domain ") + name + ") (:objects " + objects + ")\n  (:init" +
                      init + ")\n  (:goal (and" + goal + ")))\n"};
}

std::vector<std::int64_t> order_of(std::int64_t count, Random& random) {
  std::vector<std::int64_t> order;
  for (std::int64_t i = 0; i < count; ++i) order.push_back(i);
  for (std::int64_t i = count - 1; i > 0; --i) std::swap(order[i], order[random.below(i + 1)]);
  return order;
}

}  // namespace

PlanningProblem logistics(std::int64_t packages, std::int64_t seed) {
  Random random(RandomKey("bench logistics").with(packages).with(seed));
  const std::int64_t cities = 3 + packages / 6, places = 3, planes = 1 + cities / 5;
  std::string init, goal,
      objects = objects_of("c", cities, "city") + objects_of("k", packages, "package") +
                objects_of("t", cities, "truck") + objects_of("a", planes, "airplane");
  const auto place = [](std::int64_t city, std::int64_t i) { return numbered("l", city) + "-" + std::to_string(i); };
  for (std::int64_t city = 0; city < cities; ++city) {
    for (std::int64_t i = 0; i < places; ++i) {
      objects += place(city, i) + (i == 0 ? " - airport " : " - place ");
      init += fact({"in-city", place(city, i), numbered("c", city)});
    }
    init += fact({"at", numbered("t", city), place(city, random.below(places))});
  }
  for (std::int64_t i = 0; i < planes; ++i) init += fact({"at", numbered("a", i), place(random.below(cities), 0)});
  for (std::int64_t i = 0; i < packages; ++i) {
    init += fact({"at", numbered("k", i), place(random.below(cities), random.below(places))});
    goal += fact({"at", numbered("k", i), place(random.below(cities), random.below(places))});
  }
  return of(kLogistics, "logistics", objects, init, goal);
}

PlanningProblem travel(std::int64_t people, std::int64_t seed) {
  Random random(RandomKey("bench travel").with(people).with(seed));
  const std::int64_t cities = 4 + people / 2, aircraft = 2 + people / 5, levels = 7;
  std::string init, goal;
  for (std::int64_t i = 0; i + 1 < levels; ++i) init += fact({"next", numbered("f", i), numbered("f", i + 1)});
  for (std::int64_t i = 0; i < aircraft; ++i) {
    init += fact({"at", numbered("a", i), numbered("c", random.below(cities))});
    init += fact({"fuel", numbered("a", i), numbered("f", random.below(levels))});
    if (random.below(3) == 0) goal += fact({"at", numbered("a", i), numbered("c", random.below(cities))});
  }
  for (std::int64_t i = 0; i < people; ++i) {
    init += fact({"at", numbered("p", i), numbered("c", random.below(cities))});
    goal += fact({"at", numbered("p", i), numbered("c", random.below(cities))});
  }
  return of(kTravel, "travel",
            objects_of("a", aircraft, "aircraft") + objects_of("p", people, "person") +
                objects_of("c", cities, "city") + objects_of("f", levels, "level"),
            init, goal);
}

// Containers full of crates at a yard; depots are grids, entered at one side, with little more room than crates.
PlanningProblem storage(std::int64_t crates, std::int64_t seed) {
  Random random(RandomKey("bench storage").with(crates).with(seed));
  const std::int64_t depots = 1 + crates / 8, hoists = 1 + crates / 6, containers = (crates + 3) / 4;
  const std::int64_t width = 3, rows = (crates + hoists + depots * width - 1) / (depots * width) + 1;
  std::string stores, init, goal,
      objects = objects_of("h", hoists, "hoist") + objects_of("k", crates, "crate") +
                objects_of("container", containers, "container") + objects_of("depot", depots, "depot");
  const auto link = [&](const std::string& a, const std::string& b) {
    init += fact({"linked", a, b}) + fact({"linked", b, a});
  };
  const auto cell = [](std::int64_t depot, std::int64_t x, std::int64_t y) {
    return "s" + std::to_string(depot) + "-" + std::to_string(x) + "-" + std::to_string(y);
  };
  std::vector<std::string> free;
  for (std::int64_t depot = 0; depot < depots; ++depot) {
    for (std::int64_t x = 0; x < width; ++x) {
      for (std::int64_t y = 0; y < rows; ++y) {
        stores += cell(depot, x, y) + " ";
        init += fact({"in", cell(depot, x, y), numbered("depot", depot)});
        free.push_back(cell(depot, x, y));
        if (x > 0) link(cell(depot, x, y), cell(depot, x - 1, y));
        if (y > 0) link(cell(depot, x, y), cell(depot, x, y - 1));
      }
    }
    for (std::int64_t x = 0; x < width; ++x) link(cell(depot, x, 0), "yard");
  }
  for (std::int64_t i = 0; i < crates; ++i) {
    const std::string at = "c-" + std::to_string(i);
    const std::string container = numbered("container", i / 4);
    stores += at + " ";
    link(at, "yard");
    init +=
        fact({"in", at, container}) + fact({"on", numbered("k", i), at}) + fact({"in", numbered("k", i), container});
    goal += fact({"in", numbered("k", i), numbered("depot", random.below(100) % depots)});
  }
  for (std::int64_t i = 0; i < hoists; ++i) {
    const std::size_t at = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(free.size())));
    init += fact({"free", numbered("h", i)}) + fact({"at", numbered("h", i), free[at]});
    free.erase(free.begin() + static_cast<std::ptrdiff_t>(at));
  }
  for (const std::string& one : free) init += fact({"clear", one});
  return of(kStorage, "storage", objects + stores + "- store yard - transit", init, goal);
}

PlanningProblem satellite(std::int64_t pictures, std::int64_t seed) {
  Random random(RandomKey("bench satellite").with(pictures).with(seed));
  const std::int64_t satellites = 2 + pictures / 8, modes = 3 + pictures / 20, directions = 6 + pictures;
  std::string init, goal;
  std::int64_t instruments = 0;
  for (std::int64_t s = 0; s < satellites; ++s) {
    init +=
        fact({"power", numbered("s", s)}) + fact({"points", numbered("s", s), numbered("d", random.below(directions))});
    const std::int64_t own = 1 + random.below(3);
    for (std::int64_t i = 0; i < own; ++i, ++instruments) {
      init += fact({"aboard", numbered("i", instruments), numbered("s", s)});
      init += fact({"target", numbered("i", instruments), numbered("d", random.below(directions))});
      init += fact({"supports", numbered("i", instruments), numbered("m", instruments % modes)});
      for (std::int64_t mode = 0; mode < modes; ++mode) {
        if (mode != instruments % modes && random.below(3) == 0) {
          init += fact({"supports", numbered("i", instruments), numbered("m", mode)});
        }
      }
    }
    if (random.below(3) == 0) goal += fact({"points", numbered("s", s), numbered("d", random.below(directions))});
  }
  const std::int64_t known_modes = std::min(modes, instruments);
  for (std::int64_t i = 0; i < pictures; ++i) {
    goal += fact({"picture", numbered("d", i), numbered("m", random.below(known_modes))});
  }
  return of(kSatellite, "satellite",
            objects_of("s", satellites, "satellite") + objects_of("i", instruments, "instrument") +
                objects_of("m", modes, "mode") + objects_of("d", directions, "direction"),
            init, goal);
}

// A tree of assemblies of parts with a partial order in each; resources are few; a brace goes in first and out last.
PlanningProblem assembly(std::int64_t assemblies, std::int64_t seed) {
  Random random(RandomKey("bench assembly").with(assemblies).with(seed));
  const std::int64_t resources = 2 + assemblies / 10;
  std::string init, parts;
  std::int64_t leaves = 0, braces = 0;
  std::vector<std::vector<std::string>> parts_of(static_cast<std::size_t>(assemblies));
  for (std::int64_t i = 1; i < assemblies; ++i) {
    parts_of[static_cast<std::size_t>(random.below(i))].push_back(numbered("whole", i));
  }
  for (std::int64_t i = 0; i < assemblies; ++i) {
    const std::string whole = numbered("whole", i);
    std::vector<std::string>& own = parts_of[static_cast<std::size_t>(i)];
    for (std::int64_t more = own.empty() ? 2 : random.below(3); more > 0; --more, ++leaves) {
      own.push_back(numbered("leaf", leaves));
      init += fact({"ready", own.back()});
    }
    const std::vector<std::int64_t> order = order_of(static_cast<std::int64_t>(own.size()), random);
    for (std::size_t k = 0; k < order.size(); ++k) {
      const std::string& part = own[static_cast<std::size_t>(order[k])];
      init += fact({"part-of", part, whole});
      if (k > 0 && random.below(2) == 0) {
        const auto earlier = order[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(k)))];
        init += fact({"before", own[static_cast<std::size_t>(earlier)], part, whole});
      }
    }
    if (random.below(4) == 0) {
      const std::string brace = numbered("brace", braces++), last = own[static_cast<std::size_t>(order.back())];
      init += fact({"ready", brace}) + fact({"braces", brace, whole}) + fact({"before", brace, last, whole});
    }
    for (std::int64_t r = 0; r < resources; ++r) {
      if (random.below(resources) == 0) init += fact({"needs", whole, numbered("r", r)});
    }
    parts += whole + " ";
  }
  for (std::int64_t r = 0; r < resources; ++r) init += fact({"free", numbered("r", r)});
  const std::string objects = parts + objects_of("leaf", leaves, "part") +
                              (braces > 0 ? objects_of("brace", braces, "part") : "") +
                              objects_of("r", resources, "resource");
  return of(kAssembly, "assembly", objects, init, fact({"ready", "whole0"}));
}

PlanningProblem elevator(std::int64_t passengers, std::int64_t seed) {
  Random random(RandomKey("bench elevator").with(passengers).with(seed));
  const std::int64_t floors = 4 + passengers * 3 / 2;
  std::string init = fact({"lift-at", "f0"}), goal, objects = objects_of("f", floors, "floor");
  for (std::int64_t f = 0; f < floors; ++f) {
    for (std::int64_t g = f + 1; g < floors; ++g) init += fact({"above", numbered("f", g), numbered("f", f)});
  }
  for (std::int64_t i = 0; i < passengers; ++i) {
    const std::string name = numbered("p", i);
    const std::int64_t kind = i == 0 ? 2 : random.below(8);
    objects += name + (kind == 0   ? " - hurried "
                       : kind == 1 ? " - child "
                       : kind == 2 ? " - escort "
                                   : " - passenger ");
    const std::int64_t from = random.below(floors), to = (from + 1 + random.below(floors - 1)) % floors;
    init += fact({"from", name, numbered("f", from)}) + fact({"to", name, numbered("f", to)});
    goal += fact({"served", name});
    if (random.below(6) == 0) {
      const std::int64_t barred = random.below(floors);
      if (barred != from && barred != to) init += fact({"barred", name, numbered("f", barred)});
    }
    if (i > 0 && random.below(6) == 0) init += fact({"apart", name, numbered("p", random.below(i))});
  }
  return of(kElevator, "elevator", objects, init, goal);
}

const std::array<ClassicalDomain, 6> kClassicalDomains = {{{"logistics", logistics, {20, 40, 60}},
                                                           {"travel", travel, {10, 25, 50}},
                                                           {"storage", storage, {6, 10, 14}},
                                                           {"satellite", satellite, {20, 40, 60}},
                                                           {"assembly", assembly, {10, 30, 50}},
                                                           {"elevator", elevator, {10, 25, 50}}}};

}  // namespace stampede::bench
