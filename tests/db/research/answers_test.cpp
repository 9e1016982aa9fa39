// Answers as JSON and CSV, and each way in which they can be wrong.
#include "db/research/answers.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"

namespace stampede::research {
namespace {

Answers read(const std::string& text, const std::string& problem = "segments_supervised") {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "answers", text);
  return read_answers(folder.path() / "answers", find_problem(problem));
}

void refused(const std::string& text, const std::string& why, const std::string& problem = "segments_supervised") {
  INFO(text);
  CHECK_THROWS_WITH(read(text, problem), Catch::Contains(why));
}

}  // namespace

TEST_CASE("JSON and CSV say the same") {
  const Answers json = read(
      R"({"dataset": "abc", "problem": "segments_supervised", "answers": [
          {"episode": 3, "first_frame": 0, "end_frame": 10.0, "skill": "pick, \"up\""}]})");
  const Answers csv = read("# dataset: abc\r\nskill,episode,first_frame,end_frame\r\n\"pick, \"\"up\"\"\",3,0,10\r\n");
  CHECK(json.dataset == "abc");
  CHECK(csv.dataset == "abc");
  CHECK(json.rows.rows == csv.rows.rows);
  CHECK(json.rows.text(0, "skill") == "pick, \"up\"");
  CHECK(json.rows.integer(0, "end_frame") == 10);
}

TEST_CASE("a byte order mark is no part of the answers") {
  const std::string csv = "# dataset: abc\nepisode,first_frame,end_frame,skill\n3,0,10,pick\n";
  CHECK(read("\xEF\xBB\xBF" + csv).rows.rows == read(csv).rows.rows);
  CHECK(read("\xEF\xBB\xBF" + csv).dataset == "abc");
  CHECK(read("\xEF\xBB\xBF{\"dataset\": \"abc\", \"answers\": []}").dataset == "abc");
}

TEST_CASE("what is written is read again, optional columns and texts included") {
  Answers answers = read(R"({"dataset": "d", "problem": "segments_and_conditions", "domain": "define", "answers":
      [{"episode": 1, "first_frame": 0, "end_frame": 5}, {"episode": 1, "first_frame": 5, "end_frame": 9, "skill": "a"}]})",
                         "segments_and_conditions");
  CHECK(answers.rows.is_null(0, "skill"));
  const Answers again = read(answers_text(answers), "segments_and_conditions");
  CHECK(again.rows.rows == answers.rows.rows);
  CHECK(again.texts == answers.texts);
}

TEST_CASE("every problem's example can be read") {
  for (const ResearchProblem& problem : all_problems()) {
    INFO(problem.name);
    const Answers answers = read(example_answers(problem, "id", {4, 7, 9}), problem.name);
    CHECK(answers.dataset == "id");
    CHECK(answers.rows.size() == (problem.answer.empty() ? 0 : 2));
    CHECK(answers.texts.size() == problem.answer_texts.size());
  }
}

TEST_CASE("answers that are wrong are refused with their place") {
  refused("", "empty");
  refused("{\"answers\": [", ":1: this JSON ends too early");
  refused("{\"dataset\": \"abc\",\n \"answers\": [{\"episode\": 1,\n\n", ":2: this JSON ends too early");
  refused("{\"dataset\": \"ab", ":1: this JSON ends too early");
  refused("{\"dataset\": \"abc\",\n \"answers\": [}]}", ":2: this is no JSON from here on: }]}");
  refused("{\"dataset\": \"abc\"} more", ":1: this is no JSON from here on: more");
  refused("[1, 2]", "one JSON object");
  refused("{\"dataset\": 3}", "'dataset' is a text");
  refused("{\"answers\": {}}", "list of objects");
  refused("{\"answers\": [3]}", "answer 1: an answer is an object");
  refused("{\"answers\": [{\"episode\": 1, \"first_frame\": 0, \"skill\": \"a\"}]}", "'end_frame' is missing");
  refused("{\"answers\": [{\"episode\": 1, \"first_frame\": 0, \"end_frame\": 2, \"skill\": \"a\", \"x\": 1}]}",
          "no column 'x'");
  refused("{\"answers\": [{\"episode\": \"1\", \"first_frame\": 0, \"end_frame\": 2, \"skill\": \"a\"}]}",
          "whole number");
  refused("{\"answers\": [{\"episode\": 1.5, \"first_frame\": 0, \"end_frame\": 2, \"skill\": \"a\"}]}",
          "whole number");
  refused("{\"answers\": [{\"episode\": 1,\n \"first_frame\": NaN, \"end_frame\": 2, \"skill\": \"a\"}]}",
          ":2: a number is not finite");
  refused("episode,first_frame\n1,0\n", "'end_frame' is missing");
  refused("episode,first_frame,end_frame,skill,more\n", "no column 'more'");
  refused("episode,first_frame,end_frame,skill\n1,0,2\n", ":2: 3 cells");
  refused("episode,first_frame,end_frame,skill\n1,0,two,pick\n", "'end_frame' is a whole number, not 'two'");
  refused("episode,frame,value\n1,0,nan\n", "finite", "rewards");
  refused("episode,frame,value\n1,0,1e999\n", "finite", "rewards");
  refused("{\"answers\": [{\"episode\": 1, \"frame\": 0, \"value\": 1e999}]}", "", "rewards");
  refused("{\"dataset\": \"d\", \"domain\": \"(define)\", \"answers\": [{}]}", "rows, of which this problem has none",
          "abstractions");
}

TEST_CASE("answers that mean harm are refused in a line or two") {
  const auto refused_shortly = [](const std::string& text, const std::string& why, const std::string& problem) {
    try {
      read(text, problem);
      FAIL("it was read");
    } catch (const Error& error) {
      const std::string said = error.what();
      CHECK_THAT(said, Catch::Contains(why));
      CHECK_THAT(said, !Catch::Contains("json.exception"));
      CHECK(said.size() < 1000);
    }
  };
  const std::string large(10'000'000, 'x'), deep(1'000'000, '['), shut(1'000'000, ']');
  const std::string start = "{\"dataset\": \"abc\", \"answers\": [{\"episode\": ";
  refused_shortly(start + deep, "brackets are 17 deep", "rewards");
  refused_shortly(start + deep + shut + ", \"frame\": 0, \"value\": 0}]}", ":1: brackets are 17 deep", "rewards");
  refused_shortly(start + "[[]], \"frame\": 0, \"value\": 0}]}", "whole number, not a list", "rewards");
  refused_shortly(start + "{}, \"frame\": 0, \"value\": 0}]}", "not an object", "rewards");
  refused_shortly(start + "1, \"" + large + "\": 0}]}", "no column 'xxx", "rewards");
  refused_shortly(start + "\"" + large + "\", \"frame\": 0, \"value\": 0}]}", "whole number", "rewards");
  refused_shortly(start + "18446744073709551615, \"frame\": 0, \"value\": 0}]}", "whole number", "rewards");
  refused_shortly(start + "1, \"frame\": 0, \"value\": true}]}", "finite number, not true", "rewards");
  refused_shortly(start + "1, \"frame\": 0, \"value\": -Infinity}]}", "not finite", "rewards");
  refused_shortly("{\"dataset\": [" + deep + shut + "]}", "deep", "rewards");
  refused_shortly("{\"dataset\": [[]]}", "'dataset' is a text", "rewards");
  refused_shortly(large, "no column 'xxx", "rewards");
  refused_shortly("episode,frame,value\n1,0," + large, "finite number", "rewards");
  refused_shortly("episode,frame,value,frame\n1,0,1,2\n", "'frame' is there twice", "rewards");
  refused_shortly("episode,frame,value\n99999999999999999999,0,1\n", "whole number", "rewards");
  refused_shortly(std::string("\0\0\0\0", 4), ":1: the byte 0x00 here is no UTF-8 text", "rewards");
}

TEST_CASE("ten megabytes of answers are read") {
  std::string text = "# dataset: abc\nepisode,frame,value\n";
  std::size_t rows = 0;
  while (text.size() < 10'000'000) text += "1," + std::to_string(rows++) + ",0.123456789012345\n";
  CHECK(read(text, "rewards").rows.size() == rows);
}

TEST_CASE("answers that could not be written again, or were cut, are refused with their line") {
  refused("episode,first_frame,end_frame,skill\n1,0,2,pick\n1,2,4,\xe9\n", ":3: the byte 0xE9 here is no UTF-8 text");
  refused("{\"dataset\": \"\xe9\"}", ":1: the byte 0xE9");
  refused("episode,first_frame,end_frame,skill\n1,0,2,pick\n1,2,4,pi", ":3: the file ends within this line");
  refused("{\"dataset\": \"a\", \"anwsers\": \"\"}", "did you mean 'answers'?");
  refused("{\"dataset\": \"a\", \"dataset\": \"b\"}", "'dataset' is there twice");
}

}  // namespace stampede::research
