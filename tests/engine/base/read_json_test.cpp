#include "engine/base/read_json.h"

#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"

using namespace stampede;
using Catch::Contains;

namespace {

std::string complaint(const std::string& text, const JsonLimits& limits = {}) {
  try {
    json_from_text(text, "f.json", "the cure", limits);
  } catch (const Error& error) {
    return error.what();
  }
  return "accepted";
}

std::string repeated(const std::string& piece, int times) {
  std::string text;
  for (int i = 0; i < times; ++i) text += piece;
  return text;
}

}  // namespace

TEST_CASE("JSON is read as it is written") {
  const std::string text = R"({"a": [1, -2, 2.5, 1e3, true, false, null, "é\n"], "b": {"c": {}, "d": []}})";
  CHECK(json_from_text(text, "", "") == nlohmann::json::parse(text));
  CHECK(json_from_text("\xef\xbb\xbf [1]", "", "") == nlohmann::json::parse("[1]"));
  CHECK(json_from_text(" 9223372036854775807 ", "", "").get<std::int64_t>() == 9223372036854775807);
  CHECK(json_from_text("-9223372036854775808", "", "").get<std::int64_t>() == std::numeric_limits<std::int64_t>::min());
  CHECK(json_if_any("3") == nlohmann::json(3));
  CHECK_FALSE(json_if_any("three").has_value());
  CHECK(texts_from_json(R"(["a", "b"])", "x") == std::vector<std::string>{"a", "b"});
  CHECK_THROWS_WITH(texts_from_json(R"(["a", 1])", "x"), Contains("x: a list of texts is expected"));
  CHECK_THROWS_WITH(texts_from_json("7", "x"), Contains("a list of texts is expected"));
}

TEST_CASE("a million brackets are refused at the first that is too deep, with its line") {
  for (const char* open : {"[", "{\"a\":", "[{\"a\":[", "[[],", "{\"b\":1,\"a\":"})
    CHECK_THAT(complaint("\n" + repeated(open, 1'000'000)),
               Contains("f.json:2: brackets are 65 deep, and at most 64 are read") && Contains("the cure"));
  CHECK(complaint(repeated("[", 64) + repeated("]", 64)) == "accepted");
  CHECK_THAT(complaint(repeated("[", 65) + repeated("]", 65)), Contains("65 deep"));
  CHECK(complaint(repeated("[[]],", 100'000).insert(0, "[") + "1]") == "accepted");  // many, and not deep
}

TEST_CASE("what is no JSON is refused with its line and what stands there") {
  const std::vector<std::array<std::string, 2>> cases = {
      {"", "this file is empty"},
      {" \n", "ends too early"},
      {"{\n\"a\": [1,\n\n", "f.json:2: this JSON ends too early"},
      {"{\"a\": \"b", "f.json:1: this JSON ends too early"},
      {"{\n\"a\": }", "f.json:2: this is no JSON from here on: }"},
      {"[1]\n[2]", "f.json:2: this is no JSON from here on: [2]"},
      {"[1,\n'a']", "f.json:2: this is no JSON from here on: 'a']"},
      {"[1, // no\n2]", "f.json:1: this is no JSON from here on: // no"},
      {"{\"a\": 1\n\"b\": 2}", "f.json:2: this is no JSON from here on: \"b\": 2}"},
      {"[\"a\nb\"]", "f.json:1: this is no JSON"},
      {"[\n01]", "f.json:2: this is no JSON from here on: 01]"},
      {"[1,\nNaN]", "f.json:2: a number is not finite"},
      {"[1, -Infinity]", "f.json:1: a number is not finite"},
      {"[1,\n1e999,\n2]", "f.json:2: a number is not finite"},
      {"[-1e999]", "a number is not finite"},
      {"[9223372036854775808]", "a whole number is too large"},
      {"[\n-9223372036854775809]", "f.json:2: a whole number is too large"},
      {"[" + std::string(1000, '9') + "]", "f.json:1:"},
      {"{\"a\": 1,\n\"a\": 2}", "f.json:2: 'a' is there twice in one object"},
      {"{\"a\": {\"b\": 1, \"b\": 2}}", "'b' is there twice"},
      {"[\n\"\\u0000\"]", "f.json:2: a text holds the character 0"},
      {"{\"a\\u0000b\": 1}", "a text holds the character 0"},
      {"[\n\"\xe9\"]", "f.json:2: the byte 0xE9 here is no UTF-8 text"},
      {"[\"\\ud800\"]", "this is no JSON from here on: "},
      {std::string("\xff\xfe[\0]\0", 6), "UTF-16"},
      {std::string(4, '\0'), "the byte 0x00"}};
  for (const auto& [text, told] : cases) {
    const std::string said = complaint(text);
    INFO(text << " -> " << said);
    CHECK_THAT(said, Contains(told));
    CHECK_THAT(said, !Contains("exception"));
    CHECK(said.size() < 300);
  }
}

TEST_CASE("size and number of values have limits, told before memory goes") {
  CHECK_THAT(complaint("[1, 2, 3]", {.bytes = 8}), Contains("it has 9 bytes, and at most 8 are read"));
  CHECK(complaint("[1, 2]", {.values = 3}) == "accepted");
  CHECK_THAT(complaint("[1,\n2, 3]", {.values = 3}), Contains("f.json:2: it holds more than 3 values"));
}

TEST_CASE("only plain files are read: a pipe keeps nobody waiting, a device never ends") {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder.path() / "pipe", file = folder.path() / "a.json";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::ofstream(file) << "[1]";
  CHECK(json_from_file(file, "") == nlohmann::json::parse("[1]"));
  CHECK_THROWS_WITH(json_from_file(pipe, ""), Contains("it is no file"));
  CHECK_THROWS_WITH(json_from_file("/dev/zero", ""), Contains("it is no file"));
  CHECK_THROWS_WITH(json_from_file(folder.path(), ""), Contains("it is no file"));
  CHECK_THROWS_WITH(json_from_file(folder.path() / "none", ""), Contains("there is no such file"));
  CHECK_THROWS_WITH(json_from_file(file, "", {.bytes = 2}), Contains("it is larger than 2 bytes"));
}
