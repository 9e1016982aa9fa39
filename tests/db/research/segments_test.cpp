// Figures of segments, worked out by hand on episodes of twenty frames.
#include <sqlite3.h>

#include <catch2/catch.hpp>

#include "db/research/dataset.h"
#include "db/research/scorer.h"
#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"

namespace stampede::research {
namespace {

// Episode 1 tests: pick [0, 8), put [8, 16), nothing [16, 20). Episode 2 trains.
class Hidden {
 public:
  explicit Hidden(const std::string& problem) {
    PlainFileWriter file(folder_.path() / kHiddenFile);
    file.table("dataset", {"id", "problem", "split"});
    file.row({std::string("abc"), problem, std::string("seeds")});
    file.table("episodes", {"episode", "split", "frames", "frame_hz"});
    file.row({std::int64_t{1}, std::string("test"), std::int64_t{20}, std::int64_t{10}});
    file.row({std::int64_t{2}, std::string("train"), std::int64_t{20}, std::int64_t{10}});
    file.table("skills", {"episode", "first_frame", "end_frame", "skill"});
    file.row({std::int64_t{1}, std::int64_t{0}, std::int64_t{8}, std::string("pick")});
    file.row({std::int64_t{1}, std::int64_t{8}, std::int64_t{16}, std::string("put")});
    file.row({std::int64_t{2}, std::int64_t{0}, std::int64_t{8}, std::string("pick")});
    file.finish();
  }
  // As any program could change it.
  void change(const std::string& sql) const {
    sqlite3* handle = nullptr;
    REQUIRE(sqlite3_open((folder_.path() / kHiddenFile).c_str(), &handle) == SQLITE_OK);
    REQUIRE(sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, nullptr) == SQLITE_OK);
    sqlite3_close(handle);
  }
  std::map<std::string, double> score(const std::string& rows, const std::string& dataset = "abc",
                                      const ScoreOptions& options = {}) const {
    write_text_file(folder_.path() / "a.csv",
                    "# dataset: " + dataset + "\nepisode,first_frame,end_frame,skill\n" + rows);
    std::map<std::string, double> figures;
    for (const Figure& figure : research::score(folder_.path() / "a.csv", folder_.path(), options).figures)
      figures[figure.name] = figure.value;
    return figures;
  }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("numbers of a data set that can be none are refused before anything counts with them") {
  for (const auto& [sql, complaint] : std::vector<std::pair<std::string, std::string>>{
           {"UPDATE skills SET first_frame = -1", "skills.first_frame"},
           {"UPDATE skills SET first_frame = 'x'", "skills.first_frame"},
           {"UPDATE skills SET end_frame = 4294967296", "skills.end_frame"},
           {"UPDATE skills SET first_frame = end_frame, end_frame = first_frame", "skills.end_frame"},
           {"UPDATE skills SET first_frame = 1.5", "skills.first_frame"},
           {"UPDATE skills SET episode = 7", "skills is of an episode that is not there"},
           {"UPDATE episodes SET frames = -1", "a row of episodes"},
           {"UPDATE episodes SET frames = 9223372036854775807", "a row of episodes"},
           {"UPDATE episodes SET frame_hz = 1e-300", "a row of episodes"},
           {"UPDATE episodes SET frame_hz = NULL", "a row of episodes"},
           {"UPDATE episodes SET episode = 1", "is there twice"},
           {"UPDATE episodes SET episode = x'00'", "a row of episodes"},
           {"UPDATE episodes SET split = 7", "a row of episodes"},
           {"DROP TABLE episodes", "lacks the table episodes"},
           {"CREATE TABLE \"joints\" (\"episode\", \"joint\")", "does not say which joints are the arm's"},
           {"CREATE VIEW v AS SELECT 1", "plain tables only"}}) {
    INFO(sql);
    const Hidden hidden("segments_supervised");
    hidden.change(sql);
    CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n1,8,16,put\n"),
                      Catch::Contains(complaint) && Catch::Contains("stampede dataset"));
  }
}

TEST_CASE("true segments get full marks") {
  const auto figures = Hidden("segments_supervised").score("1,0,8,pick\n1,8,16,put\n");
  for (const auto& [name, value] : figures) {
    INFO(name);
    CHECK(value == Approx(1));
  }
  CHECK(figures.size() == 16);
}

TEST_CASE("boundaries within so many frames, each matched once") {
  // True: 8 and 16. Answered: 9, 11, 19.
  const auto figures = Hidden("segments").score("1,0,9,\n1,9,11,\n1,11,19,\n1,19,20,\n");
  CHECK(figures.at("precision_within_2") == Approx(1.0 / 3));
  CHECK(figures.at("recall_within_2") == Approx(0.5));
  CHECK(figures.at("f1_within_2") == Approx(0.4));
  CHECK(figures.at("f1_within_5") == Approx(0.8));
  CHECK(figures.at("mean_iou") == Approx((8.0 / 9 + 5.0 / 11) / 2));
  CHECK_FALSE(figures.contains("nmi"));  // boundaries alone
}

TEST_CASE("names of one's own are matched with the true ones, and ours by chance do not count by themselves") {
  const Hidden hidden("segments");
  const auto swapped = hidden.score("1,0,8,put\n1,8,16,pick\n");  // right but for names
  CHECK(swapped.at("frames_right") == Approx(1));
  CHECK(swapped.at("edit") == Approx(1));
  const auto split = hidden.score("1,0,4,a\n1,4,8,b\n1,8,16,c\n");
  CHECK(split.at("frames_right") == Approx(12.0 / 16));
  CHECK(split.at("edit") == Approx(2.0 / 3));
  CHECK(split.at("f1_at_50") == Approx(2 * 2.0 / 5));
  CHECK(split.at("f1_at_50") > 0.5);
  const auto supervised = Hidden("segments_supervised").score("1,0,8,put\n1,8,16,pick\n");
  CHECK(supervised.at("frames_right") == Approx(0));
  CHECK(supervised.at("nmi") == Approx(1));
}

TEST_CASE("segments that cannot be are refused") {
  const Hidden hidden("segments_supervised");
  using Catch::Contains;
  CHECK_THROWS_WITH(hidden.score("1,0,21,pick\n"),
                    Contains("answer 1") && Contains("beyond the frames") && Contains("0 to 19"));
  CHECK_THROWS_WITH(hidden.score("1,-1,3,pick\n"), Contains("beyond the frames"));
  CHECK_THROWS_WITH(hidden.score("1,3,3,pick\n"), Contains("empty"));
  CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n1,7,9,put\n"), Contains("overlap at frame 7"));
  CHECK_THROWS_WITH(hidden.score("1,0,8,pck\n"), Contains("the label 'pck'") && Contains("did you mean 'pick'"));
  CHECK_THROWS_WITH(hidden.score("2,0,8,pick\n"),
                    Contains("no answer for 1 of the 1 episodes of the test split, the first: 1"));
  CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n3,0,8,pick\n"), Contains("no episode 3"));
  CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n", "def"), Contains("another data set: def, not abc"));
  ScoreOptions options;
  options.figure = "/nowhere/figure.svg";
  CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n", "abc", options), Contains("holds no joints"));
  options.figure_episode = 2;
  CHECK_THROWS_WITH(hidden.score("1,0,8,pick\n", "abc", options), Contains("not of the test split"));
}

}  // namespace stampede::research
