// Numbers about frames against the true ones: actions, rewards, predictions.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

#include "engine/base/error.h"
#include "scripting/research/ranks.h"
#include "scripting/research/scorers.h"

namespace stampede::research {
namespace {

constexpr const char* kJoints[] = {"j1", "j2", "j3", "j4", "j5", "j6", "j7"};
constexpr std::int64_t kRewardEvery = 10, kContextEvery = 40;  // frames

std::string name_of(std::int64_t episode, std::int64_t frame, const std::string& object = "") {
  return "frame " + std::to_string(frame) + " of episode " + std::to_string(episode) +
         (object.empty() ? "" : ", " + object);
}

using Place = std::tuple<std::int64_t, std::int64_t, std::string>;  // episode, frame, object

// Rows of the answers by what they are about. Throws Error for a second answer about the same.
std::map<Place, std::size_t> places_of(const ScoringJob& job, bool with_object) {
  std::map<Place, std::size_t> places;
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Place place = {rows.integer(i, "episode"), rows.integer(i, "frame"),
                         with_object ? rows.text(i, "object") : ""};
    if (!places.emplace(place, i).second)
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1),
                  name_of(std::get<0>(place), std::get<1>(place), std::get<2>(place)) + " is answered twice");
  }
  return places;
}

std::size_t row_about(const ScoringJob& job, const std::map<Place, std::size_t>& places, const Place& place) {
  const auto found = places.find(place);
  if (found != places.end()) return found->second;
  throw Error(job.answers.where,
              "there is no answer for " + name_of(std::get<0>(place), std::get<1>(place), std::get<2>(place)),
              "the given part's page says which frames are asked about");
}

// Answers about frames of test episodes that do not exist are mistakes, not extras.
void refuse_beyond_the_end(const ScoringJob& job) {
  std::map<std::int64_t, std::int64_t> frames;
  const Rows episodes = job.hidden.query("SELECT episode, frames FROM episodes");
  for (std::size_t i = 0; i < episodes.size(); ++i)
    frames[episodes.integer(i, "episode")] = episodes.integer(i, "frames");
  for (std::size_t i = 0; i < job.answers.rows.size(); ++i) {
    const std::int64_t episode = job.answers.rows.integer(i, "episode"), frame = job.answers.rows.integer(i, "frame");
    if (frame < 0 || frame >= frames.at(episode))
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1), name_of(episode, frame) + " is not there",
                  "it has frames 0 to " + std::to_string(frames.at(episode) - 1));
  }
}

struct Mean {
  double sum = 0, count = 0;
  void add(double value) { sum += value, ++count; }
  double value() const { return count > 0 ? sum / count : 0; }
};

// True and answered values of frames.
struct Ranked {
  std::vector<double> there, said;
  void add(const Ranked& more) {
    there.insert(there.end(), more.there.begin(), more.there.end());
    said.insert(said.end(), more.said.begin(), more.said.end());
  }
};

Ranked ranked(const ScoringJob& job, const std::map<Place, std::size_t>& places, std::int64_t episode,
              const std::string& select) {
  Ranked result;
  const Rows rows =
      job.hidden.query(select + " WHERE episode = ?1 AND frame % ?2 = 0 ORDER BY frame", {episode, kRewardEvery});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::size_t row = row_about(job, places, {episode, rows.integer(i, "frame"), ""});
    result.there.push_back(rows.real(i, "value")), result.said.push_back(job.answers.rows.real(row, "value"));
  }
  return result;
}

}  // namespace

std::vector<Figure> score_actions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const std::map<Place, std::size_t> places = places_of(job, false);
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

std::vector<Figure> score_rewards(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const std::map<Place, std::size_t> places = places_of(job, false);
  Ranked planned, goals;
  Mean within;
  std::vector<double> last_of_successes, last_of_failures;
  for (const std::int64_t episode : job.test_units) {
    const Ranked plan = ranked(job, places, episode, "SELECT frame, progress AS value FROM progress");
    const Ranked goal = ranked(job, places, episode, "SELECT frame, share AS value FROM goal_share");
    planned.add(plan), goals.add(goal);
    if (const auto rank = spearman(plan.there, plan.said)) within.add(*rank);
    const Rows task = job.hidden.query("SELECT outcome FROM tasks WHERE episode = ?1", {episode});
    if (!goal.said.empty())
      (task.text(0, "outcome") == "success" ? last_of_successes : last_of_failures).push_back(goal.said.back());
  }
  std::vector<Figure> figures = {
      {"spearman_within", within.value(), "rank correlation with the plan's progress within a success, mean"},
      {"spearman", spearman(planned.there, planned.said).value_or(0), "the same over all successes together"},
      {"spearman_goal", spearman(goals.there, goals.said).value_or(0),
       "rank correlation with the share of the goal, all frames"},
      {"kendall_goal", kendall(goals.there, goals.said).value_or(0),
       "Kendall's tau-b with the share of the goal, all frames"}};
  if (!last_of_successes.empty() && !last_of_failures.empty())
    figures.push_back({"auc", area_under_curve(last_of_successes, last_of_failures),
                       "how often the last frame of a success is above that of a failure"});
  return figures;
}

std::vector<Figure> score_predictions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const std::map<Place, std::size_t> places = places_of(job, true);
  constexpr double kMoved = 0.002;  // m: what rests jitters by less
  std::vector<Figure> figures;
  for (const std::int64_t horizon : {1, 5, 20})
    for (const auto& [table, name] : {std::pair{"hands", "hand"}, {"poses", "thing"}}) {
      Mean error, still;
      const Rows rows =
          job.hidden.query(std::string("SELECT a.episode, a.frame, a.object, a.x, a.y, a.z, b.x AS bx, b.y AS by, "
                                       "b.z AS bz FROM ") +
                               table + " a JOIN " + table +
                               " b ON b.episode = a.episode AND b.object = a.object AND b.frame = a.frame - ?1 "
                               "WHERE a.frame % ?2 = ?1 ORDER BY a.episode, a.frame, a.object",
                           {horizon, kContextEvery});
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const std::size_t row =
            row_about(job, places, {rows.integer(i, "episode"), rows.integer(i, "frame"), rows.text(i, "object")});
        const auto distance = [&](const Rows& from, std::size_t j, const char* x, const char* y, const char* z) {
          return std::hypot(rows.real(i, "x") - from.real(j, x), rows.real(i, "y") - from.real(j, y),
                            rows.real(i, "z") - from.real(j, z));
        };
        const double moved = distance(rows, i, "bx", "by", "bz");
        if (std::string(table) == "poses" && moved < kMoved) continue;
        error.add(distance(job.answers.rows, row, "x", "y", "z")), still.add(moved);
      }
      const std::string after = "_" + std::to_string(horizon);
      const std::string words = std::string(name) + "s " + std::to_string(horizon) + " frames on";
      figures.push_back({name + std::string("_error") + after, error.value(), "mean error of " + words + ", m", false});
      if (still.sum > 0)
        figures.push_back({name + std::string("_relative") + after, error.sum / still.sum,
                           "the same by that of saying that nothing moves", false});
    }
  return figures;
}

}  // namespace stampede::research
