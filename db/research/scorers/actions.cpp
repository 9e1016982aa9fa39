// Commanded joints and opening against the true ones.
#include <algorithm>
#include <cmath>

#include "db/research/arm_joints.h"
#include "db/research/frame_answers.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"

namespace stampede::research {
namespace {

// Of the joints that the arm of that episode has; an answer that lacks one of them is none.
void add_joints(const ScoringJob& job, const Rows& truth, std::pair<std::size_t, std::size_t> rows, int most,
                Mean& squared) {
  const auto [i, row] = rows;  // of the truth, of the answers
  for (int joint = 1; joint <= most; ++joint) {
    const std::string there = column_of_joint("action_j", joint), said = column_of_joint("j", joint);
    if (truth.is_null(i, there)) continue;
    if (job.answers.rows.is_null(row, said))
      throw Error(job.answers.where + ", answer " + std::to_string(row + 1),
                  "'" + said + "' is missing, of " +
                      name_of(truth.integer(i, "episode"), truth.integer(i, "frame"), "whose arm has that joint"),
                  "table joints says in arm_joint how many the arm of each episode has");
    squared.add(std::pow(job.answers.rows.real(row, said) - truth.real(i, there), 2));
  }
}

}  // namespace

std::vector<Figure> score_actions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const Places places = places_of(job);
  const Rows truth = job.hidden.query("SELECT * FROM actions ORDER BY episode, frame");
  double widest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!truth.is_null(i, "action_gripper")) widest = std::max(widest, truth.real(i, "action_gripper"));
  const int most = arm_joints_of(job.hidden).most;
  Mean squared, gripper, width;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::size_t row = row_about(job, places, {truth.integer(i, "episode"), truth.integer(i, "frame"), ""});
    add_joints(job, truth, {i, row}, most, squared);
    if (truth.is_null(i, "action_gripper")) continue;
    const double wanted = truth.real(i, "action_gripper"), said = job.answers.rows.real(row, "gripper");
    gripper.add((wanted > widest / 2) == (said > widest / 2) ? 1 : 0);
    width.add(std::abs(wanted - said));
  }
  return {{"joint_rmse", std::sqrt(squared.value()), "root mean square error of commanded joints, rad", false},
          {"gripper_right", gripper.value(), "frames where the hand is told to open or close as it was"},
          {"gripper_error", width.value(), "mean error of the commanded opening, m", false}};
}

}  // namespace stampede::research
