// Commanded joints and opening against the true ones.
#include <algorithm>
#include <cmath>

#include "db/research/frame_answers.h"
#include "db/research/scorers/functions.h"

namespace stampede::research {
namespace {

constexpr const char* kJoints[] = {"j1", "j2", "j3", "j4", "j5", "j6", "j7"};

}  // namespace

std::vector<Figure> score_actions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const Places places = places_of(job);
  const Rows truth = job.hidden.query("SELECT * FROM actions ORDER BY episode, frame");
  double widest = 0;
  for (std::size_t i = 0; i < truth.size(); ++i)
    if (!truth.is_null(i, "action_gripper")) widest = std::max(widest, truth.real(i, "action_gripper"));
  Mean squared, gripper, width;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const std::size_t row = row_about(job, places, {truth.integer(i, "episode"), truth.integer(i, "frame"), ""});
    for (const char* joint : kJoints) {
      const std::string there = std::string("action_") + joint;
      if (!truth.is_null(i, there)) squared.add(std::pow(job.answers.rows.real(row, joint) - truth.real(i, there), 2));
    }
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
