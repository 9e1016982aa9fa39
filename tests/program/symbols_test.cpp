// Starts, goals, plans, worlds and problems in symbols, at the program's door.
#include <catch2/catch.hpp>

#include "db/catalogue.h"
#include "engine/bddl/bddl.h"
#include "engine/start/abstract_state.h"
#include "engine/symbolic/pddl.h"
#include "scripting/library/roots.h"
#include "scripting/session/constraints_fit.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

void put(const std::string& path, const std::string& text) {
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path, std::ios::binary) << text;
}

constexpr const char* kDomain = R"((define (domain rooms)
  (:requirements :strips :typing)
  (:types room)
  (:predicates (at ?r - room) (door ?a ?b - room))
  (:action go :parameters (?a ?b - room) :precondition (and (at ?a) (door ?a ?b))
    :effect (and (at ?b) (not (at ?a)))))
)";

std::string rooms(const std::string& goal) {
  return "(define (problem walk) (:domain rooms) (:objects a b c - room)\n  (:init (at a) (door a b) (door b c) (door "
         "a c))\n"
         "  (:goal " +
         goal + "))\n";
}

constexpr const char* kMugOnPlate =
    "(define (problem LIBERO_Tabletop_Manipulation) (:domain robosuite) (:language put the mug on the plate)\n"
    "(:regions (left (:target desk) (:ranges ((-0.03 -0.3 0.03 -0.27)))) (middle (:target desk) (:ranges ((0 -0.03 "
    "0.1 "
    "0.03)))))\n(:fixtures desk - table)\n(:objects porcelain_mug_1 - porcelain_mug plate_1 - plate)\n"
    "(:obj_of_interest plate_1)\n(:init (On plate_1 desk_left) (On porcelain_mug_1 desk_middle))\n"
    "(:goal (And (On porcelain_mug_1 plate_1))))\n";

// One start of a task that ships, run once for all the tests that only look at it.
const std::string& stored() {
  static const Folder folder;
  static const std::string file = [] {
    const Said said = say({"run", "put_item_in_drawer", "--variation", "level=top", "--seed", "1", "--root",
                           STAMPEDE_SOURCE_DIR, "--out", folder / "d.db"});
    INFO(said.err);
    REQUIRE(said.code == kDone);
    return folder / "d.db";
  }();
  return file;
}

}  // namespace

TEST_CASE("`plan` takes any PDDL: a plan, a proof that there is none, and giving up differ in text and exit code") {
  const Folder mine;
  put(mine / "d.pddl", kDomain);
  put(mine / "p.pddl", rooms("(at c)"));
  put(mine / "no.pddl", rooms("(door c a)"));
  const Said plan = say({"plan", mine / "d.pddl", mine / "p.pddl"});
  CHECK(plan.code == kDone);
  CHECK(plan.out == "(go a c)\n");
  const Said two = say({"plan", mine / "d.pddl", mine / "p.pddl", "--k", "2"});
  CHECK(says(two.out, "; plan 1: 1 steps"));
  CHECK(says(two.out, "(go a b)\n(go b c)\n"));
  const Said none = say({"plan", mine / "d.pddl", mine / "no.pddl"});
  CHECK(none.code == kNo);
  CHECK(says(none.err, "unsolvable (proved)"));
  CHECK(none.out.empty());
}

TEST_CASE("giving up at a limit is exit code 5 and says so") {
  const Folder mine;
  // A tower the other way round needs more than one expanded state.
  std::string init = "(clear b1) (ontable b9) (handempty)", goal = "(and", objects;
  for (int i = 1; i <= 9; ++i) objects += " b" + std::to_string(i);
  for (int i = 1; i < 9; ++i) init += " (on b" + std::to_string(i) + " b" + std::to_string(i + 1) + ")";
  for (int i = 1; i < 9; ++i)
    goal += " (on b" + std::to_string(i * 5 % 9 + 1) + " b" + std::to_string((i + 1) * 5 % 9 + 1) + ")";
  put(mine / "d.pddl",
      "(define (domain blocks) (:requirements :strips) (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (handempty) "
      "(holding ?x))\n"
      "(:action pick-up :parameters (?x) :precondition (and (clear ?x) (ontable ?x) (handempty)) :effect (and (not "
      "(ontable ?x)) (not (clear ?x)) (not (handempty)) (holding ?x)))\n"
      "(:action put-down :parameters (?x) :precondition (holding ?x) :effect (and (not (holding ?x)) (clear ?x) "
      "(handempty) (ontable ?x)))\n"
      "(:action stack :parameters (?x ?y) :precondition (and (holding ?x) (clear ?y)) :effect (and (not (holding ?x)) "
      "(not (clear ?y)) (clear ?x) (handempty) (on ?x ?y)))\n"
      "(:action unstack :parameters (?x ?y) :precondition (and (on ?x ?y) (clear ?x) (handempty)) :effect (and "
      "(holding "
      "?x) (clear ?y) (not (clear ?x)) (not (handempty)) (not (on ?x ?y)))))\n");
  put(mine / "p.pddl", "(define (problem tower) (:domain blocks) (:objects" + objects + ") (:init " + init +
                           ") (:goal " + goal + ")))\n");
  const Said said = say({"plan", mine / "d.pddl", mine / "p.pddl", "--expansions", "1"});
  INFO(said.err);
  CHECK(said.code == kBudgetSpent);
  CHECK(says(said.err, "gave up"));
  const Said whole = say({"plan", mine / "d.pddl", mine / "p.pddl"});
  REQUIRE(whole.code == kDone);
  put(mine / "plan.txt", whole.out);
  CHECK(say({"validate", mine / "d.pddl", mine / "p.pddl", mine / "plan.txt"}).code == kDone);
}

TEST_CASE("`validate` names the first action that cannot be taken and what it misses, or the goal") {
  const Folder mine;
  put(mine / "d.pddl", kDomain);
  put(mine / "p.pddl", rooms("(at c)"));
  const auto check = [&](const std::string& plan) {
    put(mine / "plan.txt", plan);
    return say({"validate", mine / "d.pddl", mine / "p.pddl", mine / "plan.txt"});
  };
  CHECK(check("0.0: (go a b) [1]\n1.0: (GO b c) [1]\n; cost = 2\n").code == kDone);
  const Said wrong = check("(go a b)\n(go a c)\n");
  CHECK(wrong.code == kNo);
  CHECK(says(wrong.out, "step 2 of 2"));
  CHECK(says(wrong.out, "(at a)"));
  const Said short_one = check("(go a b)\n");
  CHECK(short_one.code == kNo);
  CHECK(says(short_one.out, "the goal does not hold"));
  CHECK(says(short_one.out, "(at c)"));
  CHECK(check("(fly a b)\n").code != kDone);
}

TEST_CASE("bad PDDL at the program's door: place and cure, exit code 3, never a crash") {
  struct Case {
    std::string domain, problem, complaint;
  };
  const std::string good = rooms("(at c)"), domain = kDomain;
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
  };
  std::string deep = "(at c)";
  for (int i = 0; i < 1000; ++i) deep = "(not " + deep + ")";
  const std::vector<Case> cases = {
      {domain + ")", good, "d.pddl:"},
      {domain.substr(0, domain.size() - 3), good, "d.pddl:"},
      {with(domain, "(at ?b)", "(att ?b)"), good, "at"},
      {domain, with(good, "(door a b)", "(door a)"), "door"},
      {with(domain, "(:types room)", "(:types room - hall hall - room)"), good, "d.pddl"},
      {domain, with(good, "(at a)", "(at z)"), "z"},
      {domain, rooms("()"), "goal"},
      {domain, with(good, "a b c - room", "a A c - room"), "p.pddl"},
      {domain, rooms(deep), "p.pddl"},
      {domain, with(good, "(:domain rooms)", "(:domain halls)"), "p.pddl"},
  };
  for (const Case& one : cases) {
    const Folder mine;
    put(mine / "d.pddl", one.domain);
    put(mine / "p.pddl", one.problem);
    const Said said = say({"plan", mine / "d.pddl", mine / "p.pddl"});
    INFO(one.complaint + " -> " + said.err);
    CHECK(said.code == kBadInput);
    CHECK(says(said.err, one.complaint));
  }
  CHECK(say({"plan", "none.pddl", "none.pddl"}).code == kBadInput);
  CHECK(say({"plan", "/tmp", "/tmp"}).code == kBadInput);
}

TEST_CASE("a file of 50 MB is read or refused, not choked on") {
  const Folder mine;
  put(mine / "d.pddl", kDomain);
  std::string noise = rooms("(at c)") + ";";
  noise.resize(50'000'000, 'x');
  put(mine / "p.pddl", noise);
  CHECK(say({"plan", mine / "d.pddl", mine / "p.pddl"}).code == kDone);
  put(mine / "p.pddl", std::string(50'000'000, '('));
  CHECK(say({"plan", mine / "d.pddl", mine / "p.pddl"}).code == kBadInput);
}

TEST_CASE("goals and constraints are read before anything runs: what is not there is told with the nearest name") {
  const std::vector<std::pair<std::vector<std::string>, std::string>> cases = {
      {{"--goal", "(inside item chest.top_drawr)"}, "chest.top_drawer"},
      {{"--goal", "(insid item chest.top_drawer)"}, "inside"},
      {{"--goal", "(inside item)"}, "2 arguments"},
      {{"--goal", "(inside item chest.top_drawer"}, "--goal"},
      {{"--goal", ""}, "empty"},
      {{"--goal", "()"}, "--goal"},
      {{"--where", "(on itm table)"}, "item"},
      {{"--where", "(exists (?x - blok) (on ?x table))"}, "block"},
      {{"--where", "(on ?x table)"}, "?x"},
      {{"--where", "(and (colour item red) (colour item rde))"}, "(colour item rde)"},
      {{"--where", "(and (on item table) (colour chest red))"}, "(colour chest red)"},
      {{"--where", "(movable table)"}, "(movable table)"},
  };
  for (const auto& [options, complaint] : cases) {
    const Folder mine;
    std::vector<std::string> words = {"run",   "put_item_in_drawer", "--root", STAMPEDE_SOURCE_DIR,
                                      "--out", mine / "o.db"};
    words.insert(words.end(), options.begin(), options.end());
    const Said said = say(words);
    INFO(options[0] + " " + options[1] + " -> " + said.err);
    CHECK(said.code == kBadInput);
    CHECK(says(said.err, complaint));
    CHECK_FALSE(std::filesystem::exists(mine / "o.db"));
  }
  CHECK(say({"run", "put_item_in_drawer", "--skills", "3", "--root", STAMPEDE_SOURCE_DIR}).code == kUsage);
  CHECK(say({"run", "put_item_in_drawer", "--planner", "fd {domain}", "--root", STAMPEDE_SOURCE_DIR}).code == kUsage);
}

TEST_CASE("variations that contradict --where are left out") {
  const auto library = Library::load(make_roots(STAMPEDE_SOURCE_DIR, {}));
  RunOptions options;
  options.where = formula_option("(colour block1 red)", "--where");
  const Library::TaskInfo& task = task_info(*library, "stack_blocks");
  const std::vector<std::string> fitting =
      fitting_variations(library, task.name, matching_variations(task, "height=2"), 0, options);
  REQUIRE(fitting.size() == 1);
  CHECK(says(fitting[0], "colour=red"));
  CHECK_THROWS_AS(fitting_variations(library, task.name, matching_variations(task, "colour=blue,height=2"), 0, options),
                  Error);
}

TEST_CASE(
    "a task's start is a BDDL problem before anything has run, which imports as a task, or refused with the cure") {
  const Folder mine;
  const std::vector<std::string> plan = {"plan", "put_item_in_drawer", "--root", STAMPEDE_SOURCE_DIR, "--bddl"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), plan.begin(), plan.end());
    return say(more);
  };
  const Said libero = with({"libero", "--leave-out", "hand_empty"});
  REQUIRE(libero.code == kDone);
  CHECK(says(libero.out, "(in item chest_bottom_region)"));
  CHECK(says(libero.out, "; ours `on`, theirs `on`: weaker than theirs"));
  put(mine / "p.bddl", libero.out);
  const Said imported =
      say({"import", mine / "p.bddl", "--task", "mine", "--path", mine / "my", "--root", STAMPEDE_SOURCE_DIR});
  INFO(imported.err);
  CHECK(imported.code == kDone);
  CHECK(std::filesystem::exists(mine / "my/tasks/mine.lua"));
  CHECK(says(with({"behavior", "--leave-out", "hand_empty"}).out, "(inside ?block.n.01_1 ?cabinet.n.01_1)"));
  const Said refused = with({"libero"});
  CHECK(refused.code == kBadInput);
  CHECK(says(refused.err, "leave it out of the goal"));
}

TEST_CASE("a --where that predicates themselves rule out is refused before anything is placed, in our names") {
  const Folder mine;
  const Said said = say({"run", "put_item_in_drawer", "--root", STAMPEDE_SOURCE_DIR, "--out", mine / "o.db", "--where",
                         "(and (open chest.top_drawer) (closed chest.top_drawer))"});
  CHECK(said.code == kBadInput);
  CHECK(says(said.err, "can meet (and (open chest.top_drawer) (closed chest.top_drawer))"));
  for (const char* asked : {"(workable chest)", "(and (workable chest) (closed chest.top_drawer))"}) {
    const Said unfit =
        say({"run", "open_drawer", "--root", STAMPEDE_SOURCE_DIR, "--out", mine / "o.db", "--where", asked});
    CHECK(unfit.code == kBadInput);
    CHECK(says(unfit.err, "can meet (workable chest): chest is not openable, which ?part must be"));
  }
}

TEST_CASE("a start is made as --where says, another goal is reached, and the episode says both") {
  const Folder mine;
  const Said said =
      say({"run", "put_item_in_drawer", "--variation", "level=top", "--seed", "1", "--root", STAMPEDE_SOURCE_DIR,
           "--out", mine / "o.db", "--where", "(and (open chest--top_drawer) (hand_empty))", "--goal",
           "(and (closed chest.top_drawer) (on item table))"});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  const EpisodeRecord episode = Catalogue::open(mine / "o.db").read_episode(1);
  const Fact open{"open", {"chest.top_drawer"}}, closed{"closed", {"chest.top_drawer"}};
  CHECK(abstract_state(episode, 0).facts.contains(open));
  CHECK(abstract_state(episode, static_cast<std::int64_t>(episode.frames.size()) - 1).facts.contains(closed));
  CHECK(episode.made.options.contains("where"));
  CHECK(episode.made.options.contains("goal"));
}

TEST_CASE("what is drawn is drawn until an attribute is as --where says") {
  const Folder mine;
  const Said said =
      say({"plan", "put_item_in_drawer", "--where", "(colour item red)", "--pddl", "--root", STAMPEDE_SOURCE_DIR});
  INFO(said.err);
  CHECK(said.code == kDone);
  CHECK(says(said.out, "(colour item red)"));
}

TEST_CASE("a start that cannot be made is an episode that says which part failed how often") {
  const Folder mine;
  const Said said =
      say({"run", "put_item_in_drawer", "--variation", "level=top", "--seed", "1", "--root", STAMPEDE_SOURCE_DIR,
           "--out", mine / "o.db", "--where", "(and (inside item chest.top_drawer) (on item table))"});
  CHECK(said.code == kNo);
  const EpisodeRecord episode = Catalogue::open(mine / "o.db").read_episode(1);
  CHECK(episode.reason == Reason::init_impossible);
  CHECK(says(episode.detail, "item"));
  CHECK(says(episode.detail, " times"));
}

TEST_CASE("random behaviour draws as many skills as it is told and keeps what did not work") {
  const Folder mine;
  const Said said =
      say({"run", "put_item_in_drawer", "--variation", "level=top", "--seed", "1", "--root", STAMPEDE_SOURCE_DIR,
           "--out", mine / "o.db", "--behaviour", "random_applicable", "--skills", "3", "--on-failure", "recover"});
  CHECK((said.code == kDone || said.code == kNo));
  const EpisodeRecord episode = Catalogue::open(mine / "o.db").read_episode(1);
  CHECK(episode.made.options.at("behaviour") == "random_applicable");
  int skills = 0;
  for (const SegmentRecord& segment : episode.labels.segments) skills += segment.kind == SegmentKind::skill;
  CHECK(skills >= 1);
  CHECK(skills <= 3);
}

TEST_CASE("all tasks of a world store the same domain, byte for byte, named by its content") {
  const Said a = say({"plan", "put_item_in_drawer", "--pddl", "--root", STAMPEDE_SOURCE_DIR});
  const Said b = say({"plan", "stack_blocks", "--pddl", "--root", STAMPEDE_SOURCE_DIR});
  const Said ordered = say({"plan", "push_buttons", "--pddl", "--root", STAMPEDE_SOURCE_DIR});
  REQUIRE(a.code == kDone);
  REQUIRE(ordered.code == kDone);
  const auto domain = [](const std::string& text) { return text.substr(0, text.find("(define (problem")); };
  CHECK(domain(a.out).starts_with("(define (domain stampede-"));
  CHECK(domain(a.out) == domain(b.out));
  CHECK(domain(ordered.out).starts_with(domain(a.out).substr(0, 40)));
  const Said sized = say({"plan", "put_item_in_drawer", "--task-sized", "--root", STAMPEDE_SOURCE_DIR});
  CHECK(sized.code == kDone);
  CHECK(sized.out.size() < a.out.size());
  const EpisodeRecord episode = Catalogue::open(stored()).read_episode(1);
  CHECK(a.out.starts_with(*document_of(episode, DocumentKind::pddl_domain)));
}

TEST_CASE("`show --frame` says a moment as facts, sentences, PDDL and BDDL, and each reads back") {
  const auto show = [&](const std::string& form, const std::string& frame = "0") {
    return say({"show", stored(), "1", "--frame", frame, "--as", form, "--leave-out", "hand_empty"});
  };
  CHECK(says(show("facts").out, "(closed chest.top_drawer)\n"));
  CHECK(says(show("sentences").out, "chest.top_drawer is 0 % open"));
  const Catalogue catalogue = Catalogue::open(stored());
  const EpisodeRecord episode = catalogue.read_episode(1);
  const Domain domain = domain_from_pddl(*document_of(episode, DocumentKind::pddl_domain), "domain");
  const auto last = static_cast<std::int64_t>(episode.frames.size()) - 1;
  const Problem end = problem_from_pddl(show("pddl", std::to_string(last)).out, "end", domain);
  CHECK(holds(end.goal, with_derived(end.init, domain, end.objects), domain, end.objects));
  const Said libero = show("libero");
  REQUIRE(libero.code == kDone);
  CHECK(read_bddl(libero.out, "libero").problem.dialect == BddlDialect::libero);
  // What a dialect cannot say of the goal is left out by itself, and said.
  for (const char* form : {"libero", "behavior"}) {
    const Said plain = say({"show", stored(), "1", "--frame", "0", "--as", form});
    INFO(plain.err);
    CHECK(plain.code == kDone);
    CHECK(says(plain.out, "hand_empty panda--hand) is left out"));
    CHECK(plain.out == show(form).out);
  }
  CHECK(show("facts", "100000").code == kBadInput);
  CHECK(say({"show", stored(), "1", "--as", "pddl"}).code == kUsage);
  CHECK(says(say({"show", stored(), "1", "--frame", "0", "--json"}).out, "\"joint_fractions\""));
}

TEST_CASE("`export pddl`: the domain once, a problem at each boundary, and the plans of a success are valid") {
  const Folder mine;
  const Said said = say({"export", "pddl", stored(), "--out", mine / "out"});
  INFO(said.err);
  REQUIRE(said.code == kDone);
  int domains = 0, problems = 0;
  std::string domain_file;
  for (const auto& entry : std::filesystem::directory_iterator(mine / "out/domains")) {
    ++domains;
    domain_file = entry.path().string();
  }
  CHECK(domains == 1);
  for (const auto& entry : std::filesystem::directory_iterator(mine / "out/problems")) {
    if (entry.path().extension() != ".pddl") continue;
    ++problems;
    std::filesystem::path plan = entry.path();
    plan.replace_extension(".plan");
    INFO(entry.path());
    CHECK(say({"validate", domain_file, entry.path().string(), plan.string()}).code == kDone);
  }
  CHECK(problems >= 4);  // start, open, pick, put in
  CHECK(says(file_text(mine / "out/index.csv"), "boundary"));
}

TEST_CASE("`export bddl` and back: the drawer task is imported, run, and judged the same by both") {
  const Folder mine;
  const Said out =
      say({"export", "bddl", stored(), "--out", mine / "out", "--dialect", "libero", "--leave-out", "hand_empty"});
  INFO(out.err);
  REQUIRE(out.code == kDone);
  std::string file;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(mine / "out/libero"))
    if (entry.path().extension() == ".bddl") file = entry.path().string();
  std::filesystem::create_directories(mine / "own/tasks");
  put(mine / "own/tasks/unfinished.lua", "return {");  // mistakes of other files are not in its way
  const Said in = say({"import", file, "--task", "again", "--root", STAMPEDE_SOURCE_DIR, "--path", mine / "own",
                       "--out", mine / "own.db"});
  INFO(in.err << in.out);
  CHECK(in.code == kDone);
  const std::vector<VerdictRecord> verdicts = Catalogue::open(mine / "own.db").read_episode(1).labels.verdicts;
  REQUIRE(verdicts.size() == 1);
  CHECK(verdicts[0].theirs);
  CHECK(verdicts[0].ours);
}

TEST_CASE("a program says where and goal as the command line does") {
  SessionCore session(STAMPEDE_SOURCE_DIR, {}, {});
  EpisodeRequest request;
  request.variation = "level=top";
  request.where = "(open chest.top_drawer)";
  request.goal = "(closed chest--top_drawer)";
  CHECK(session.run("put_item_in_drawer", request).outcome == Outcome::success);
  request.goal = "(closed chest.top_drawr)";
  CHECK_THROWS_AS(session.run("put_item_in_drawer", request), Error);
}

TEST_CASE("another planner's program can plan for a run: here our own, as if it were a stranger's") {
  const Folder mine;
  const std::string planner = std::string(STAMPEDE_PROGRAM) + " plan {domain} {problem} > {plan}";
  const Said said = say({"run", "put_item_in_drawer", "--variation", "level=top", "--seed", "1", "--root",
                         STAMPEDE_SOURCE_DIR, "--out", mine / "o.db", "--planner", planner});
  INFO(said.err);
  CHECK(said.code == kDone);
  CHECK(Catalogue::open(mine / "o.db").read_episode(1).made.options.at("planner") == planner);
}

TEST_CASE("where LIBERO's rule and ours differ, both verdicts are kept and the difference is listed") {
  const Folder mine;
  std::filesystem::create_directories(mine / "own");
  put(mine / "map.lua",
      "return { dialect = \"libero\", categories = { { \"mug\", \"cube\" }, { \"plate\", \"cube\" } } }\n");
  put(mine / "desk.bddl",  // theirs: on asks that the centres are within 3 cm, and the table's is far away
      "(define (problem LIBERO_Tabletop_Manipulation) (:domain robosuite) (:language take the mug off the plate)\n"
      "(:regions (spot (:target desk) (:ranges ((-0.1 -0.2 -0.08 -0.18)))))\n"
      "(:fixtures desk - table)\n(:objects mug_1 - mug plate_1 - plate)\n(:obj_of_interest mug_1)\n"
      "(:init (On plate_1 desk_spot) (On mug_1 plate_1))\n(:goal (And (On mug_1 desk))))\n");
  const Said said = say({"import", mine / "desk.bddl", "--task", "off_plate", "--mapping", mine / "map.lua", "--root",
                         STAMPEDE_SOURCE_DIR, "--path", mine / "own", "--out", mine / "o.db"});
  INFO(said.err << said.out);
  CHECK(said.code == kDone);
  const std::vector<VerdictRecord> verdicts = Catalogue::open(mine / "o.db").read_episode(1).labels.verdicts;
  REQUIRE(verdicts.size() == 1);
  CHECK(verdicts[0].ours);
  CHECK_FALSE(verdicts[0].theirs);
  REQUIRE(verdicts[0].disagreements.size() == 1);
  CHECK(says(verdicts[0].disagreements[0], "(on mug_1 desk)"));
}

TEST_CASE("categories that are named like an object of ours need no mapping, and LIBERO's mugs are mugs") {
  const Folder mine;
  put(mine / "mugs.bddl", kMugOnPlate);
  const Said said = say({"import", mine / "mugs.bddl", "--task", "mug_on_plate", "--root", STAMPEDE_SOURCE_DIR,
                         "--path", mine / "own", "--out", mine / "o.db"});
  INFO(said.err << said.out);
  CHECK(said.code == kDone);
  const std::vector<VerdictRecord> verdicts = Catalogue::open(mine / "o.db").read_episode(1).labels.verdicts;
  REQUIRE(verdicts.size() == 1);
  CHECK(verdicts[0].ours);
  CHECK(verdicts[0].theirs);
}

TEST_CASE("an imported task says what it came from in a field, and `check` reads it") {
  const Folder mine;
  put(mine / "mugs.bddl", kMugOnPlate);
  put(mine / "map.lua", "return { dialect = \"libero\", categories = { { \"porcelain_mug\", \"cup\" } } }\n");
  const Said said = say({"import", mine / "mugs.bddl", "--task", "cup_on_plate", "--mapping", mine / "map.lua",
                         "--root", STAMPEDE_SOURCE_DIR, "--path", mine / "own", "--episodes", "0"});
  INFO(said.err << said.out);
  REQUIRE(said.code == kDone);
  const std::string task = mine / "own/tasks/cup_on_plate.lua", text = file_text(task);
  CHECK(says(text, "  problem = {\n    dialect = \"libero\",\n    mapping = \"cup_on_plate\","));
  CHECK(says(text, "{ \"cup\" }"));
  CHECK(file_text(mine / "own/worlds/bddl/cup_on_plate.lua") == file_text(mine / "map.lua"));
  const auto check = [&](const std::string& from, const std::string& to) {
    std::string changed = text;
    changed.replace(changed.find(from), from.size(), to);
    put(task, changed);
    return say({"check", "cup_on_plate", "--root", STAMPEDE_SOURCE_DIR, "--path", mine / "own"});
  };
  CHECK(check("dialect = \"libero\"", "dialect = \"libero\"").code == kDone);
  const Said dialect = check("dialect = \"libero\"", "dialect = \"librero\"");
  CHECK(dialect.code == kBadInput);
  CHECK(says(dialect.err + dialect.out, "did you mean 'libero'"));
  const Said damaged = check("      (on porcelain_mug_1 plate_1)", "      (on porcelain_mug_1 plat_1)");
  CHECK(damaged.code == kBadInput);
  CHECK(says(damaged.err + damaged.out, "plat_1"));
  CHECK(says(check("mapping = \"cup_on_plate\"", "mapping = \"nowhere\"").out, "worlds/bddl/nowhere.lua"));
}

TEST_CASE("a generous mapping gives a task that passes the check, or a refusal with literal and reason") {
  const std::vector<std::string> classes = {"cupboard", "saucepan_lid", "umbrella_stand", "push_button",
                                            "air_zone", "work_table",   "thing",          "tray"};
  const auto [goal, literal] = GENERATE(table<std::string, std::string>({{"(On mug_1 plate_1)", "(on "},
                                                                         {"(In mug_1 plate_1)", "(in "},
                                                                         {"(Open plate_1)", "(open "},
                                                                         {"(TurnOn plate_1)", "(turnon "}}));
  for (const std::string& ours : classes) {
    const Folder mine;
    put(mine / "map.lua",
        "return { dialect = \"libero\", categories = { { \"mug\", \"mug\" }, { \"plate\", \"" + ours + "\" } } }\n");
    put(mine / "p.bddl",
        "(define (problem LIBERO_Tabletop_Manipulation) (:domain robosuite) (:language do it)\n"
        "(:regions (left (:target desk) (:ranges ((-0.03 -0.3 0.03 -0.27)))) (middle (:target desk) "
        "(:ranges ((0 -0.03 0.1 0.03)))))\n(:fixtures desk - table)\n(:objects mug_1 - mug plate_1 - "
        "plate)\n(:obj_of_interest plate_1)\n(:init (On plate_1 desk_left) (On mug_1 desk_middle))\n"
        "(:goal (And " +
            goal + ")))\n");
    const Said said = say({"import", mine / "p.bddl", "--task", "made", "--mapping", mine / "map.lua", "--root",
                           STAMPEDE_SOURCE_DIR, "--path", mine / "own", "--episodes", "0"});
    INFO(ours << " " << goal << "\n" << said.err);
    const bool stays = std::filesystem::exists(mine / "own/tasks/made.lua");
    CHECK((said.code == kDone || said.code == kNo));
    CHECK(stays == (said.code == kDone));
    if (said.code == kNo) {
      CHECK(says(said.err, "cannot be a task here: "));
      CHECK((says(said.err, literal) || says(said.err, "(on plate_1") || says(said.err, "`plate_1`") ||
             says(said.err, "in `")));
    }
  }
}

TEST_CASE("no plan: what nobody can see and is not assumed, and why, and a task says what else cannot be seen in it") {
  const Folder mine;
  put(mine / "worlds/predicates/stamped.lua",
      "-- Stamped below.\nreturn predicate {\n  params = { \"obj: movable\" },\n  label = \"the {obj} is stamped\",\n"
      "  observable = false,\n  holds = function(w, obj) return true end,\n}\n");
  put(mine / "worlds/predicates/named.lua",
      "-- Named.\nreturn predicate {\n  params = { \"obj: movable\" },\n  label = \"the {obj} is named\",\n"
      "  holds = function(w, obj) return false end,\n}\n");
  put(mine / "skills/name_it.lua",
      "-- Name it.\nreturn skill {\n  params = { \"obj: movable\" },\n  precondition = { is.stamped(\"obj\") },\n"
      "  effect = { is.named(\"obj\") },\n  label = \"name the {obj}\",\n  run = function(robot, p, c) end,\n}\n");
  const auto plan = [&](const std::string& more) {
    put(mine / "tasks/name_one.lua",
        "-- Name it.\nreturn task {\n  world = \"tabletop\",\n  objects = { tin = { \"tin\" } },\n"
        "  init = { is.on(\"tin\", \"table\") },\n  goal = is.named(\"tin\"),\n" +
            more + "  instructions = { \"name the tin\" },\n}\n");
    return say({"plan", "name_one", "--root", STAMPEDE_SOURCE_DIR, "--path", mine / ""});
  };
  const Said none = plan("");
  INFO(none.out << none.err);
  CHECK(none.code == kNo);
  CHECK(says(none.err, "`name_it` needs (stamped tin)"));
  CHECK(says(none.err,
             "; nobody can see whether (stamped tin), but it is not assumed, for (on tin table) is known of "
             "'tin': where nobody can see that either, the task says so in `observable`"));
  const Said found = plan("  observable = { on = false },\n");
  INFO(found.out << found.err);
  CHECK(found.code == kDone);
  CHECK(found.out == "(name_it tin panda.hand)\n; assumes (stamped tin), which nobody can see at the start\n");
  CHECK(plan("  observable = { on = function(w, obj) return w:time() > 100 end },\n").out == found.out);
  CHECK(plan("  observable = { on = function(w, obj) return obj == \"tin\" end },\n").out.empty());
}

TEST_CASE("what cannot be imported is refused with the reason") {
  const Folder mine;
  put(mine / "p.bddl",
      "(define (problem tidy-0) (:domain behavior-1k) (:objects apple.n.01_1 - apple.n.01 floor.n.01_1 - "
      "floor.n.01) (:init (inroom floor.n.01_1 kitchen) (ontop apple.n.01_1 floor.n.01_1)) (:goal (and "
      "(inside ?apple.n.01_1 ?floor.n.01_1))))");
  std::filesystem::create_directories(mine / "own");
  const Said said = say({"import", mine / "p.bddl", "--root", STAMPEDE_SOURCE_DIR, "--path", mine / "own"});
  INFO(said.err);
  CHECK(said.code == kNo);
  CHECK(says(said.err, "apple.n.01"));
  CHECK_FALSE(std::filesystem::exists(mine / "own/tasks"));
}

}  // namespace stampede::program
