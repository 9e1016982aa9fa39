// Operators and abstractions from the command line: learned, scored, planned with, run in physics; and bad answers.
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "db/plain_file.h"
#include "db/research/dataset.h"
#include "engine/symbolic/pddl.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

using Json = nlohmann::json;

// Data sets of a few episodes, made once; `other`: of other episodes.
class Operators {
 public:
  Operators() {
    run("demos.db", "0");
    run("other.db", "40");
    for (const char* problem : {"conditions", "segments_and_conditions", "inventions"})
      dataset(problem, "demos.db", "");
    dataset("conditions", "other.db", "other_");
  }
  std::string path(const std::string& name) const { return folder_ / name; }
  std::string answered(const std::string& baseline, const std::string& problem) const {
    const Said said =
        say({"baseline", baseline, folder_ / (problem + "_given"), "--out", folder_ / (baseline + ".json")});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return folder_ / (baseline + ".json");
  }
  Said score(const std::string& problem, const std::string& answers, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words = {"score", problem, answers, "--hidden", folder_ / (problem + "_hidden"), "--json"};
    words.insert(words.end(), more.begin(), more.end());
    return say(words);
  }
  PlainFile hidden(const std::string& problem) const {
    return PlainFile::open(folder_ / (problem + "_hidden/hidden.db"));
  }
  // Answers with this domain and these rows; the data set's own number where none is given.
  std::string answers(const std::string& problem, const std::string& domain, Json rows = Json::array(),
                      std::string dataset = {}) const {
    if (dataset.empty()) dataset = research::dataset_id(hidden(problem));
    const Json all = {{"dataset", dataset}, {"problem", problem}, {"answers", std::move(rows)}, {"domain", domain}};
    put(folder_, "answers.json", all.dump());
    return folder_ / "answers.json";
  }

 private:
  void run(const std::string& name, const std::string& seed) const {
    const Said said = say({"run", "pick_and_lift", "put_item_in_drawer", "--root", kRoot, "--episodes", "12", "--seed",
                           seed, "--out", folder_ / name});
    INFO(said.err);
    REQUIRE(said.code == kDone);
  }
  void dataset(const std::string& problem, const std::string& catalogue, const std::string& before) const {
    const Said said = say({"dataset", problem, folder_ / catalogue, "--out", folder_ / (before + problem + "_given"),
                           "--hidden", folder_ / (before + problem + "_hidden")});
    INFO(said.err);
    REQUIRE(said.code == kDone);
  }
  Folder folder_;
};

const Operators& operators() {
  static const Operators files;
  return files;
}

std::map<std::string, double> figures_of(const Said& said) {
  INFO(said.err);
  REQUIRE(said.code == kDone);
  std::map<std::string, double> figures;
  const Json all = Json::parse(said.out);
  for (const Json& one : all.at("figures")) figures[one.at("name")] = one.at("value");
  return figures;
}

std::string about(const Said& said, const std::string& figure) {
  const Json all = Json::parse(said.out);
  for (const Json& one : all.at("figures"))
    if (one.at("name") == figure) return one.at("about");
  return {};
}

void check_refused(const Said& said, const std::string& what) {
  INFO(said.err);
  CHECK(said.code == kBadInput);
  CHECK(says(said.err, what));
  CHECK(said.out.empty());
}

std::string true_domain(const std::string& problem) {
  return operators()
      .hidden(problem)
      .query("SELECT domain FROM problems WHERE domain IS NOT NULL LIMIT 1")
      .text(0, "domain");
}

// The true predicates at every third frame and wherever skills begin or end, under other names, turned round, half of
// them denied; without `open`.
Json disguised_rows() {
  const PlainFile hidden = operators().hidden("inventions");
  Json rows = Json::array();
  const Rows episodes = hidden.query("SELECT episode, frames FROM episodes WHERE split = 'test'");
  for (std::size_t i = 0; i < episodes.size(); ++i) {
    const std::int64_t episode = episodes.integer(i, "episode");
    const auto facts = [&](const std::string& predicate, std::int64_t frame) {
      std::set<std::pair<std::string, std::string>> found;
      const Rows all = hidden.query(
          "SELECT arg1, coalesce(arg2, '') AS arg2 FROM facts WHERE episode = ?1 AND predicate = ?2 AND first_frame <= "
          "?3 AND (end_frame > ?3 OR open_end)",
          {episode, predicate, frame});
      for (std::size_t k = 0; k < all.size(); ++k) found.insert({all.text(k, "arg1"), all.text(k, "arg2")});
      return found;
    };
    std::set<std::int64_t> frames;
    for (std::int64_t frame = 0; frame < episodes.integer(i, "frames"); frame += 3) frames.insert(frame);
    const Rows skills = hidden.query("SELECT first_frame, end_frame FROM skills WHERE episode = ?1", {episode});
    for (std::size_t k = 0; k < skills.size(); ++k)
      frames.insert({skills.integer(k, "first_frame"),
                     std::min(skills.integer(k, "end_frame"), episodes.integer(i, "frames") - 1)});
    for (const std::int64_t frame : frames) {
      const auto say_it = [&](const std::string& atom, bool holds) {
        rows.push_back({{"episode", episode}, {"frame", frame}, {"fact", atom}, {"holds", holds ? 1 : 0}});
      };
      const auto movable = facts("movable", frame), holding = facts("holding", frame), on = facts("on", frame);
      say_it("(busy)", facts("hand_empty", frame).empty());
      for (const auto& [thing, none] : movable) {
        say_it("(loose " + thing + ")", !holding.contains({"panda.hand", thing}));
        for (const auto& [under, nothing] : facts("support", frame))
          if (under != thing) say_it("(beneath " + under + " " + thing + ")", on.contains({thing, under}));
      }
      for (const auto& [part, none] : facts("openable", frame))
        say_it("(ajar " + part + ")", !facts("closed", frame).contains({part, ""}));
    }
  }
  return rows;
}

const char* const kMine =
    "(define (domain mine) (:requirements :adl) (:predicates (busy) (loose ?o) (beneath ?s ?o) (ajar ?d)) (:action "
    "grab "
    ":parameters (?o ?s) :precondition (and (not (busy)) (beneath ?s ?o) (loose ?o)) :effect (and (busy) (not (loose "
    "?o)) (not (beneath ?s ?o)))) (:action draw :parameters (?d) :precondition (and (not (busy)) (not (ajar ?d))) "
    ":effect (ajar ?d)))";

}  // namespace

TEST_CASE("operators learned from labelled skills make sound plans that physics carries out", "[operators]") {
  const Said said = operators().score("conditions", operators().answered("operators", "conditions"),
                                      {"--physics", "2", "--root", kRoot});
  const auto figures = figures_of(said);
  CHECK(figures.at("plans_sound") == 1);
  CHECK(figures.at("plans_complete") > 0.5);
  CHECK(figures.at("effects_recall") > 0.9);
  CHECK(figures.at("changes_f1") > 0.9);
  CHECK(figures.at("physics_success") > 0);
  CHECK(figures.at("physics_reference") > 0);
  CHECK(says(about(said, "action_pick"), "stands for pick (by name)"));
}

TEST_CASE("operators learned without labels are found by what they do", "[operators]") {
  const Said said = operators().score("segments_and_conditions",
                                      operators().answered("operators_unlabelled", "segments_and_conditions"));
  const auto figures = figures_of(said);
  CHECK(figures.contains("f1_within_10"));
  CHECK(says(about(said, "action_op1"), "stands for "));
  CHECK_FALSE(says(about(said, "action_op1"), "by name"));
  CHECK(figures.at("effects_precision") > 0.7);
}

TEST_CASE("the true domain as an answer has full marks, one without preconditions has not", "[operators]") {
  const std::string truth = true_domain("conditions");
  const auto full = figures_of(operators().score("conditions", operators().answers("conditions", truth)));
  for (const char* name : {"preconditions_f1", "effects_f1", "applicable_f1", "changes_f1", "plans_sound",
                           "plans_complete", "plan_cost_ratio", "plan_expanded_ratio"}) {
    INFO(name);
    CHECK(full.at(name) == 1);
  }
  Domain careless = domain_from_pddl(truth, "truth.pddl");
  for (Action& one : careless.actions) one.precondition = {};
  const auto poor = figures_of(operators().score("conditions", operators().answers("conditions", to_pddl(careless))));
  CHECK(poor.at("applicable_recall") == 1);
  CHECK(poor.at("applicable_precision") < 0.5);
  CHECK(poor.at("plans_sound") < 1);
}

TEST_CASE("another's predicates are recognised by what holds", "[operators]") {
  const Said said = operators().score("inventions", operators().answers("inventions", kMine, disguised_rows()));
  const auto figures = figures_of(said);
  CHECK(about(said, "predicate_busy") == "busy = (not (hand_empty the hand))");
  CHECK(about(said, "predicate_loose") == "loose = (not (holding the hand ?1))");
  CHECK(about(said, "predicate_beneath") == "beneath = (on ?2 ?1)");
  CHECK(about(said, "predicate_ajar") == "ajar = (not (closed ?1))");
  CHECK(figures.at("predicate_beneath") == Approx(1));
  CHECK(figures.contains("missing_inside"));
  CHECK(figures.at("coverage") < figures.at("coverage_changing"));
  CHECK(says(about(said, "action_grab"), "stands for pick"));
  CHECK(says(about(said, "action_draw"), "stands for open"));
}

TEST_CASE("to leave out what one is unsure of is no way to agree the more", "[operators]") {
  const Json all = disguised_rows();
  const auto some = [&](auto kept) {
    Json rows = Json::array();
    for (std::size_t i = 0; i < all.size(); ++i)
      if (kept(i, all[i])) rows.push_back(all[i]);
    return operators().score("inventions", operators().answers("inventions", kMine, rows));
  };
  check_refused(some([&](std::size_t i, const Json&) { return i < all.size() / 2; }), "frames that are asked about");
  // Here and there: an atom that is left out at all frames of an episode is none of its atoms.
  check_refused(some([](std::size_t i, const Json&) { return i * 2654435761U / 65536 % 2 == 0; }),
                "atoms at these frames");
  check_refused(some([&](std::size_t, const Json& row) {
                  return row.at("frame") != all.front().at("frame") || row.at("episode") != all.front().at("episode");
                }),
                "there is no answer for 1 of ");
  Json twice = all;
  twice.push_back(all.front());
  check_refused(operators().score("inventions", operators().answers("inventions", kMine, twice)), "is answered twice");
}

TEST_CASE("domains that are none are refused, with the place", "[operators]") {
  const auto refused = [](const std::string& domain, const std::string& what) {
    check_refused(operators().score("conditions", operators().answers("conditions", domain)), what);
  };
  refused("", "its domain is empty");
  refused("pick up the block", "domain:1:");
  refused("(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :precondition (q ?x) :effect (p ?x)))",
          "q");
  refused("(define (domain d) (:predicates (p ?x)))", "no action");
  const Json none = {{"dataset", research::dataset_id(operators().hidden("conditions"))}, {"answers", Json::array()}};
  std::ofstream(operators().path("none.json")) << none.dump();
  check_refused(operators().score("conditions", operators().path("none.json")), "'domain' is missing");
}

TEST_CASE("answers for another data set are refused", "[operators]") {
  const std::string other =
      research::dataset_id(PlainFile::open(operators().path("other_conditions_hidden/hidden.db")));
  check_refused(operators().score("conditions",
                                  operators().answers("conditions", true_domain("conditions"), Json::array(), other)),
                "answers for another data set");
}

TEST_CASE("actions without a match score nothing and break nothing", "[operators]") {
  const auto figures = figures_of(operators().score(
      "conditions",
      operators().answers("conditions",
                          "(define (domain d) (:predicates (sung ?x)) (:action sing :parameters (?x) :precondition "
                          "(and) :effect (sung ?x)))")));
  CHECK(figures.at("matched") == 0);
  CHECK(figures.at("applicable_f1") == 0);
  CHECK(figures.at("changes_f1") == 0);
  CHECK(figures.at("plans_made") == 0);
  CHECK(figures.at("action_sing") == 0);
}

TEST_CASE("what classifiers cannot have said is refused, with the row", "[operators]") {
  const std::int64_t episode = operators()
                                   .hidden("inventions")
                                   .query("SELECT min(episode) AS n FROM episodes WHERE split = 'test'")
                                   .integer(0, "n");
  const auto refused = [&](std::int64_t frame, const std::string& fact, std::int64_t holds, const std::string& what) {
    const Json row = {{"episode", episode}, {"frame", frame}, {"fact", fact}, {"holds", holds}};
    check_refused(operators().score("inventions", operators().answers("inventions", kMine, {row, row})), what);
  };
  refused(0, "(flies item)", 1, "declares no predicate or type `flies`");
  refused(0, "(busy item)", 1, "`busy` takes 0 arguments, not 1");
  refused(0, "busy", 1, "is no ground atom");
  refused(1'000'000, "(busy)", 1, "has no frame 1000000");
  refused(0, "(busy)", 2, "is 0 or 1");
  const Json yes = {{"episode", episode}, {"frame", 0}, {"fact", "(busy)"}, {"holds", 1}},
             no = {{"episode", episode}, {"frame", 0}, {"fact", "(busy)"}, {"holds", 0}};
  check_refused(operators().score("inventions", operators().answers("inventions", kMine, {yes, no})),
                "to hold and not to hold");
  check_refused(operators().score("inventions", operators().answers("inventions", kMine)), "what holds");
}

}  // namespace stampede::program
