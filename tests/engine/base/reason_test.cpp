#include "engine/base/reason.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <string>

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

TEST_CASE("the page says of every reason when it is given") {
  std::ifstream page(STAMPEDE_SOURCE_DIR "/engine/base/README.md");
  std::set<std::string> told;
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| `")) told.insert(line.substr(3, line.find('`', 3) - 3));
  for (const Reason reason : all_reasons()) CHECK(told.contains(std::string(to_string(reason))));
}
