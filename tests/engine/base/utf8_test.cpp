#include "engine/base/utf8.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

using namespace stampede;
using Catch::Contains;

TEST_CASE("text is UTF-8 without the character 0") {
  for (const std::string text : {"", "plain\n\ttext", "Grüße", "日本", "🤖", "\xf4\x8f\xbf\xbf"})
    CHECK(not_text_at(text) == std::string::npos);
  const std::string nul("a\0b", 3);
  CHECK(not_text_at(nul) == 1);
  for (const std::string bad : {"\xe9t\xe9", "\xc0\xaf", "\xed\xa0\x80", "\xf5\x80\x80\x80", "\x80", "\xe2\x82"}) {
    CHECK(not_text_at(bad) == 0);
    CHECK(not_text_at("ab" + bad) == 2);
  }
}

TEST_CASE("bytes that are no text are named with their line and the cure") {
  CHECK_THROWS_WITH(require_text("a,b\n1,\xe9\n", "x.csv"),
                    Contains("x.csv:2: the byte 0xE9 here is no UTF-8 text") && Contains("save the file as UTF-8"));
  CHECK_THROWS_WITH(require_text(std::string("a\n\n\0", 4), "x"), Contains("x:3") && Contains("no character 0"));
  CHECK_THROWS_WITH(require_text(std::string("\xff\xfe"
                                             "a\0",
                                             4),
                                 "x"),
                    Contains("x:1: this is UTF-16"));
  require_text("Grüße", "x");
}
