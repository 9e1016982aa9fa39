// Numbers about frames against the true ones: actions, rewards, predictions.
#include <algorithm>
#include <cmath>
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
  std::vector<double> truth, answers, last_of_successes, last_of_failures;
  Mean within;
  for (const std::int64_t episode : job.test_units) {
    const Rows rows =
        job.hidden.query("SELECT frame, progress FROM progress WHERE episode = ?1 ORDER BY frame", {episode});
    const Rows task = job.hidden.query("SELECT outcome FROM tasks WHERE episode = ?1", {episode});
    std::vector<double> here, said;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (rows.integer(i, "frame") % kRewardEvery != 0) continue;
      const std::size_t row = row_about(job, places, {episode, rows.integer(i, "frame"), ""});
      here.push_back(rows.real(i, "progress")), said.push_back(job.answers.rows.real(row, "value"));
    }
    if (here.empty()) continue;
    (task.text(0, "outcome") == "success" ? last_of_successes : last_of_failures).push_back(said.back());
    if (const auto rank = spearman(here, said)) within.add(*rank);
    truth.insert(truth.end(), here.begin(), here.end()), answers.insert(answers.end(), said.begin(), said.end());
  }
  std::vector<Figure> figures = {
      {"spearman_within", within.value(), "rank correlation with progress within an episode, mean"},
      {"spearman", spearman(truth, answers).value_or(0), "rank correlation with progress over all test frames"},
      {"kendall", kendall(truth, answers).value_or(0), "Kendall's tau-b with progress over all test frames"}};
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
