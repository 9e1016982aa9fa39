// The fuzzer's entry, driven by a few thousand mutants of sound texts: always the same ones.
#include "fuzz_pddl.h"

#include <catch2/catch.hpp>

#include "engine/base/random.h"

using namespace stampede;

namespace {

const char* const kTexts[] = {
    "(define (domain d) (:requirements :adl :action-costs) (:types a - object b c - a) (:constants k - b)\n"
    "  (:predicates (p ?x - a) (q ?x ?y) (r)) (:functions (total-cost) - number (f ?x - a) - number)\n"
    "  (:derived (r) (exists (?x - b) (and (p ?x) (not (q ?x k)))))\n"
    "  (:action go ;@ skill go case far distinct guards 1\n"
    "    :parameters (?x - b ?y) :precondition (and (not (= ?x ?y)) (imply (p ?x) (forall (?z - c) (q ?z ?y))))\n"
    "    :effect (and (when (r) (not (p ?x))) (forall (?z - b) (q ?x ?z)) (increase (total-cost) (f ?x)))))",
    "(define (problem p) (:domain d) (:objects cup - thing cellar - room) (:init (in cup hall) (= (far hall cellar) 3)"
    " (= (total-cost) 0)) (:goal (or (in cup cellar) (forall (?r - room) (lit ?r)))) (:metric minimize (total-cost)))",
    "0.5: (go cup hall--door) [1]\n(wait) ; then\n",
};

const char* const kPieces[] = {"(",      ")",
                               "-",      "?",
                               " ",      "--",
                               ";@ ",    "- -",
                               "(and)",  "forall",
                               ":types", "object",
                               "?x",     "(either a b)",
                               "=",      "not",
                               "\n",     "99999999999999999999",
                               "\xff",   ":action"};

std::string mutant(Random& random) {
  std::string text = kTexts[random.below(std::size(kTexts))];
  for (std::int64_t changes = 1 + random.below(4); changes > 0; --changes) {
    const auto at = static_cast<std::size_t>(random.below(static_cast<std::int64_t>(text.size()) + 1));
    const auto length = static_cast<std::size_t>(random.below(12));
    const std::string taken = text.substr(at, length);
    const std::int64_t kind = random.below(4);
    if (kind != 2) text.erase(at, length);
    if (kind == 1) text.insert(at, kPieces[random.below(std::size(kPieces))]);
    if (kind == 2) text.insert(at, kPieces[random.below(std::size(kPieces))]);
    if (kind == 3)
      text.insert(static_cast<std::size_t>(random.below(static_cast<std::int64_t>(text.size()) + 1)), taken);
  }
  return text;
}

}  // namespace

TEST_CASE("mutants of sound PDDL are read or refused with a place, and what is read is written as itself") {
  Random random(RandomKey("mutants of PDDL"));
  for (int i = 0; i < 4000; ++i) {
    const std::string text = mutant(random);
    INFO(text);
    REQUIRE_NOTHROW(test::read_as_pddl(reinterpret_cast<const std::uint8_t*>(text.data()), text.size()));
  }
}
