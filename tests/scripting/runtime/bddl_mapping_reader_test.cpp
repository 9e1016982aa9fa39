#include "scripting/runtime/bddl_mapping_reader.h"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

using namespace stampede;

namespace {

const Library& library() {
  static const auto shared = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  return *shared;
}

BddlMapping read_text(const std::string& fields) {
  const auto path = std::filesystem::temp_directory_path() / "stampede_bddl_mapping.lua";
  std::ofstream(path) << "-- A mapping.\nreturn { " << fields << " }\n";
  return read_bddl_mapping(library(), path.string());
}

}  // namespace

TEST_CASE("the shipped mapping files extend the built-in ones, own entries first") {
  const BddlMapping ours = read_bddl_mapping(library(), "libero"), standard = default_libero_mapping();
  CHECK(ours.dialect == BddlDialect::libero);
  CHECK(ours.categories.size() > standard.categories.size());
  CHECK(*ours.category("cube", "cube") == "red_cube");
  CHECK(*ours.class_of("wooden_cabinet") == "chest");
  CHECK(ours.parts == standard.parts);
  CHECK(read_bddl_mapping(library(), "behavior").rooms.at("push_button") == "living_room");
}

TEST_CASE("without extend a file is all there is; arguments are counted from 1") {
  const BddlMapping mapping = read_text(
      R"(dialect = "behavior", categories = { { "box.n.01", "chest" } },
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
  CHECK_THROWS_WITH(read_bddl_mapping(library(), "/nowhere/at_all.lua"), Catch::Contains("cannot be read"));
  CHECK_THROWS_WITH(read_text("dialect = nowhere.at_all"), Catch::Contains(":2"));
}
