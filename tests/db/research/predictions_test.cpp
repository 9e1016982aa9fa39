// Figures of predictions, worked out by hand: one context, and 1, 5 and 20 frames after it.
#include <catch2/catch.hpp>

#include "db/research/dataset.h"
#include "db/research/scorer.h"
#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"

namespace stampede::research {
namespace {

// Over 1, 5, 20 frames hand and block come 0.1, 0.5, 2 m along x, the arm's joint 0.1, 0.5, 2 rad, the drawer 0.1, 0.5,
// 2 m; another drawer rests. After 20 frames the block is held and no longer on the table.
class HiddenFutures {
 public:
  HiddenFutures() {
    PlainFileWriter file(folder_.path() / kHiddenFile);
    file.table("dataset", {"id", "problem", "split"});
    file.row({text("abc"), text("transition_models"), text("seeds")});
    file.table("episodes", {"episode", "split", "frames", "frame_hz"});
    file.row({kOne, text("test"), std::int64_t{21}, std::int64_t{10}});
    for (const auto& [table, object] : {std::pair{"hands", "hand"}, {"poses", "block"}}) {
      file.table(table, {"episode", "frame", "object", "x", "y", "z"});
      for (const std::int64_t frame : kFrames) file.row({kOne, frame, text(object), come(frame), 0.0, 0.0});
    }
    file.table("joints", {"episode", "frame", "joint", "kind", "driven", "arm_joint", "position"});
    for (const std::int64_t frame : kFrames) {
      file.row({kOne, frame, text("arm1"), text("hinge"), kOne, kOne, come(frame)});
      file.row({kOne, frame, text("drawer"), text("slider"), std::int64_t{0}, {}, come(frame)});
      file.row({kOne, frame, text("thumb"), text("hinge"), kOne, {}, come(frame)});
      file.row({kOne, frame, text("other"), text("slider"), std::int64_t{0}, {}, 0.3});
    }
    file.table("facts", {"episode", "frame", "fact"});
    for (const std::int64_t frame : kFrames) {
      file.row({kOne, frame, text(frame == 20 ? "(holding hand block)" : "(on block table)")});
      if (frame > 1) file.row({kOne, frame, text("(near hand)")});
    }
    file.finish();
  }
  std::map<std::string, double> score(const std::string& rows) const {
    write_text_file(folder_.path() / "a.csv",
                    "# dataset: abc\nepisode,frame,object,x,y,z,joint,position,fact\n" + positions() + rows);
    std::map<std::string, double> figures;
    for (const Figure& figure : research::score(folder_.path() / "a.csv", folder_.path(), {}).figures)
      figures[figure.name] = figure.value;
    return figures;
  }
  std::map<std::string, double> score_positions_alone() const {  // as answers were before there were joints and facts
    std::string rows = "# dataset: abc\nepisode,frame,object,x,y,z\n";
    for (const int frame : {1, 5, 20})
      for (const char* object : {"hand", "block"}) rows += "1," + std::to_string(frame) + "," + object + ",0,0,0\n";
    write_text_file(folder_.path() / "a.csv", rows);
    std::map<std::string, double> figures;
    for (const Figure& figure : research::score(folder_.path() / "a.csv", folder_.path(), {}).figures)
      figures[figure.name] = figure.value;
    return figures;
  }

 private:
  static constexpr std::int64_t kOne = 1, kFrames[] = {0, 1, 5, 20};
  static SqlValue text(const char* word) { return std::string(word); }
  static double come(std::int64_t frame) { return 0.1 * static_cast<double>(frame); }
  static std::string positions() {
    std::string rows;
    for (const int frame : {1, 5, 20})
      for (const char* object : {"hand", "block"}) rows += "1," + std::to_string(frame) + "," + object + ",0,0,0,,,\n";
    return rows;
  }
  TemporaryFolder folder_;
};

std::string joint_rows(const std::string& position) {
  std::string rows;
  for (const int frame : {1, 5, 20})
    for (const char* joint : {"arm1", "drawer", "other"})
      rows += "1," + std::to_string(frame) + ",,,,," + joint + "," + position + ",\n";
  return rows;
}

}  // namespace

TEST_CASE("answers with positions alone are scored without joints and facts") {
  const auto figures = HiddenFutures().score_positions_alone();
  CHECK(figures.size() == 12);
  CHECK(figures.at("hand_error_5") == Approx(0.5));
  CHECK(figures.at("thing_relative_20") == Approx(1));
}

TEST_CASE("joints: the arm's in rad, those of things that moved by kind") {
  const auto figures = HiddenFutures().score(joint_rows("0.5"));
  CHECK(figures.at("joint_error_1") == Approx(0.4));
  CHECK(figures.at("joint_relative_1") == Approx(4));
  CHECK(figures.at("joint_error_5") == Approx(0).margin(1e-12));
  CHECK(figures.at("slider_error_20") == Approx(1.5));  // not of the drawer that rests
  CHECK(figures.at("slider_relative_20") == Approx(0.75));
  CHECK_FALSE(figures.contains("hinge_error_1"));
  CHECK_FALSE(figures.contains("changes_f1_1"));
}

TEST_CASE("facts: those that begin and end since the context") {
  // After 1 frame nothing changes. After 5 one begins. After 20 two begin and one ends: of these are said the holding
  // and the end of (on block table), and a third that does not hold.
  const auto figures = HiddenFutures().score(
      "1,1,,,,,,,(on block table)\n1,5,,,,,,,(on block table)\n1,20,,,,,,,(holding hand block)\n1,20,,,,,,,(far "
      "hand)\n");
  CHECK_FALSE(figures.contains("changes_f1_1"));
  CHECK(figures.at("changes_f1_5") == 0);
  CHECK(figures.at("changes_precision_20") == Approx(2.0 / 3));
  CHECK(figures.at("changes_recall_20") == Approx(2.0 / 3));
  CHECK(figures.at("changes_f1_20") == Approx(2.0 / 3));
  CHECK_FALSE(figures.contains("joint_error_1"));
}

TEST_CASE("rows of predictions that say too much or too little are refused") {
  const HiddenFutures hidden;
  using Catch::Contains;
  CHECK_THROWS_WITH(hidden.score("1,1,,,,,,,\n"), Contains("answer 7") && Contains("no thing, joint or fact"));
  CHECK_THROWS_WITH(hidden.score("1,1,table,0,0,0,arm1,0,\n"), Contains("or about several"));
  CHECK_THROWS_WITH(hidden.score("1,1,table,0,,0,,,\n"), Contains("object, x, y and z"));
  CHECK_THROWS_WITH(hidden.score("1,1,,,,,arm1,,\n"), Contains("joint and position"));
  CHECK_THROWS_WITH(hidden.score("1,1,,,,,arm1,0.5,\n"), Contains("no answer for frame 1 of episode 1, drawer"));
  CHECK_THROWS_WITH(hidden.score("1,1,,,,,,,on block\n"), Contains("no ground atom"));
  CHECK_THROWS_WITH(hidden.score("1,1,,,,,,,(a b)\n1,1,,,,,,,(a b)\n"), Contains("(a b) is answered twice"));
  CHECK_THROWS_WITH(hidden.score("1,1,block,0,0,0,,,\n"), Contains("block is answered twice"));
}

}  // namespace stampede::research
