#include "engine/base/deflated.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

namespace stampede {

TEST_CASE("bytes come back from what they were packed into") {
  for (const std::string& text :
       {std::string(), std::string("a"), std::string(100'000, 'x'), std::string("\0\xff", 2)}) {
    const std::string packed = deflated(text);
    CHECK(inflated(packed, text.size()) == text);
    CHECK(packed.size() < text.size() / 50 + 20);
  }
}

TEST_CASE("damaged bytes, and those of another size, are refused") {
  const std::string packed = deflated("some text, some text");
  CHECK_THROWS_AS(inflated(packed, 19), Error);
  CHECK_THROWS_AS(inflated(packed, 21), Error);
  CHECK_THROWS_AS(inflated(packed.substr(0, packed.size() - 1), 20), Error);
  CHECK_THROWS_AS(inflated("", 0), Error);
}

}  // namespace stampede
