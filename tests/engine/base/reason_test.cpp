#include "engine/base/reason.h"

#include <catch2/catch.hpp>
#include <set>

using namespace stampede;

TEST_CASE("every reason has one name, leads back from it, and a sentence") {
  std::set<std::string_view> names;
  for (const Reason reason : all_reasons()) {
    CHECK(names.insert(to_string(reason)).second);
    CHECK(reason_from(to_string(reason)) == reason);
    CHECK_FALSE(describe(reason).empty());
    CHECK(describe(reason).back() != '.');
  }
  CHECK_FALSE(reason_from("no_such_reason"));
}
