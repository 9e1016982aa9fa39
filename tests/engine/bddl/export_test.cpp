// Scenes and goals of ours as BDDL: what is said, what it means there, and what is refused.
#include "engine/bddl/export.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/random.h"
#include "engine/bddl/import.h"
#include "engine/symbolic/pddl.h"
#include "words.h"

using namespace stampede;
using Catch::Matchers::Contains;

namespace {

using ThingKind = BddlThing::Kind;

Domain tabletop() {
  Domain domain;
  domain.name = "tabletop";
  domain.types = {
      {"thing", "object"}, {"cube", "thing"}, {"fixture", "object"}, {"drawer", "fixture"}, {"hand", "object"}};
  domain.traits = {"movable", "openable"};
  const auto basic = [](const char* name, std::vector<Parameter> parameters) {
    return Predicate{name, std::move(parameters), PredicateKind::basic, {}, ""};
  };
  const Parameter x{"x", "", {}}, y{"y", "", {}};
  domain.predicates = {{"clear", {x}, PredicateKind::derived, {}, ""},
                       basic("closed", {x}),
                       basic("hand_empty", {x}),
                       basic("holding", {x, y}),
                       basic("inside", {x, y}),
                       basic("on", {x, y}),
                       basic("open", {x}),
                       {"red", {x}, PredicateKind::fixed, {}, ""}};
  domain.predicates[0].derived = negation(formula_from_pddl("(exists (?y - cube) (on ?y ?x))", "clear"));
  return domain;
}

BddlScene scene_with(const std::string& goal) {
  BddlScene scene;
  scene.task = "tidy_cubes";
  scene.instruction = "Tidy (all) the cubes;  please";
  scene.things = {{ThingKind::fixture, "table", "work_table", "fixture", "", {{-0.3, -0.4, 0.3, 0.4}}},
                  {ThingKind::fixture, "chest", "chest", "fixture", "", {}},
                  {ThingKind::part, "chest.top_drawer", "chest", "drawer", "chest", {}},
                  {ThingKind::part, "chest.bottom_drawer", "chest", "drawer", "chest", {}},
                  {ThingKind::region, "table.zone", "work_table", "region", "table", {{0, 0, 0.1, 0.1}}},
                  {ThingKind::object, "cube1", "cube", "cube", "", {}},
                  {ThingKind::object, "cube2", "cube", "cube", "", {}},
                  {ThingKind::hand, "panda.hand", "panda", "hand", "", {}}};
  scene.placements = {{"cube1", "table", {{-0.1, -0.1, 0.1, 0.1}}, {0, 1.5}}};
  scene.facts = {{"movable", {"cube1"}},
                 {"movable", {"cube2"}},
                 {"red", {"cube1"}},
                 {"openable", {"chest.top_drawer"}},
                 {"openable", {"chest.bottom_drawer"}},
                 {"on", {"cube1", "table"}},
                 {"on", {"cube2", "cube1"}},
                 {"closed", {"chest.top_drawer"}},
                 {"closed", {"chest.bottom_drawer"}},
                 {"hand_empty", {"panda.hand"}}};
  scene.goal = formula_from_pddl(goal, "goal");
  scene.interest = {"cube1", "chest.top_drawer"};
  return scene;
}

BddlExport libero(const std::string& goal) { return export_bddl(scene_with(goal), libero_words(), tabletop()); }
BddlExport behavior(const std::string& goal) { return export_bddl(scene_with(goal), behavior_words(), tabletop()); }

std::string goal_text(const BddlExport& result) {
  std::string text = result.refusal;
  for (const BddlFormula& part : result.problem.goal) text += (text.empty() ? "" : " ") + to_text(part);
  return text;
}

// Their predicates from our facts, by the names and rules of an export: so that both verdicts look at one state.
class Mapped : public BddlValues {
 public:
  Mapped(const Facts& facts, const BddlMapping& mapping, const BddlExport& result) {
    for (const Fact& fact : facts) {
      const BddlPredicateRule* rule = mapping.from_ours(fact.predicate, false);
      if (rule == nullptr || rule->negated) continue;
      Fact theirs{rule->theirs, {}};
      for (const std::string& name : fact.arguments) {
        if (result.names.count(name) > 0) theirs.arguments.push_back(result.names.at(name));
      }
      if (theirs.arguments.size() == fact.arguments.size()) facts_.insert(theirs);
    }
  }
  bool value(const Fact& atom) const override { return facts_.count(atom) > 0; }

 private:
  Facts facts_;
};

}  // namespace

TEST_CASE("LIBERO: the whole text") {
  const BddlExport result = libero("(and (inside cube1 chest.top_drawer) (closed chest.top_drawer))");
  CHECK(result.refusal.empty());
  CHECK(result.text == R"((define (problem libero_tabletop_manipulation)
  (:domain robosuite)
  (:language tidy all the cubes please)
  (:regions
    (top_region
      (:target chest)
    )
    (bottom_region
      (:target chest)
    )
    (cube1_init_region
      (:target table)
      (:ranges (
        (-0.1 -0.1 0.1 0.1)
      ))
      (:yaw_rotation ((0 1.5)))
    )
  )
  (:fixtures
    table - table
    chest - wooden_cabinet
  )
  (:objects
    cube1 cube2 - wooden_block
  )
  (:obj_of_interest
    cube1
    chest_top_region
  )
  (:init
    (close chest_bottom_region)
    (close chest_top_region)
    (on cube1 table_cube1_init_region)
    (on cube2 cube1)
  )
  (:goal
    (and
      (in cube1 chest_top_region)
      (close chest_top_region)
    )
  )
)
)");
  CHECK(read_bddl(result.text, "x").problem == result.problem);
  CHECK(result.file_name == "tidy_all_the_cubes_please.bddl");
  CHECK(std::count(result.remarks.begin(), result.remarks.end(),
                   "facts of these predicates are left out of :init: hand_empty") == 1);
  std::vector<std::string> notes;
  for (const BddlNote& note : result.notes) notes.push_back(note.theirs + " " + std::string(to_string(note.meaning)));
  CHECK(notes == std::vector<std::string>{"close equal", "in equal", "on weaker"});
}

TEST_CASE("LIBERO: goals that are conjunctions in the end are said") {
  const auto [goal, text] = GENERATE(table<const char*, const char*>({
      {"(forall (?c - cube) (inside ?c chest.top_drawer))", "(in cube1 chest_top_region) (in cube2 chest_top_region)"},
      {"(exists (?c - cube) (and (red ?c) (inside ?c chest.top_drawer)))",
       "(in cube1 chest_top_region)"},  // one is red
      {"(forall (?c - cube) (or (red ?c) (on ?c cube1)))", "(on cube2 cube1)"},
      {"(and (not (red cube2)) (not (= cube1 cube2)) (on cube2 cube1))", "(on cube2 cube1)"},
      {"(not (or (not (on cube2 cube1)) (red cube2)))", "(on cube2 cube1)"},
      {"(on cube1 table)", "(on cube1 table_top_surface)"},
      {"(inside cube1 table.zone)", "(on cube1 table_zone)"},
      {"(and (on cube1 table) (inside cube1 table.zone))", "(on cube1 table_zone)"},
      {"(and (on cube2 table) (inside cube1 table.zone))", "(on cube2 table_top_surface) (on cube1 table_zone)"},
  }));
  CHECK(goal_text(libero(goal)) == text);
}

TEST_CASE("LIBERO: what it cannot say is refused with part, reason and cure") {
  const auto [goal, part, reason] = GENERATE(table<const char*, const char*, const char*>({
      {"(not (on cube1 table))", "(not (on cube1 table_top_surface))",
       "conjunctions of atoms only; ask for the opposite"},
      {"(and (on cube2 cube1) (or (on cube1 table) (open chest.top_drawer)))", "(or (on cube1 table_top_surface) (open",
       "ask for one of the cases"},
      {"(exists (?c - cube) (inside ?c chest.top_drawer))", "(or (in cube1 chest_top_region)", "one of the cases"},
      {"(clear cube1)", "(not (on cube1 cube1))", "conjunctions"},
      {"(hand_empty panda.hand)", "(hand_empty panda.hand): LIBERO has no predicate", "add one to the mapping"},
      {"(holding panda.hand cube1)", "(holding", "no predicate for `holding`"},
      {"(red cube1)", "", "solved at once"},
      {"(red cube2)", "", "can never hold"},
      {"(on cube1 ghost)", "`ghost`", "not in the scene"},
  }));
  const BddlExport result = libero(goal);
  CHECK_THAT(result.refusal, Contains(part) && Contains(reason));
  CHECK(result.text.empty());
}

TEST_CASE("LIBERO: what went out comes back the same") {
  const BddlScene scene =
      scene_with("(and (inside cube1 chest.top_drawer) (closed chest.top_drawer) (on cube2 cube1))");
  const BddlExport result = export_bddl(scene, libero_words(), tabletop());
  const BddlTask task = from_bddl(read_bddl(result.text, "again").problem, libero_words());
  CHECK(task.refusal.empty());
  CHECK(task.goal == scene.goal);
  REQUIRE(task.placements.size() == 1);
  CHECK(task.placements[0] == scene.placements[0]);
  for (const BddlLiteral& literal : task.init) CHECK(scene.facts.count(literal.atom) == 1);
  CHECK(task.init.size() == 4);  // all but what LIBERO has no words for
  CHECK(task.fixtures.at(1).class_name == "chest");
}

TEST_CASE("LIBERO: fixtures that stand on another are placed too") {
  BddlScene scene = scene_with("(open chest.top_drawer)");
  scene.placements.push_back({"chest", "table", {{0.2, 0.2, 0.2, 0.2}}, {0, 0}});
  const BddlExport result = export_bddl(scene, libero_words(), tabletop());
  CHECK(result.problem.init.at(0).atom == Fact{"on", {"chest", "table_chest_init_region"}});
  const BddlTask task = from_bddl(read_bddl(result.text, "again").problem, libero_words());
  CHECK(task.placements.at(0) == scene.placements.at(1));
}

TEST_CASE("LIBERO: what its arena has, what it calls it, and what it lacks") {
  BddlMapping mapping = libero_words();
  mapping.instances = {{"table", "main_table"}};
  mapping.unsaid = {"floor"};
  mapping.unknown = {"wooden_block"};
  BddlScene scene = scene_with("(open chest.top_drawer)");
  scene.things.push_back({ThingKind::fixture, "floor", "floor", "fixture", "", {}});
  const BddlExport result = export_bddl(scene, mapping, tabletop());
  CHECK_THAT(result.text, Contains("main_table - table\n") && Contains("(on cube1 main_table_cube1_init_region)") &&
                              Contains("(:target main_table)") && !Contains("floor"));
  CHECK(result.names.at("table") == "main_table");
  CHECK(std::count_if(result.remarks.begin(), result.remarks.end(), [](const std::string& remark) {
          return remark.starts_with("LIBERO has no object `wooden_block` (`cube");
        }) == 2);
  const BddlTask task = from_bddl(read_bddl(result.text, "again").problem, mapping);
  CHECK(task.refusal.empty());
  CHECK(task.fixtures.at(0).class_name == "work_table");
}

TEST_CASE("a drawer that is half open is told, not lost") {
  const std::string told = "`chest.top_drawer` is neither open nor closed";
  for (const BddlMapping& mapping : {libero_words(), behavior_words()}) {
    BddlScene scene = scene_with("(on cube1 cube2)");
    const auto tells = [&] {
      const auto remarks = export_bddl(scene, mapping, tabletop()).remarks;
      return std::count_if(remarks.begin(), remarks.end(), [&](const auto& one) { return one.starts_with(told); });
    };
    CHECK(tells() == 0);
    scene.facts.erase({"closed", {"chest.top_drawer"}});
    CHECK(tells() == 1);
    scene.facts.insert({"open", {"chest.top_drawer"}});
    CHECK(tells() == 0);
  }
}

TEST_CASE("LIBERO: sites and surfaces that their models may lack are remarked") {
  BddlScene scene = scene_with("(and (inside cube1 chest.left_door) (on cube2 chest))");
  scene.things.push_back({ThingKind::part, "chest.left_door", "chest", "drawer", "chest", {}});
  const std::vector<std::string> remarks = export_bddl(scene, libero_words(), tabletop()).remarks;
  const auto has = [&](const std::string& text) {
    return std::any_of(remarks.begin(), remarks.end(), [&](const std::string& r) { return r.find(text) == 0; });
  };
  CHECK(has("`chest_left_door`: their model of `chest` must have a site of that name"));
  CHECK(has("(on cube2 chest): no area is known"));
}

TEST_CASE("BEHAVIOR: the whole text") {
  const BddlExport result =
      behavior("(and (forall (?c - cube) (inside ?c chest.top_drawer)) (closed chest.top_drawer))");
  CHECK(result.text == R"((define (problem tidy_cubes-0)
  (:domain behavior-1k)
  (:objects
    table.n.02_1 - table.n.02
    cabinet.n.01_1 - cabinet.n.01
    block.n.01_1 block.n.01_2 - block.n.01
    agent.n.01_1 - agent.n.01
    floor.n.01_1 - floor.n.01
  )
  (:init
    (inroom table.n.02_1 kitchen)
    (inroom cabinet.n.01_1 kitchen)
    (not (open cabinet.n.01_1))
    (ontop block.n.01_1 table.n.02_1)
    (ontop block.n.01_2 block.n.01_1)
    (inroom floor.n.01_1 kitchen)
    (ontop agent.n.01_1 floor.n.01_1)
  )
  (:goal
    (and
      (forall (?block.n.01 - block.n.01) (inside ?block.n.01 ?cabinet.n.01_1))
      (not (open ?cabinet.n.01_1))
    )
  )
)
)");
  const BddlReading reading = read_bddl(result.text, "x");
  CHECK(reading.problem == result.problem);
  CHECK(reading.warnings.empty());
}

TEST_CASE("BEHAVIOR: quantifiers stay where they range over a category, else they are written out") {
  const auto [goal, text] = GENERATE(table<const char*, const char*>({
      {"(exists (?c - cube) (on ?c table))", "(exists (?block.n.01 - block.n.01) (ontop block.n.01 table.n.02_1))"},
      {"(exists (?c - cube) (and (red ?c) (on ?c table)))", "(ontop block.n.01_1 table.n.02_1)"},
      {"(not (exists (?c - cube) (on ?c table)))",
       "(forall (?block.n.01 - block.n.01) (not (ontop block.n.01 table.n.02_1)))"},
      {"(clear cube1)", "(forall (?block.n.01 - block.n.01) (not (ontop block.n.01 block.n.01_1)))"},
      {"(holding panda.hand cube1)", "(grasped agent.n.01_1 block.n.01_1)"},
      {"(not (closed chest.top_drawer))", "(open cabinet.n.01_1)"},
      {"(inside cube1 table.zone)", "`table.zone`: BEHAVIOR has no regions; name the body"},
  }));
  std::string said = goal_text(behavior(goal));
  for (std::size_t at = said.find("?block.n.01 table"); at != std::string::npos; at = said.find("?block.n.01 table"))
    said.erase(at, 1);
  for (std::size_t at = said.find("?block.n.01 block.n.01_1"); at != std::string::npos;
       at = said.find("?block.n.01 block.n.01_1"))
    said.erase(at, 1);
  CHECK(said == text);
  // The same category inside itself would be shadowed there.
  CHECK_THAT(goal_text(behavior("(exists (?c - cube) (forall (?d - cube) (on ?c ?d)))")),
             Contains("(exists (?block.n.01 - block.n.01) (and (ontop ?block.n.01 block.n.01_1)"));
}

TEST_CASE("BEHAVIOR: parts are folded, and opposite wishes for two of them are refused") {
  CHECK(goal_text(behavior("(and (open chest.top_drawer) (open chest.bottom_drawer))")) == "(open cabinet.n.01_1)");
  CHECK_THAT(behavior("(and (open chest.top_drawer) (closed chest.bottom_drawer))").refusal,
             Contains("folded into one"));
  BddlScene ajar = scene_with("(on cube1 cube2)");
  ajar.facts.erase({"closed", {"chest.top_drawer"}});  // neither open nor closed: nothing is said
  const auto open = [](const BddlExport& result) {
    return std::count_if(result.problem.init.begin(), result.problem.init.end(),
                         [](const BddlLiteral& l) { return l.atom.predicate == "open"; });
  };
  CHECK(open(export_bddl(ajar, behavior_words(), tabletop())) == 0);
  ajar.facts.insert({"open", {"chest.top_drawer"}});
  const BddlExport result = export_bddl(ajar, behavior_words(), tabletop());
  CHECK(std::count(result.problem.init.begin(), result.problem.init.end(),
                   BddlLiteral{{"open", {"cabinet.n.01_1"}}, false}) == 1);
  CHECK(open(result) == 1);
}

TEST_CASE("things without a name there are remarked, and refused in goals") {
  BddlMapping poor = behavior_words();
  std::erase_if(poor.categories, [](const BddlPair& pair) { return pair.ours == "cube"; });
  const BddlExport kept = export_bddl(scene_with("(open chest.top_drawer)"), poor, tabletop());
  CHECK_THAT(kept.remarks.at(0), Contains("`cube1` is left out: the mapping has no synset for `cube`"));
  CHECK_THAT(export_bddl(scene_with("(on cube1 table)"), poor, tabletop()).refusal,
             Contains("add a category for the class `cube`"));
  BddlScene twice = scene_with("(on cube1 table)");
  twice.things.push_back(twice.things.back());
  CHECK_THROWS_WITH(export_bddl(twice, poor, tabletop()), Contains("in the scene twice"));
}

TEST_CASE("an exported goal holds there exactly where it holds here") {
  const Domain domain = tabletop();
  const bool to_libero = GENERATE(false, true);
  const BddlMapping mapping = to_libero ? libero_words() : behavior_words();
  Random random(RandomKey("bddl export"));
  const auto pick = [&](const std::vector<std::string>& from) {
    return from[static_cast<std::size_t>(random.below(static_cast<std::int64_t>(from.size())))];
  };
  const std::function<std::string(int, std::vector<std::string>)> formula = [&](int depth,
                                                                                std::vector<std::string> terms) {
    const std::int64_t kind = random.below(depth > 0 ? 9 : 4);
    if (kind <= 1) return "(on " + pick(terms) + " " + pick(terms) + ")";
    if (kind == 2) return "(" + pick({"red", "clear"}) + " " + pick(terms) + ")";
    if (kind == 3) return "(= " + pick(terms) + " " + pick(terms) + ")";
    if (kind == 4) return "(not " + formula(depth - 1, terms) + ")";
    if (kind <= 6)
      return "(" + pick({"and", "or"}) + " " + formula(depth - 1, terms) + " " + formula(depth - 1, terms) + ")";
    const std::string variable = "?v" + std::to_string(terms.size());
    std::vector<std::string> inner = terms;
    inner.push_back(variable);
    return "(" + pick({"exists", "forall"}) + " (" + variable + " - " + pick({"cube", "fixture", "thing"}) + ") " +
           formula(depth - 1, inner) + ")";
  };
  int said = 0, imported = 0;
  for (int round = 0; round < 400; ++round) {
    BddlScene scene = scene_with(formula(4, {"cube1", "cube2", "table"}));
    std::erase_if(scene.things, [](const BddlThing& thing) {
      return thing.kind == ThingKind::part || thing.kind == ThingKind::region;
    });
    std::erase_if(scene.facts,
                  [](const Fact& fact) { return fact.predicate == "closed" || fact.predicate == "openable"; });
    scene.interest.clear();
    for (BddlThing& thing : scene.things) thing.area.clear();  // `on` the table stays one word
    const BddlExport result = export_bddl(scene, mapping, domain);
    std::vector<TypedObject> objects;
    for (const BddlThing& thing : scene.things) objects.push_back({thing.name, thing.type});
    BddlTask task;
    if (result.refusal.empty()) task = from_bddl(read_bddl(result.text, "t").problem, mapping);
    for (int state = 0; state < 16; ++state) {
      Facts facts = {{"red", {"cube1"}}, {"movable", {"cube1"}}, {"movable", {"cube2"}}};
      for (const BddlThing& a : scene.things) {
        for (const BddlThing& b : scene.things) {
          if (random.below(2) == 0) facts.insert({"on", {a.name, b.name}});
        }
      }
      const bool here = holds(scene.goal, with_derived(facts, domain, objects), domain, objects);
      if (result.refusal.find("conjunctions of atoms only") != std::string::npos) continue;
      if (!result.refusal.empty()) {  // decided by what never changes
        REQUIRE(here == (result.refusal.find("holds whatever happens") != std::string::npos));
        continue;
      }
      const Mapped values(facts, mapping, result);
      REQUIRE(judge(result.problem, values) == here);
      ++said;
      if (!task.refusal.empty()) continue;
      Facts again;  // and back: under the names that the import gives
      for (const Fact& fact : facts) {
        Fact renamed = fact;
        bool named = true;
        for (std::string& name : renamed.arguments) {
          named = named && result.names.count(name) > 0;
          if (named) name = task.names.at(result.names.at(name));
        }
        if (named) again.insert(renamed);
      }
      REQUIRE(judge_both(result.problem, values, task, {again, {}, {}}).ours == here);
      ++imported;
    }
  }
  CHECK(said > (to_libero ? 500 : 1000));
  CHECK(imported > (to_libero ? 500 : 1000));
}
