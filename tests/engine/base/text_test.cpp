#include "engine/base/text.h"

#include <catch2/catch.hpp>

namespace stampede {

TEST_CASE("a text has one part more than separators, empty ones included") {
  CHECK(split("a,bc,d", ',') == std::vector<std::string>{"a", "bc", "d"});
  CHECK(split("64x48", 'x') == std::vector<std::string>{"64", "48"});
  CHECK(split("", ',') == std::vector<std::string>{""});
  CHECK(split(",a,", ',') == std::vector<std::string>{"", "a", ""});
}

TEST_CASE("blanks and tabs at the ends of a text are no part of it") {
  CHECK(trimmed(" \ta b\t ") == "a b");
  CHECK(trimmed("a") == "a");
  CHECK(trimmed(" \t").empty());
  CHECK(trimmed("").empty());
}

}  // namespace stampede
