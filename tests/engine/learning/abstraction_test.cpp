#include <catch2/catch.hpp>

#include "engine/learning/abstraction.h"
#include "engine/learning/plan_score.h"
#include "disguise.h"
#include "walks.h"

using namespace stampede;
using namespace stampede::learning;

namespace {

// What someone's domain might look like: all renamed, arguments turned round, `empty` denied, the hand left out.
const char* const kDisguised = R"((define (domain mine)
  (:requirements :strips :typing :negative-preconditions)
  (:types brick place chest)
  (:predicates (busy) (grasped ?x) (beneath ?t ?b) (shut ?c) (ajar ?c) (contains ?c ?b) (top ?b) (jammed ?c))
  (:action a1 :parameters (?c - chest) :precondition (and (not (busy)) (shut ?c) (not (jammed ?c)))
    :effect (and (ajar ?c) (not (shut ?c))))
  (:action a2 :parameters (?t - place ?b - brick)
    :precondition (and (not (busy)) (beneath ?t ?b) (top ?b))
    :effect (and (grasped ?b) (busy) (not (beneath ?t ?b)) (top ?t)))
  (:action a3 :parameters (?t - place ?b - brick) :precondition (and (grasped ?b) (top ?t) (not (= ?t ?b)))
    :effect (and (not (grasped ?b)) (not (busy)) (beneath ?t ?b) (not (top ?t))))
  (:action a4 :parameters (?c - chest ?b - brick) :precondition (and (grasped ?b) (ajar ?c))
    :effect (and (not (grasped ?b)) (not (busy)) (contains ?c ?b)))))";

// The classifiers of that domain, of which `noise` in a thousand answers are wrong.
std::vector<JudgedFrame> judged(const test::Walk& walk, int noise, std::uint64_t seed) {
  Random random(RandomKey("noise").with(static_cast<std::int64_t>(seed)));
  std::vector<JudgedFrame> frames;
  for (const Sample& sample : walk.samples) {
    JudgedFrame frame{{}, {}, sample.facts, sample.objects};
    const auto say = [&](Fact fact, bool truth) {
      if (random.below(1000) < noise) truth = !truth;
      (truth ? frame.yes : frame.no).insert(std::move(fact));
    };
    const auto holds = [&](const char* predicate, std::vector<std::string> arguments) {
      return sample.facts.contains({predicate, std::move(arguments)});
    };
    say({"busy", {}}, !holds("empty", {"hand"}));
    for (const TypedObject& a : *sample.objects) {
      const bool block = a.type == "cube" || a.type == "cylinder", drawer = a.type == "drawer";
      if (block) frame.yes.insert({"brick", {a.name}});
      if (block || a.type == "table") frame.yes.insert({"place", {a.name}});
      if (drawer) frame.yes.insert({"chest", {a.name}});
      if (block) say({"grasped", {a.name}}, holds("holding", {"hand", a.name}));
      if (block) say({"top", {a.name}}, holds("clear", {a.name}));
      if (drawer) say({"shut", {a.name}}, holds("closed", {a.name}));
      if (drawer) say({"ajar", {a.name}}, holds("open", {a.name}));
      if (drawer) say({"jammed", {a.name}}, holds("stuck", {a.name}));
      for (const TypedObject& b : *sample.objects) {
        if (b.type != "cube" && b.type != "cylinder") continue;
        if (a.name != b.name && (block || a.type == "table")) say({"beneath", {a.name, b.name}}, holds("on", {b.name, a.name}));
        if (drawer) say({"contains", {a.name, b.name}}, holds("inside", {b.name, a.name}));
      }
    }
    frames.push_back(std::move(frame));
  }
  return frames;
}

}  // namespace

TEST_CASE("a disguised domain is recognised") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 20, 60, 5);
  const Domain mine = domain_from_pddl(kDisguised, "mine.pddl");
  const auto all = test::all_actions(truth);
  for (int noise : {0, 10, 50}) {
  const Mapping mapping = find_mapping(mine, truth, judged(walk, noise, 1), predicates_of_actions(truth, all));
  for (auto& l : mapping.links) printf("%s   %.3f %.3f %.3f\n", to_text(l).c_str(), l.agreement, l.precision, l.recall);
  for (auto& t : mapping.types) printf("%s = %s %.2f\n", t.learned.c_str(), t.truth.c_str(), t.overlap);
  for (auto& t : mapping.missing) printf("missing %s\n", t.c_str());
  const Translation translated = in_true_words(mine, mapping, truth);
  if (!noise) printf("%s", to_pddl(translated.domain).c_str());
  for (auto& n : translated.notes) printf("%s\n", n.c_str());
  const auto matches = match_actions(translated.domain, truth, all);
  const OperatorScore score = score_operators(translated.domain, truth, matches, all, walk.samples);
  for (auto& m : matches) printf("%s -> %s %.2f\n", m.learned.c_str(), m.truth.c_str(), m.likeness);
  for (const auto& one : score.calls)
    printf("%s cases %d app %.2f %.2f chg %.2f %.2f\n", one.action.c_str(), one.cases, one.applicable.precision(), one.applicable.recall(), one.changes.precision(), one.changes.recall());
  std::vector<PlannedProblem> problems;
  for (int i = 0; i < 20; ++i) {
    Random draw(RandomKey("problem").with(i));
    problems.push_back(plan_with(translated.domain, truth, test::table_problem(truth, 4, draw, i % 2 ? "(and (on b1 b2) (on b2 b3))" : "(and (inside b1 d2) (on b2 b3))"), matches));
    if (!problems.back().valid) printf("%s\n", problems.back().reason.c_str());
  }
  PlanScore plans = summary(problems);
  printf("sound %.2f complete %.2f cost %.2f expanded %.2f coverage %.2f\n", plans.soundness(), plans.completeness(), plans.cost_ratio, plans.expanded_ratio, mapping.coverage);
  }
}

TEST_CASE("probe") {
  const Domain truth = test::table_domain();
  const test::Walk walk = test::walk(truth, 20, 60, 5);
  const auto all = test::all_actions(truth);
  const test::Disguise disguise(truth, {{"on", {"p1", true}}, {"empty", {"p2", false, true}}, {"holding", {"p3", true, true}}, {"clear", {"p4", false, true}}, {"open", {"p5"}}, {"closed", {"p6", false, true}}, {"inside", {"p7", true}}, {"movable", {"p8", false, false, true}}, {"stuck", {"p9"}}});
  const Domain mine = disguise.domain();
  for (int noise : {0, 10, 50}) {
  Random random(RandomKey("n").with(noise));
  std::vector<JudgedFrame> frames;
  for (auto& x : walk.samples) frames.push_back(disguise.judge(x, noise, random));
  const Mapping mapping = find_mapping(mine, truth, frames, predicates_of_actions(truth, all));
  for (auto& l : mapping.links) printf("%s   %.3f %.3f %.3f\n", to_text(l).c_str(), l.agreement, l.precision, l.recall);
  for (auto& t : mapping.types) printf("%s = %s %.2f\n", t.learned.c_str(), t.truth.c_str(), t.overlap);
  for (auto& t : mapping.missing) printf("missing %s\n", t.c_str());
  const Translation translated = in_true_words(mine, mapping, truth);
  if (!noise) printf("%s", to_pddl(translated.domain).c_str());
  for (auto& n : translated.notes) printf("%s\n", n.c_str());
  const auto matches = match_actions(translated.domain, truth, all);
  const OperatorScore score = score_operators(translated.domain, truth, matches, all, walk.samples);
  for (auto& m : matches) printf("%s -> %s %.2f\n", m.learned.c_str(), m.truth.c_str(), m.likeness);
  for (const auto& one : score.calls)
    printf("%s cases %d app %.2f %.2f chg %.2f %.2f\n", one.action.c_str(), one.cases, one.applicable.precision(), one.applicable.recall(), one.changes.precision(), one.changes.recall());
  std::vector<PlannedProblem> problems;
  for (int i = 0; i < 20; ++i) {
    Random draw(RandomKey("problem").with(i));
    problems.push_back(plan_with(translated.domain, truth, test::table_problem(truth, 4, draw, i % 2 ? "(and (on b1 b2) (on b2 b3))" : "(and (inside b1 d2) (on b2 b3))"), matches));
    if (!problems.back().valid) printf("%s\n", problems.back().reason.c_str());
  }
  PlanScore plans = summary(problems);
  printf("sound %.2f complete %.2f cost %.2f expanded %.2f coverage %.2f\n", plans.soundness(), plans.completeness(), plans.cost_ratio, plans.expanded_ratio, mapping.coverage);
  }
  for (int kind : {0, 1}) {
    Random random(RandomKey("n").with(7));
    std::vector<JudgedFrame> frames;
    for (auto& x : walk.samples) {
      JudgedFrame f = disguise.judge(x, 0, random);
      Facts whole; for (auto* s : {&f.yes, &f.no}) for (auto& q : *s) if (!mine.types.contains(q.predicate)) whole.insert(q);
      f.yes.clear(); f.no.clear();
      for (auto& q : whole) {
        bool b = kind ? random.below(2) : Random(RandomKey("atom").with(to_text(q)).with((std::int64_t)x.objects.get())).below(2);
        (b ? f.yes : f.no).insert(q);
      }
      frames.push_back(f);
    }
    const Mapping mapping = find_mapping(mine, truth, frames, predicates_of_actions(truth, all));
    for (auto& l : mapping.links) printf("%s   %.3f %.3f %.3f\n", to_text(l).c_str(), l.agreement, l.precision, l.recall);
    printf("coverage %.2f\n", mapping.coverage);
  }
}
