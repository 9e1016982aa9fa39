// CSV files as programs write them, and what is wrong with others.
#include <catch2/catch.hpp>
#include <cmath>

#include "db/recording/csv_file.h"
#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"

using namespace stampede;
using Catch::Contains;

namespace {

using CsvRows = std::vector<std::vector<std::string>>;

CsvFile file_of(const std::string& text) {
  const TemporaryFolder folder;
  write_text_file(folder.path() / "a.csv", text);
  return CsvFile(folder.path() / "a.csv", "a.csv");
}

// All rows, the header first.
CsvRows rows_of(const std::string& text) {
  CsvFile file = file_of(text);
  CsvRows rows = {file.header()};
  while (file.next()) rows.emplace_back(file.fields().begin(), file.fields().end());
  return rows;
}

double number_of(const std::string& field) {
  CsvFile file = file_of("x,y\n1," + field + "\n");
  REQUIRE(file.next());
  return file.number(1);
}

std::string columns(int count) {
  std::string names;
  for (int i = 0; i < count; ++i) names += (i > 0 ? ",c" : "c") + std::to_string(i);
  return names + "\n";
}

}  // namespace

TEST_CASE("fields are what stands between commas, or between quotes, where two stand for one") {
  const CsvRows plain = {{"a", "b"}, {"1", "2"}, {"", ""}};
  CHECK(rows_of("a,b\n1,2\n,\n") == plain);
  CHECK(rows_of("a,b\r\n1,2\r\n,\r\n") == plain);
  CHECK(rows_of("\xef\xbb\xbf"
                "a,b\n\n1,2\n\n,\n\n") == plain);
  const CsvRows quoted = {{"a", "b"}, {"x,\"y\"", "two\nlines"}, {"", "3"}};
  CHECK(rows_of("a,b\n\"x,\"\"y\"\"\",\"two\nlines\"\n\"\",3\n") == quoted);
}

TEST_CASE("a CSV file that was cut, or is none, says at which line") {
  CHECK_THROWS_WITH(rows_of("a,b\n1,2\n3,"), Contains("a.csv:3") && Contains("may have been cut"));
  CHECK_THROWS_WITH(rows_of("a,b\n1,2\n3"), Contains("a.csv:3") && Contains("the file ends too early"));
  CHECK_THROWS_WITH(rows_of("a,b\n\n1,2,3\n"), Contains("a.csv:3") && Contains("3 fields, and the header names 2"));
  CHECK_THROWS_WITH(rows_of("a,b\n\"1,2\n"), Contains("a quote is not closed"));
  CHECK_THROWS_WITH(rows_of("a,b\n\"1\"2,3\n"), Contains("a comma is missing here"));
  CHECK_THROWS_WITH(rows_of("a;b\n1;2\n"), Contains("not separated by commas"));
  CHECK_THROWS_WITH(rows_of("a,b,a\n"), Contains("two columns are named 'a'"));
  CHECK_THROWS_WITH(rows_of(""), Contains("this file is empty"));
  CHECK(rows_of(columns(4096)).front().size() == 4096);
  CHECK_THROWS_WITH(rows_of(columns(4097)), Contains("4097 columns, at most 4096"));
}

TEST_CASE("a number of a CSV file is finite, may have a sign, and is unknown where nothing stands") {
  CHECK(number_of("-1.5e-3") == -0.0015);
  CHECK(number_of("+2") == 2);
  CHECK(std::isnan(number_of("")));
  for (const char* wrong : {"nan", "inf", "1e999", "1 ", "0x10", "+", "+-3", "1;2"}) {
    INFO(wrong);
    CHECK_THROWS_WITH(number_of(wrong), Contains("a.csv:2") && Contains("column y holds"));
  }
}
