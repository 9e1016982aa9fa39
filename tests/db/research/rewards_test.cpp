// Distances of rewards, worked out by hand; and what answers about rewards must hold.
#include <catch2/catch.hpp>

#include "db/research/baseline.h"
#include "db/research/dataset.h"
#include "db/research/reward_distance.h"
#include "db/research/scorer.h"
#include "engine/base/error.h"
#include "engine/base/temporary_folder.h"
#include "engine/base/text_file.h"

namespace stampede::research {
namespace {

Eigen::MatrixXd two_by_two(double a, double b, double c, double d) {
  Eigen::MatrixXd matrix(2, 2);
  matrix << a, b, c, d;
  return matrix;
}

double epic(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double discount) {
  return *pearson_distance({canonical_reward(a, discount)}, {canonical_reward(b, discount)});
}

// Episode 1 tests: 90 frames, of which the goal holds by half from 40 on and wholly from 80 on. Episode 2 trains.
class HiddenRewards {
 public:
  HiddenRewards() {
    PlainFileWriter file(folder_.path() / kHiddenFile);
    file.table("dataset", {"id", "problem", "split"});
    file.row({std::string("abc"), std::string("rewards"), std::string("seeds")});
    file.table("episodes", {"episode", "split", "frames", "frame_hz"});
    file.row({std::int64_t{1}, std::string("test"), std::int64_t{90}, std::int64_t{10}});
    file.row({std::int64_t{2}, std::string("train"), std::int64_t{90}, std::int64_t{10}});
    file.table("progress", {"episode", "frame", "progress"});
    for (std::int64_t frame = 0; frame < 90; ++frame)
      file.row({std::int64_t{1}, frame, static_cast<double>(frame) / 90});
    file.table("goal_share", {"episode", "frame", "share"});
    for (std::int64_t frame = 0; frame < 90; ++frame) file.row({std::int64_t{1}, frame, share(frame)});
    file.table("tasks", {"episode", "task", "world", "variation", "outcome"});
    file.row({std::int64_t{1}, std::string("t"), std::string("w"), std::string(), std::string("success")});
    file.finish();
  }
  static double share(std::int64_t frame) { return frame >= 80 ? 1 : frame >= 40 ? 0.5 : 0; }
  std::map<std::string, double> score(const std::string& rows) const {
    write_text_file(folder_.path() / "a.csv", "# dataset: abc\nepisode,frame,value,next_frame\n" + rows);
    std::map<std::string, double> figures;
    for (const Figure& figure : research::score(folder_.path() / "a.csv", folder_.path(), {}).figures)
      figures[figure.name] = figure.value;
    return figures;
  }

 private:
  TemporaryFolder folder_;
};

template <typename Value>
std::string value_rows(Value value) {
  std::string rows;
  for (std::int64_t frame = 0; frame < 90; frame += 10)
    rows += "1," + std::to_string(frame) + "," + std::to_string(value(frame)) + ",\n";
  return rows;
}

// Two cubes on a table, one of them rises: the one that the sentence asks for, or the other. Which has which name is
// dealt by the number of the episode.
void write_lifts(const std::filesystem::path& folder) {
  constexpr std::int64_t kEpisodes = 12, kFrames = 21;
  const auto asked_rises = [](std::int64_t episode) { return episode % 2 == 0; };
  const auto asked = [](std::int64_t episode) { return std::string(episode % 3 == 0 ? "cube1" : "cube2"); };
  const auto text = [](const char* word) { return SqlValue(std::string(word)); };
  PlainFileWriter file(folder / kGivenFile);
  file.table("dataset", {"id", "problem", "split"});
  file.row({text("abc"), text("rewards"), text("seeds")});
  file.table("episodes", {"episode", "split", "frames", "frame_hz"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e)
    file.row({e, text(e > 8 ? "test" : "train"), kFrames, std::int64_t{10}});
  file.table("instructions", {"episode", "text"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e) file.row({e, text("Lift the red cube.")});
  file.table("objects",
             {"episode", "object", "kind", "class", "type", "size_x", "size_y", "size_z", "colour", "traits"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e)
    for (const char* name : {"cube1", "cube2"})
      file.row({e, text(name), text("body"), text("cube"), text("cube"), 0.04, 0.04, 0.04,
                text(asked(e) == name ? "red" : "blue"), text("[\"movable\"]")});
  file.table("poses", {"episode", "frame", "object", "x", "y", "z"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e)
    for (std::int64_t frame = 0; frame < kFrames; ++frame)
      for (const char* name : {"cube1", "cube2"}) {
        const bool rises = (asked(e) == name) == asked_rises(e);
        file.row({e, frame, text(name), text(name) == text("cube1") ? 0.0 : 0.2, 0.0,
                  rises ? 0.01 * static_cast<double>(frame) : 0.0});
      }
  file.table("object_joints", {"episode", "frame", "joint", "position", "velocity"});
  file.table("joints", {"episode", "frame", "joint", "arm_joint", "position", "velocity"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e)
    for (std::int64_t frame = 0; frame < kFrames; ++frame)
      file.row({e, frame, text("joint1"), std::int64_t{1}, 0.0, 0.0});
  file.table("hands", {"episode", "frame", "hand", "x", "y", "z", "qx", "qy", "qz", "qw", "linear_x", "linear_y",
                       "linear_z", "angular_x", "angular_y", "angular_z", "opening", "touch_1", "touch_2"});
  for (std::int64_t e = 1; e <= kEpisodes; ++e)
    for (std::int64_t frame = 0; frame < kFrames; ++frame) {
      std::vector<SqlValue> row = {e, frame, text("hand")};
      row.resize(19, 0.0);
      file.row(row);
    }
  file.table("rewards", {"episode", "frame", "reward", "done"});
  for (std::int64_t e = 1; e <= 8; ++e)
    for (std::int64_t frame = 0; frame < kFrames; ++frame) {
      const std::int64_t done = asked_rises(e) && frame == kFrames - 1;
      file.row({e, frame, static_cast<double>(done), done});
    }
  file.finish();
}

}  // namespace

TEST_CASE("the baseline of rewards tells what was asked for from the same done with another thing") {
  const TemporaryFolder folder;
  write_lifts(folder.path());
  const Answers answers = answer_by(find_baseline("goal_relations"), folder.path());
  std::map<std::pair<std::int64_t, std::int64_t>, double> value;
  for (std::size_t i = 0; i < answers.rows.size(); ++i)
    value[{answers.rows.integer(i, "episode"), answers.rows.integer(i, "frame")}] = answers.rows.real(i, "value");
  CHECK(value.size() == 4 * 3);  // every 10th frame of the episodes that test
  for (const std::int64_t success : {10, 12}) {
    CHECK(value.at({success, 0}) < value.at({success, 10}));
    CHECK(value.at({success, 10}) < value.at({success, 20}));
    for (const std::int64_t failure : {9, 11}) CHECK(value.at({success, 20}) > value.at({failure, 20}) + 0.5);
  }
}

TEST_CASE("EPIC by hand: shaping and scale make no difference, and what is left of a reward is known") {
  constexpr double kDiscount = 0.5;
  const Eigen::MatrixXd reward = two_by_two(0, 1, 0, 3);
  // Means from each state 0.5 and 1.5, over all 1: R + 0.5 (0.5, 1.5 by column) - (0.5, 1.5 by row) - 0.5.
  CHECK(canonical_reward(reward, kDiscount).isApprox(two_by_two(-0.75, 0.75, -1.75, 1.75)));
  // Shaped by the potentials 2 and -4: added is 0.5 P(j) - P(i).
  const Eigen::MatrixXd shaping = two_by_two(1 - 2, -2 - 2, 1 + 4, -2 + 4);
  CHECK(epic(reward, 7 * (reward + shaping), kDiscount) == Approx(0).margin(1e-7));
  CHECK(epic(reward, -reward + shaping, kDiscount) == Approx(1));
  // Of arriving in the second state: (-0.5, 0.5; -0.5, 0.5); correlation 2.5 / sqrt(7.25 * 1) = 0.928477.
  CHECK(epic(reward, two_by_two(0, 1, 0, 1), kDiscount) == Approx(std::sqrt((1 - 2.5 / std::sqrt(7.25)) / 2)));
  // With another discount the same shaping is none.
  CHECK(epic(reward, reward + shaping, 0.9) > 0.05);
  CHECK_FALSE(pearson_distance({canonical_reward(reward, kDiscount)}, {canonical_reward(shaping, kDiscount)}));
  CHECK_FALSE(pearson_distance({}, {}));
}

TEST_CASE("values of frames count as rewards of arriving, and rewards of transitions may be shaped") {
  const HiddenRewards hidden;
  const auto truth = hidden.score(value_rows([](std::int64_t frame) { return 5 * HiddenRewards::share(frame) - 1; }));
  CHECK(truth.at("epic") == Approx(0).margin(1e-7));
  CHECK(truth.at("spearman_goal") == Approx(1));
  CHECK(hidden.score(value_rows([](std::int64_t frame) { return -frame; })).at("epic") == Approx(1));
  // 0, 40, 80 against 0, 0.5, 0.5: correlation 0.866025.
  const auto flat = hidden.score(value_rows([](std::int64_t frame) { return frame < 40 ? 0 : 1; }));
  CHECK(flat.at("epic") == Approx(std::sqrt((1 - std::sqrt(3) / 2) / 2)));
  CHECK_FALSE(hidden.score(value_rows([](std::int64_t) { return 1; })).contains("epic"));
  std::string pairs = value_rows([](std::int64_t frame) { return -frame; });
  const auto potential = [](std::int64_t frame) { return static_cast<double>(frame % 7) - 3; };
  for (const std::int64_t frame : {0, 40, 80})
    for (const std::int64_t next : {0, 40, 80})
      pairs += "1," + std::to_string(frame) + "," +
               std::to_string(2 * HiddenRewards::share(next) + 0.99 * potential(next) - potential(frame)) + "," +
               std::to_string(next) + "\n";
  const auto shaped = hidden.score(pairs);
  CHECK(shaped.at("epic") == Approx(0).margin(1e-6));
  CHECK(shaped.at("spearman_within") == Approx(-1));
}

TEST_CASE("rewards that are missing or said twice are refused") {
  const HiddenRewards hidden;
  using Catch::Contains;
  const std::string all = value_rows([](std::int64_t frame) { return frame; });
  CHECK_THROWS_WITH(hidden.score(all + "1,10,2,\n"), Contains("frame 10 of episode 1 is answered twice"));
  CHECK_THROWS_WITH(hidden.score(all + "1,0,2,40\n"), Contains("from frame 0 to frame 0 of episode 1"));
  CHECK_THROWS_WITH(hidden.score(all + "1,0,2,40\n1,0,2,40\n"), Contains("answered twice"));
  CHECK_THROWS_WITH(hidden.score("1,0,2,40\n"), Contains("no answer for frame 0 of episode 1"));
}

}  // namespace stampede::research
