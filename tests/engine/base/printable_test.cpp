#include "engine/base/printable.h"

#include <catch2/catch.hpp>

namespace stampede {

TEST_CASE("text for people stays, in any alphabet") {
  for (const char* text : {"", "a cube\n\tis red", "Würfel – 立方体 🧊", "x × y → z · …"})
    CHECK(printable(text) == text);
}

TEST_CASE("what a terminal would obey, hide or turn round is shown as an escape") {
  CHECK(printable("\x1b[2J\x1b]0;gone\x07") == "\\x1b[2J\\x1b]0;gone\\x07");
  CHECK(printable("a\rb\bc\x7f") == "a\\rb\\x08c\\x7f");
  CHECK(printable("\u009b31m") == "\\u009b31m");  // CSI of the second set of controls
  CHECK(printable("a\u202eb\u200bc\ufeffd\u2066") == "a\\u202eb\\u200bc\\ufeffd\\u2066");
  CHECK(printable("\U000e0041") == "\\U000e0041");
  CHECK(printable(std::string("a\0b", 3)) == "a\\x00b");
}

TEST_CASE("bytes that are no UTF-8 are shown one by one, and what follows them stays") {
  CHECK(printable("a\xff\xc3") == "a\\xff\\xc3");
  CHECK(printable("\xc0\xaf!") == "\\xc0\\xaf!");         // too long
  CHECK(printable("\xed\xa0\x80") == "\\xed\\xa0\\x80");  // half a surrogate pair
  CHECK(printable("\xf4\x90\x80\x80") == "\\xf4\\x90\\x80\\x80");
  CHECK(printable("\xe2\x82") == "\\xe2\\x82");
}

TEST_CASE("one line is one line") { CHECK(printable_line("a\nb\tc") == "a\\nb\\tc"); }

}  // namespace stampede
