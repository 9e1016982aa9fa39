#include "engine/base/error.h"

#include <catch2/catch.hpp>

using stampede::Error;

TEST_CASE("an error reads place, complaint, cure") {
  CHECK(std::string(Error("a.lua:4", "no field 'x'", "did you mean 'y'?").what()) ==
        "a.lua:4: no field 'x'\n    did you mean 'y'?");
  CHECK(std::string(Error("", "nothing").what()) == "nothing");
  CHECK_THROWS_AS(throw stampede::CatalogueError("a.db", "newer"), Error);
}
