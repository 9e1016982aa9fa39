// What tasks say without saying it: the empty hand, what stays, their world, where furniture stands; names with an axis
// in them; and where on_table is.
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"
#include "scripts_fixture.h"

using namespace stampede;
namespace fs = std::filesystem;

namespace {

// A task of the shipped world, which it need not name, with these fields beside its sentences.
class Written {
 public:
  explicit Written(const std::string& fields) {
    std::string folder = (fs::temp_directory_path() / "stampede_goals_XXXXXX").string();
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = folder;
    fs::create_directories(path_ / "tasks");
    std::ofstream out(path_ / "tasks/written.lua");
    out << "-- A task.\nreturn task {\n  instructions = { \"do it\" },\n";
    if (fields.find("objects = ") == std::string::npos)
      out << "  objects = { cup = { \"tumbler\" }, other = { \"cube\", count = 2 },\n"
             "    box = { \"lidded_box\", at = on_table { 0.2, 0 } } },\n";
    out << "  " << fields << "\n}\n";
  }
  ~Written() { fs::remove_all(path_); }
  Written(const Written&) = delete;
  Written& operator=(const Written&) = delete;
  Task task(const std::string& variation = "") const {
    EpisodeScripts scripts(Library::load({{STAMPEDE_SOURCE_DIR, path_}}), "written", variation, 0);
    return scripts.task()(0);
  }
  std::string goal() const { return to_pddl(task().goal); }
  std::string complaints() const {
    std::vector<Error> errors;
    Library::check({{STAMPEDE_SOURCE_DIR, path_}}, errors, {"written"});
    std::string text;
    for (const Error& error : errors) text += std::string(error.what()) + "\n";
    return text;
  }

 private:
  fs::path path_;
};

const std::string kInit =
    "init = { is.on(\"cup\", \"table\"), is.on(\"other*\", \"table\"), is.pairwise(\"spaced\", \"other*\", \"cup\"), "
    "is.closed(\"box.lid\"), is.workable(\"box.lid\") }, ";
const std::string kEmpty = "(hand_empty panda--hand)";

}  // namespace

TEST_CASE("the hand is empty at the end, unless the goal speaks of what it holds, or the task says otherwise") {
  const auto goal = [](const std::string& fields) { return Written(kInit + fields).goal(); };
  CHECK(goal("goal = is.on(\"cup\", \"table\")") == "(and (on cup table) " + kEmpty + ")");
  CHECK(goal("goal = { is.on(\"cup\", \"table\"), is.open(\"box.lid\") }") ==
        "(and (on cup table) (open box--lid) " + kEmpty + ")");
  CHECK(goal("goal = function(v) return { is.on(\"cup\", \"table\") } end") == "(and (on cup table) " + kEmpty + ")");
  CHECK(goal("goal = { is.hand_empty(), is.on(\"cup\", \"table\") }") == "(and " + kEmpty + " (on cup table))");
  CHECK(goal("hand = \"any\", goal = is.on(\"cup\", \"table\")") == "(on cup table)");
  CHECK(goal("goal = is.lifted(\"cup\")") == "(lifted cup)");
  CHECK(goal("goal = { is.holding(\"cup\"), is.open(\"box.lid\") }") ==
        "(and (holding panda--hand cup) (open box--lid))");
  CHECK(goal("goal = any_of { is_not.lifted(\"cup\"), is.open(\"box.lid\") }") ==
        "(and (or (not (lifted cup)) (open box--lid)) " + kEmpty + ")");
  const Task ordered = Written(kInit + "goal = in_order { is.open(\"box.lid\"), is.closed(\"box.lid\") }").task();
  REQUIRE(ordered.stages.size() == 2);
  CHECK(to_pddl(ordered.stages[0]) == "(open box--lid)");
  CHECK(to_pddl(ordered.stages[1]) == "(and (closed box--lid) " + kEmpty + ")");
  CHECK(ordered.empty_hand);
  CHECK_FALSE(Written(kInit + "goal = is.lifted(\"cup\")").task().empty_hand);  // no plan fails for want of that
  CHECK(Written(kInit + "hand = \"full\", goal = is.on(\"cup\", \"table\")")
            .complaints()
            .find("hand: at the end the hand is empty or any, not 'full'") != std::string::npos);
}

TEST_CASE("stays says at the end what init says, but for what is asked of starts alone") {
  const auto goal = [](const std::string& stays) {
    return Written(kInit + "hand = \"any\", goal = { is.inside(\"other1\", \"box\"), " + stays + " }").goal();
  };
  CHECK(goal("stays(\"cup\")") == "(and (inside other1 box) (on cup table))");
  CHECK(goal("stays(\"box\", \"cup\")") == "(and (inside other1 box) (closed box--lid) (on cup table))");
  // Of the box and of other1 the goal speaks.
  CHECK(goal("stays(\"others\")") == "(and (inside other1 box) (on cup table) (on other2 table))");
  CHECK(goal("any_of { is.open(\"box.lid\"), stays(\"cup\") }") ==
        "(and (inside other1 box) (or (open box--lid) (on cup table)))");
  CHECK(Written("init = function(v) return { is.on(\"other*\", \"table\"), is.on(\"cup\", \"table\") } end, "
                "hand = \"any\", goal = { is.inside(\"cup\", \"box\"), stays(\"others\") }")
            .goal() == "(and (inside cup box) (and (on other1 table) (on other2 table)))");
  CHECK(Written(kInit + "goal = { is.on(\"cup\", \"table\"), stays(\"cap\") }")
            .complaints()
            .find("init says nothing of 'cap' that could stay") != std::string::npos);
  CHECK(Written(kInit + "goal = { is.on(\"cup\", \"table\"), stays(7) }")
            .complaints()
            .find("stays takes names of things") != std::string::npos);
}

TEST_CASE("pairwise says it of each two, in their order") {
  const Task task = Written(kInit + "goal = is.on(\"cup\", \"table\")").task();
  std::vector<std::string> pairs;
  for (const Literal& one : task.init)
    if (one.fact.predicate == "spaced") pairs.push_back(one.fact.arguments[0] + " " + one.fact.arguments[1]);
  CHECK(pairs == std::vector<std::string>{"other1 other2", "other1 cup", "other2 cup"});
  const auto said = [](const std::string& formula) {
    return Written("init = { is.on(\"cup\", \"table\"), is.on(\"other*\", \"table\"), " + formula +
                   " }, goal = is.on(\"cup\", \"table\")")
        .complaints();
  };
  CHECK(said("is.pairwise(\"spaced\", \"other*\")").empty());
  CHECK(said("is_not.pairwise(\"crowds\", \"other*\", \"cup\")").empty());
  CHECK(said("is.pairwise(\"spaced\", \"cup\")").find("there are no two things to say 'spaced' of") !=
        std::string::npos);
  CHECK(said("is.pairwise(\"lifted\", \"other*\")").find("is not said of two things") != std::string::npos);
  CHECK(said("is.pairwise(\"spacd\", \"other*\")").find("did you mean 'spaced'?") != std::string::npos);
  CHECK(said("is.pairwise(\"spaced\", \"others*\")").find("there is no group 'others*'") != std::string::npos);
  CHECK(said("is.pairwise(3)").find("pairwise takes a predicate") != std::string::npos);
}

TEST_CASE("on_table is the top of the world's table") {
  const Scene scene = Written(kInit + "goal = is.on(\"cup\", \"table\")").task().scene;
  const auto box =
      std::find_if(scene.bodies.begin(), scene.bodies.end(), [](const Body& one) { return one.name == "box"; });
  REQUIRE(box != scene.bodies.end());
  CHECK(box->world_from_body.translation() == Vector3(0.2, 0, 0.75));
  const auto at = [](const std::string& place) {
    return Written("objects = { box = { \"lidded_box\", " + place + " } }, goal = is.open(\"box.lid\")");
  };
  CHECK(at("at = on_table { 0.2, 0, 0.1 }").complaints().empty());
  CHECK(at("at = on_table { 0.2 }").complaints().find("on_table takes x and y") != std::string::npos);
  CHECK(at("at = on_table { 0.2, \"left\" }").complaints().find("on_table: value 2 is a string") != std::string::npos);
  CHECK(at("at = { 0, 0, 0.7 }, yaw = on_table { 0.2, 0 }").complaints().find("box.yaw") != std::string::npos);
}

TEST_CASE("colours that lie apart: as many as asked for, and nobody takes one for another") {
  const Written task(kInit +
                     "where = function(v) return v.near end, variations = each(colours.apart(3, 50), function(c, i) "
                     "return { i = i, first = c[1], near = colours.difference(c[1], c[2]) < 32 or "
                     "colours.difference(c[1], c[3]) < 32 or colours.difference(c[2], c[3]) < 32 } end), "
                     "goal = is.on(\"cup\", \"table\")");
  CHECK(task.complaints().find("where leaves no variation") != std::string::npos);  // none of them is near another
  const auto said = [](const std::string& lists) {
    return Written(kInit + "variations = each(" + lists +
                   ", function(c) return { a = c[1] } end), goal = is.on(\"cup\", \"table\")")
        .complaints();
  };
  CHECK(said("colours.apart(2)").empty());
  CHECK(said("colours.apart(30)").find("there are no 30 colours that far apart") != std::string::npos);
  CHECK(said("colours.apart()").find("colours.apart takes how many colours") != std::string::npos);
}

TEST_CASE("names, entries and colours with an axis in them are those of the variation, as a function of it would say") {
  const std::string rest = "variations = { size = { 1, 2 }, colour = { \"red\", \"blue\" }, part = { \"lid\" } }, ";
  const std::string box = "box = { \"lidded_box\", at = on_table { 0.2, 0 } }";
  const Written named(rest + "objects = { cup = { \"tumbler\", colour = \"{colour}\", count = \"{size}\" }, " + box +
                      ", other = { \"cube\", count = 3, colour = sample_of(colours.except(\"{colour}\"), 3) } }, " +
                      "init = { is.on(\"cup*\", \"table\"), is.on(\"other*\", \"table\"), is.closed(\"box.{part}\") }, "
                      "goal = { is.open(\"box.{part}\"), is.on(\"cup{size}\", \"table\"), stays(\"others\") }, "
                      "subgoals = { { \"first\", is.open(\"box.{part}\"), \"open the {part}\" } }");
  const Written computed(
      rest + "objects = function(v) return { cup = { \"tumbler\", colour = v.colour, count = v.size }, " + box +
      ", other = { \"cube\", count = 3, colour = sample_of(colours.except(v.colour), 3) } } end, " +
      "init = { is.on(\"cup*\", \"table\"), is.on(\"other*\", \"table\"), is.closed(\"box.lid\") }, "
      "goal = function(v) return { is.open(\"box.\" .. v.part), is.on(\"cup\" .. v.size, \"table\"), stays(\"others\") "
      "} end");
  CHECK(named.complaints().empty());
  for (const char* variation : {"colour=red,part=lid,size=1", "colour=blue,part=lid,size=2"}) {
    const Task one = named.task(variation), other = computed.task(variation);
    CHECK(to_pddl(one.goal) == to_pddl(other.goal));
    REQUIRE(one.subgoals.size() == 1);
    CHECK(to_pddl(one.subgoals[0].formula) == "(open box--lid)");
    CHECK(one.subgoals[0].sentence == "open the lid");
    REQUIRE(one.scene.objects.size() == other.scene.objects.size());
    for (std::size_t i = 0; i < one.scene.objects.size(); ++i)
      CHECK(one.scene.objects[i].attributes == other.scene.objects[i].attributes);
  }
  const auto complaints = [&](const std::string& goal) {
    return Written("variations = { size = { 1 } }, " + kInit + "goal = " + goal).complaints();
  };
  CHECK(complaints("is.on(\"cup\", \"table{sise}\")").find("'table{sise}': there is no axis 'sise'") !=
        std::string::npos);
}

TEST_CASE("furniture stands where its file says, drawn as its entry would, unless the entry says another place") {
  const auto stands = [](const std::string& entry) {
    const Task task = Written("objects = { chest = { \"chest\"" + entry +
                              " } }, init = { is.closed(\"chest.top_drawer\") }, goal = is.open(\"chest.top_drawer\")")
                          .task();
    return task.scene.bodies[static_cast<std::size_t>(task.scene.body_index("chest"))].world_from_body;
  };
  const Transform own = stands("");
  CHECK(
      own.isApprox(stands(", place = require(\"worlds.lib.places\").round_the_table { gap = 0.12, turn = deg(22), wide "
                          "= 0.26 }")));
  CHECK(own.translation().z() == Approx(0.75));
  CHECK(own.translation().head<2>().norm() > 0.4);
  CHECK(stands(", at = on_table { 0.1, 0.2 }").translation().isApprox(Vector3(0.1, 0.2, 0.75)));
  CHECK(stands(", place = { at = { 0.3, 0, 0.9 } }").translation().isApprox(Vector3(0.3, 0, 0.9)));
}
