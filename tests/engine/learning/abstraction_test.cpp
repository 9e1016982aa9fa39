// Domains whose meaning is known, so disguised that only it is left.
#include "engine/learning/abstraction.h"

#include <catch2/catch.hpp>

#include "disguise.h"
#include "engine/base/error.h"
#include "engine/learning/plan_score.h"
#include "walks.h"

using namespace stampede;
using namespace stampede::learning;

namespace {

// All renamed, half of it with arguments turned round, half of it denied; `movable` has no counterpart.
const std::map<std::string, test::Mask> kMasks = {{"clear", {"p4", false, true}},
                                                  {"closed", {"p6"}},
                                                  {"empty", {"p2", false, true}},
                                                  {"holding", {"p3", true, true}},
                                                  {"inside", {"p7", true}},
                                                  {"movable", {"p8", false, false, true}},
                                                  {"on", {"p1", true}},
                                                  {"open", {"p5"}},
                                                  {"stuck", {"p9"}}};

std::vector<JudgedFrame> judged(const test::Disguise& disguise, const test::Walk& walk, int wrong) {
  Random random(RandomKey("wrong").with(static_cast<std::int64_t>(wrong)));
  std::vector<JudgedFrame> frames;
  for (const Sample& one : walk.samples) frames.push_back(disguise.judge(one, wrong, random));
  return frames;
}

const PredicateLink& link_of(const Mapping& mapping, const std::string& learned) {
  for (const PredicateLink& one : mapping.links)
    if (one.learned == learned) return one;
  throw Error("test", "no link of " + learned);
}

PlanScore planned(const Domain& learned, const Domain& truth) {
  const auto matches = match_actions(learned, truth, test::all_actions(truth));
  std::vector<PlannedProblem> problems;
  for (int i = 0; i < 10; ++i) {
    Random random(RandomKey("problem").with(i));
    const char* goal = i % 2 == 0 ? "(and (inside b1 d2) (on b2 b3))" : "(and (on b1 b2) (on b2 b3))";
    problems.push_back(plan_with(learned, truth, test::table_problem(truth, 4, random, goal), matches));
  }
  return summary(std::move(problems));
}

Domain domain_of(const std::string& predicates) {
  return domain_from_pddl("(define (domain mine) (:predicates " + predicates + "))", "mine.pddl");
}

}  // namespace

TEST_CASE("a disguised domain is recognised, with up to five wrong answers in a hundred") {
  const Domain truth = test::table_domain();
  const auto all = test::all_actions(truth);
  const test::Walk walk = test::walk(truth, 20, 60, 5);
  const test::Disguise disguise(truth, kMasks);
  const Domain mine = disguise.domain();
  const int wrong = GENERATE(0, 10, 50);  // in a thousand
  CAPTURE(wrong);
  const Mapping mapping = find_mapping(mine, truth, judged(disguise, walk, wrong), predicates_of_actions(truth, all));
  std::set<std::string> texts;
  for (const PredicateLink& one : mapping.links) texts.insert(to_text(one));
  CHECK(texts == std::set<std::string>{"p1 = (on ?2 ?1)", "p2 = (not (empty ?1))", "p3 = (not (holding ?2 ?1))",
                                       "p4 = (not (clear ?1))", "p5 = (open ?1)", "p6 = (closed ?1)",
                                       "p7 = (inside ?2 ?1)", "p9 = (stuck ?1)"});
  CHECK(mapping.missing == std::vector<std::string>{"movable"});
  CHECK(mapping.types.size() == truth.types.size());
  for (const TypeLink& one : mapping.types) CHECK(one.learned == "k" + one.truth);
  if (wrong == 0) CHECK(mapping.coverage == Approx(8.0 / 9));
  CHECK(mapping.coverage > 0.65);
  CHECK(mapping.coverage < 0.9);

  const Translation translated = in_true_words(mine, mapping, truth);
  CHECK(translated.notes.empty());
  const auto matches = match_actions(translated.domain, truth, all);
  const OperatorScore score = score_operators(translated.domain, truth, matches, all, walk.samples);
  CHECK(score.applicable.f1() == 1);  // all blocks are movable: nothing is lost
  CHECK(score.changes.f1() == 1);
  CHECK(score.preconditions.missed == 1);
  const PlanScore plans = planned(translated.domain, truth);
  CHECK(plans.soundness() == 1);
  CHECK(plans.completeness() == 1);
}

TEST_CASE("an abstraction by chance means nothing, whether it changes all the time or never") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 20, 60, 5);
  const test::Disguise disguise(truth, kMasks);
  const Domain mine = disguise.domain();
  const bool steady = GENERATE(true, false);
  Random random(RandomKey("chance"));
  std::vector<JudgedFrame> frames = judged(disguise, walk, 0);
  for (JudgedFrame& frame : frames) {
    Facts atoms = frame.no;
    for (const Fact& fact : frame.yes)
      if (!mine.types.contains(fact.predicate)) atoms.insert(fact);
    frame.yes.clear();
    frame.no.clear();
    for (const Fact& atom : atoms) {
      // Of each scene its own.
      const std::string scene = std::to_string(frame.truth.size()) + frame.objects->back().type;
      Random drawn(RandomKey("atom").with(to_text(atom) + scene));
      ((steady ? drawn : random).below(2) == 0 ? frame.yes : frame.no).insert(atom);
    }
  }
  const Mapping mapping = find_mapping(mine, truth, frames, predicates_of_actions(truth, test::all_actions(truth)));
  CHECK(mapping.coverage < 0.1);
  const Domain translated = in_true_words(mine, mapping, truth).domain;
  CHECK(planned(translated, truth).completeness() == 0);
}

TEST_CASE("the hand may be left out, or added, and what is fixed is said so") {
  const Domain truth = test::table_domain();
  const Domain mine = domain_of("(grasped ?b) (busy) (ajar ?d ?h)");
  std::vector<JudgedFrame> frames;
  for (const Sample& one : test::walk(truth, 20, 60, 5).samples) {
    JudgedFrame frame{{}, {}, one.facts, one.objects};
    const auto say = [&](bool holds, Fact fact) { (holds ? frame.yes : frame.no).insert(std::move(fact)); };
    say(!one.facts.contains({"empty", {"hand"}}), {"busy", {}});
    for (const TypedObject& object : *one.objects) {
      if (truth.is_a(object.type, "block"))
        say(one.facts.contains({"holding", {"hand", object.name}}), {"grasped", {object.name}});
      if (object.type == "drawer") say(one.facts.contains({"open", {object.name}}), {"ajar", {object.name, "hand"}});
    }
    frames.push_back(std::move(frame));
  }
  const Mapping mapping = find_mapping(mine, truth, frames, {"holding", "empty", "open", "on"});
  CHECK(to_text(link_of(mapping, "grasped")) == "grasped = (holding the hand ?1)");
  CHECK(to_text(link_of(mapping, "busy")) == "busy = (not (empty the hand))");
  CHECK(to_text(link_of(mapping, "ajar")) == "ajar = (open ?1)");
  CHECK(mapping.missing == std::vector<std::string>{"on"});
  CHECK(mapping.coverage == Approx(0.75));
}

TEST_CASE("what no single literal means is found as two at once") {
  const Domain truth = test::table_domain();
  const Domain mine = domain_of("(takeable ?b ?t) (openable ?d)");
  std::vector<JudgedFrame> frames;
  for (const Sample& one : test::walk(truth, 20, 60, 5).samples) {
    JudgedFrame frame{{}, {}, one.facts, one.objects};
    const auto say = [&](bool holds, Fact fact) { (holds ? frame.yes : frame.no).insert(std::move(fact)); };
    for (const TypedObject& a : *one.objects) {
      if (a.type == "drawer")
        say(one.facts.contains({"closed", {a.name}}) && !one.facts.contains({"stuck", {a.name}}),
            {"openable", {a.name}});
      for (const TypedObject& b : *one.objects)
        if (truth.is_a(a.type, "block") && truth.is_a(b.type, "thing") && a.name != b.name)
          say(one.facts.contains({"on", {a.name, b.name}}) && one.facts.contains({"clear", {a.name}}),
              {"takeable", {a.name, b.name}});
    }
    frames.push_back(std::move(frame));
  }
  const Mapping mapping = find_mapping(mine, truth, frames, {});
  CHECK(link_of(mapping, "takeable").agreement == Approx(1));
  CHECK(to_text(link_of(mapping, "takeable")) == "takeable = (on ?1 ?2) and (clear ?1)");
  CHECK(link_of(mapping, "openable").agreement == Approx(1));
  CHECK(link_of(mapping, "openable").parts.size() == 2);
}

TEST_CASE("a table that says only what holds is completed by what does not") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 20, 60, 5);
  const test::Disguise disguise(truth, {});
  std::vector<JudgedFrame> frames = judged(disguise, walk, 0);
  for (JudgedFrame& frame : frames) frame.no.clear();
  complete(frames);
  const Mapping mapping = find_mapping(disguise.domain(), truth, frames, {"on", "holding", "open"});
  CHECK(mapping.coverage == Approx(1));
  CHECK(to_text(link_of(mapping, "on")) == "on = (on ?1 ?2)");
}

TEST_CASE("facts that the table does not speak of lower the agreement with them") {
  const Domain truth = test::table_domain();
  const Domain mine = domain_of("(beneath ?t ?b)");
  std::vector<JudgedFrame> frames;
  for (const Sample& one : test::walk(truth, 20, 60, 5).samples) {
    JudgedFrame frame{{}, {}, one.facts, one.objects};
    for (const TypedObject& block : *one.objects)  // of the table alone, of which it is always right
      if (truth.is_a(block.type, "block"))
        (one.facts.contains({"on", {block.name, "board"}}) ? frame.yes : frame.no)
            .insert({"beneath", {"board", block.name}});
    frames.push_back(std::move(frame));
  }
  std::set<std::string> needed = {"on"};
  const Mapping mapping = find_mapping(mine, truth, frames, needed);
  CHECK(link_of(mapping, "beneath").parts.at(0).truth == "on");
  JudgedFrame silent = frames.front();
  silent.yes.clear();
  silent.no.clear();
  for (int i = 0; i < 9000; ++i) frames.push_back(silent);  // nine frames in ten say nothing
  CHECK(find_mapping(mine, truth, frames, needed).missing == std::vector<std::string>{"on"});
}
