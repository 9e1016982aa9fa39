#include "scripting/runtime/bddl_mapping_reader.h"

#include <sys/stat.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace stampede;

namespace {

const Library& words_library() {
  static const auto shared = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  return *shared;
}

BddlMapping read_text(const std::string& fields) {
  const auto path =
      std::filesystem::temp_directory_path() / ("stampede_bddl_mapping_" + std::to_string(::getpid()) + ".lua");
  std::ofstream(path) << "-- A mapping.\nreturn { " << fields << " }\n";
  return read_bddl_mapping(words_library(), path.string());
}

}  // namespace

TEST_CASE("the shipped mappings are Lua like an author's, and all that is known of the dialects") {
  const BddlMapping libero = read_bddl_mapping(words_library(), "libero");
  CHECK(libero.dialect == BddlDialect::libero);
  CHECK(*libero.category("work_table", "") == "table");
  CHECK(libero.instances.at("table") == "main_table");
  CHECK(*libero.class_of("wooden_cabinet") == "chest");
  CHECK(libero.from_theirs("turnoff", false)->negated);
  CHECK(libero.stands.at("chest").x_m[0] < libero.stands.at("chest").x_m[1]);
  const BddlMapping behavior = bddl_mapping_of(words_library(), BddlDialect::behavior);
  CHECK(behavior.room == "kitchen");
  CHECK(behavior.from_ours("closed", false)->theirs == "open");
  CHECK(bddl_mappings_of(words_library(), "bddl").size() == 2);
  CHECK(bddl_mappings_of(words_library(), "behavior").size() == 1);
}

TEST_CASE("an author's file goes before its dialect's") {
  const BddlMapping own = read_text(
      R"(dialect = "libero", categories = { { "red_cube", "cube" } }, instances = { red_cube = "it" }, room = "study",
         stands = { chest = { x = { 0.4, 0.4 }, y = { 0, 0.1 }, z = 0.7 } })");
  const BddlMapping shipped = read_bddl_mapping(words_library(), "libero");
  CHECK(own.categories.size() == shipped.categories.size() + 1);
  CHECK(*own.category("cube", "cube") == "red_cube");
  CHECK(own.instances.size() == 2);
  CHECK(own.parts == shipped.parts);
  CHECK(own.room == "study");
  CHECK(own.stands.at("chest").z_m == 0.7);
}

TEST_CASE("without what it extends a file is all there is, arguments are counted from 1") {
  const BddlMapping mapping = read_text(
      R"(dialect = "behavior", extend = false, categories = { { "box.n.01", "chest" } },
         predicates = { { theirs = "grasped", ours = "holding", order = { 2, 1 }, meaning = "stronger" } })");
  REQUIRE(mapping.categories.size() == 1);
  REQUIRE(mapping.predicates.size() == 1);
  CHECK(mapping.predicates[0].order == std::vector<int>{1, 0});
  CHECK(mapping.predicates[0].meaning == BddlMeaning::stronger);
  CHECK(mapping.hand == "panda.hand");
  CHECK(mapping.parts.empty());
}

TEST_CASE("words that nobody has are refused, with the nearest as cure") {
  CHECK_THROWS_WITH(read_text(R"(dialect = "librero")"), Catch::Contains("libero"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", predicate = {})"), Catch::Contains("did you mean 'predicates'"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", predicates = { { theirs = "on", ours = "upon" } })"),
                    Catch::Contains("no predicate 'upon'"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", predicates = { { theirs = "onn", ours = "on" } })"),
                    Catch::Contains("onn"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", categories = { { "bowl", "cubee" } })"),
                    Catch::Contains("did you mean 'cube'"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", categories = { bowl = "cube" })"), Catch::Contains("pairs"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", stands = { chest = { x = { 1, 0 }, y = { 0, 1 }, z = 0 } })"),
                    Catch::Contains("stands.chest.x"));
  CHECK_THROWS_WITH(read_text(R"(dialect = "libero", zone = "air_zon")"), Catch::Contains("air_zone"));
  CHECK_THROWS_WITH(read_bddl_mapping(words_library(), "/nowhere/at_all.lua"),
                    Catch::Contains("there is no such file") && Catch::Contains("worlds/bddl"));
  const std::string pipe =
      std::filesystem::temp_directory_path() / ("stampede_pipe_" + std::to_string(getpid()) + ".lua");
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  CHECK_THROWS_WITH(read_bddl_mapping(words_library(), pipe), Catch::Contains("it is no file"));
  std::filesystem::remove(pipe);
  CHECK_THROWS_WITH(read_text("dialect = nowhere.at_all"), Catch::Contains(":2"));
}
