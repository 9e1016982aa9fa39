#include <catch2/catch.hpp>
#include <limits>

#include "engine/sim/numerics.h"
#include "scripting/program/console.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"

namespace stampede::program {

TEST_CASE("widths count code points, and cut text is as wide as asked") {
  CHECK(display_width("grün") == 4);
  CHECK(clipped("grüner Block", 5) == "grün…");
  CHECK(clipped("grün", 4) == "grün");
  CHECK(padded("ü", 3) == "ü  ");
}

TEST_CASE("wrapped lines keep all words and none is wider than asked") {
  const std::string text = wrapped("one two three four five six", 9, 2);
  CHECK(text == "one two\n  three\n  four\n  five\n  six");  // the first line starts at the indent too
}

TEST_CASE("JSON escapes what it must and writes numbers that read back") {
  JsonText json;
  json.object().field("a\"b", "x\ny\x01").field("n", 0.1).field("i", std::int64_t{-3}).field("t", true);
  json.field("inf", std::numeric_limits<double>::infinity()).key("list").array().value(1).value(2).end();
  CHECK(json.end().text() ==
        "{\n  \"a\\\"b\": \"x\\ny\\u0001\",\n  \"n\": 0.1,\n  \"i\": -3,\n  \"t\": true,\n  \"inf\": null,\n"
        "  \"list\": [\n    1,\n    2\n  ]\n}\n");
}

TEST_CASE("the progress line says done, success rate, speed and the time left") {
  // 10 of 40 after 5 s, 8 of them good: 80 %, 2 a second, 30 more take 15 s.
  const std::string line = progress_line({40, 10, 10, 8, 5.0}, 90);
  CHECK(line.find("10/40 [") == 0);
  CHECK(line.find("80 % success, 2.0 episodes/s, 15 s left") != std::string::npos);
  CHECK(display_width(line) <= 90);
  CHECK(progress_line({40, 40, 0, 0, 0.1}, 90).find("left") == std::string::npos);
}

TEST_CASE("durations read well") {
  CHECK(duration_text(4.4) == "4 s");
  CHECK(duration_text(125) == "2 min 05 s");
  CHECK(duration_text(4800) == "1 h 20 min");
}

TEST_CASE("the numerics probe is the same each time it is asked") {
  CHECK(numerics_probe() == numerics_probe());
  CHECK(numerics_probe().size() == 32);
}

}  // namespace stampede::program
