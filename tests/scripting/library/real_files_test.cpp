// The files that ship with the program pass their own check.
#include <catch2/catch.hpp>

#include "scripting/library/library.h"

using namespace stampede;

TEST_CASE("the shipped files load without a complaint") {
  std::vector<Error> complaints;
  const auto library = Library::check({{STAMPEDE_SOURCE_DIR}}, complaints);
  for (const Error& complaint : complaints) UNSCOPED_INFO(complaint.what());
  REQUIRE(complaints.empty());
  // 20 colours: 60 towers, as 3 heights times 20 colours.
  const Library::TaskInfo* stack = library->task("stack_blocks");
  REQUIRE(stack != nullptr);
  CHECK(stack->variation_texts.size() == 60);
  CHECK(stack->hand == "panda.hand");
  CHECK(stack->variations.front().at("height") == "2");
  const SkillInfo* pick = library->skill("pick");
  REQUIRE(pick != nullptr);
  CHECK(pick->parameters.back().type == "hand");
  const Action* action = library->domain().action("pick");
  REQUIRE(action != nullptr);
  CHECK(action->parameters.size() == 3);
}
