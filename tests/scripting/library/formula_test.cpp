// Formulas as C++ values, against what they mean by hand.
#include <catch2/catch.hpp>
#include <lua.hpp>

#include "scripting/library/definitions.h"
#include "scripting/library/formula_reader.h"
#include "scripting/library/library.h"
#include "scripting/library/lua_value.h"

using namespace stampede;

namespace {

struct Fixture {
  std::shared_ptr<const Library> library = Library::load({{STAMPEDE_SOURCE_DIR}});
  DefinitionState state{library};
  Formula formula(const std::string& source, const std::vector<Parameter>& parameters = {}) {
    state.sandbox().run(Sandbox::compile("return " + source, "t.lua"), "t.lua", 1);
    FormulaContext context;
    context.file = "t.lua";
    context.field = "goal";
    context.domain = &library->domain();
    context.schema = !parameters.empty();
    context.parameters = parameters;
    context.expand = [](const std::string& group) {
      const std::string name = group.substr(0, group.size() - 1);
      return std::vector<std::string>{name + "1", name + "2", name + "3"};
    };
    const Formula result = formula_from(value_as_written(state.state(), -1, "t.lua: goal"), context);
    lua_pop(state.state(), 1);
    return result;
  }
};

}  // namespace

TEST_CASE("the hand that is left out is the world's, or the parameter") {
  Fixture fixture;
  CHECK(fixture.formula("is.holding('a')") == atom("holding", {{false, "panda.hand"}, {false, "a"}}));
  CHECK(fixture.formula("is.hand_empty()") == atom("hand_empty", {{false, "panda.hand"}}));
  CHECK(fixture.formula("is.holding('other.hand', 'a')") == atom("holding", {{false, "other.hand"}, {false, "a"}}));
  const Formula inside = fixture.formula("is.holding('obj')", {{"obj", "", {"movable"}}, {"hand", "hand", {}}});
  CHECK(inside == atom("holding", {{true, "hand"}, {true, "obj"}}));
  CHECK_THROWS_WITH(fixture.formula("is.hand_empty()", {{"obj", "", {}}}), Catch::Contains("the hand is left out"));
}

TEST_CASE("groups are conjunctions over their members") {
  Fixture fixture;
  const Formula all = fixture.formula("is.on('b*', 'table')");
  REQUIRE(all.kind == Formula::Kind::conjunction);
  REQUIRE(all.parts.size() == 3);
  CHECK(all.parts[2] == atom("on", {{false, "b3"}, {false, "table"}}));
  CHECK(fixture.formula("is_not.on('b*', 'table')").parts[0].kind == Formula::Kind::negation);
  const Formula some = fixture.formula("exists('?x: b*', is.on('?x', 'table'))");
  CHECK(some.kind == Formula::Kind::disjunction);
  CHECK(some.parts.size() == 3);
}

TEST_CASE("at_least is the disjunction of all choices of so many") {
  Fixture fixture;
  const Formula two = fixture.formula("at_least(2, 'b*', function(x) return is.on(x, 'table') end)");
  REQUIRE(two.kind == Formula::Kind::disjunction);
  REQUIRE(two.parts.size() == 3);
  CHECK(two.parts[0].parts[0] == atom("on", {{false, "b1"}, {false, "table"}}));
  CHECK(two.parts[2].parts[1] == atom("on", {{false, "b3"}, {false, "table"}}));
  CHECK(fixture.formula("at_least(1, 'b*', function(x) return is.on(x, 'table') end)").parts.size() == 3);
  CHECK(fixture.formula("at_least(3, 'b*', function(x) return is.on(x, 'table') end)").kind ==
        Formula::Kind::conjunction);
}

TEST_CASE("any_order is the disjunction of all ordered choices") {
  Fixture fixture;
  const Formula chain = fixture.formula("any_order('b*', 2, function(b, i) return is.on(b[i], b[i - 1]) end)");
  REQUIRE(chain.kind == Formula::Kind::disjunction);
  CHECK(chain.parts.size() == 6);                                       // 3 x 2
  CHECK(chain.parts[0] == atom("on", {{false, "b2"}, {false, "b1"}}));  // b[0] is left out
  CHECK(fixture.formula("any_order('b*', 3, function(b, i) return is.on(b[i], b[i - 1]) end)").parts.size() == 6);
}

TEST_CASE("quantifiers keep types and traits") {
  Fixture fixture;
  const Formula formula = fixture.formula("forall('?x: cube & movable', is.on('?x', 'table'))");
  REQUIRE(formula.kind == Formula::Kind::forall);
  CHECK(formula.variables[0] == Parameter{"x", "cube", {"movable"}});
  CHECK(formula.parts[0] == atom("on", {{true, "x"}, {false, "table"}}));
  const Formula same = fixture.formula("is_not(equal('a', 'b'))");
  REQUIRE(same.kind == Formula::Kind::negation);
  CHECK(same.parts[0].kind == Formula::Kind::equal);
}

TEST_CASE("a definition runs once per state and not across states") {
  Fixture fixture;
  fixture.state.push(DefinitionKind::task, "stack_blocks");
  fixture.state.push(DefinitionKind::task, "stack_blocks");
  CHECK(lua_rawequal(fixture.state.state(), -1, -2) == 1);
  CHECK(value_as_written(fixture.state.state(), -1, "")["name"].text == "stack_blocks");
  CHECK_THROWS_WITH(fixture.state.push(DefinitionKind::task, "nothing"), Catch::Contains("there is no task 'nothing'"));
}

TEST_CASE("a table that doubles itself is refused, not unfolded") {
  Fixture fixture;
  fixture.state.sandbox().run(Sandbox::compile("local t = {1} for i = 1, 30 do t = { t, t } end return t", "t.lua"),
                              "t.lua", 1);
  CHECK_THROWS_AS(value_as_written(fixture.state.state(), -1, "t.lua"), Error);
  fixture.state.sandbox().run(Sandbox::compile("local t = {} t.t = t return t", "t.lua"), "t.lua", 1);
  CHECK_THROWS_WITH(value_as_written(fixture.state.state(), -1, "t.lua"), Catch::Contains("nested too deeply"));
}

TEST_CASE("a part of a variable is one that there is: part_of and part_name") {
  Fixture fixture;
  const Formula named = fixture.formula("exists('?x: furniture', is_not.open('?x.top_drawer'))").parts.at(0);
  REQUIRE(named.kind == Formula::Kind::exists);
  REQUIRE(named.variables.at(0).name == "x_top_drawer");
  const std::vector<Formula>& parts = named.parts.at(0).parts;
  REQUIRE(parts.size() == 3);
  CHECK(parts[0] == atom("part_of", {{true, "x_top_drawer"}, {true, "x"}}));
  CHECK(parts[1] == atom("part_name", {{true, "x_top_drawer"}, {false, "top_drawer"}}));
  CHECK(parts[2] == negation(atom("open", {{true, "x_top_drawer"}})));
  const Formula all = fixture.formula("forall('?x: furniture', is.open('?x.top_drawer'))").parts.at(0);
  CHECK(all.kind == Formula::Kind::forall);  // of all that have one
  CHECK(all.parts.at(0).kind == Formula::Kind::disjunction);
  CHECK(all.parts.at(0).parts.at(0) == negation(atom("part_of", {{true, "x_top_drawer"}, {true, "x"}})));
  const std::vector<Parameter> obj = {{"obj", "", {}}};
  CHECK(fixture.formula("is.open('obj.lid')", obj).kind == Formula::Kind::exists);
  CHECK(fixture.formula("is.open('obj.lid')").kind == Formula::Kind::atom);  // of a task: that thing
  CHECK(fixture.formula("is.open('obj.a.b')", obj).parts.at(0).parts.at(1).terms.at(1).name == "a--b");
  CHECK_THROWS_WITH(fixture.formula("is.open('?y.lid')"), Catch::Contains("unknown variable '?y.lid'"));
}

TEST_CASE("what is written out for the members of groups is counted first") {
  Fixture fixture;
  CHECK(fixture.formula("exists('?a: b*', '?c: b*', is.on('?a', '?c'))").parts.size() == 3);
  CHECK_THROWS_WITH(fixture.formula("exists('?a: b*', '?c: b*', '?d: b*', '?e: b*', '?f: b*', '?g: b*', '?h: b*', "
                                    "'?i: b*', '?j: b*', '?k: b*', is.on('?a', '?c'))"),
                    Catch::Contains("goal: exists over ?a ?c ?d ?e ?f ?g ?h ?i ?j ?k: 59,049 instances, at "
                                    "most 20,000"));
  CHECK_THROWS_WITH(
      fixture.formula("forall('?a: b*', '?c: b*', '?d: b*', '?e: b*', '?f: b*', forall('?g: b*', '?h: b*', "
                      "'?i: b*', '?j: b*', '?k: b*', is.on('?a', '?g')))"),
      Catch::Contains("59,049 instances"));
}
