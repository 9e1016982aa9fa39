// What will be against what was: positions, joints, and facts that change.
#include <cmath>
#include <set>

#include "db/research/frame_answers.h"
#include "db/research/scorers/functions.h"
#include "db/research/symbols_of.h"
#include "engine/base/error.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kPredictedEvery = 40;       // frames
constexpr std::int64_t kPredicted[] = {1, 5, 20};  // frames after each of them
constexpr double kMovedBetween = 0.002;            // m, rad: what rests jitters by less

// A row is about a thing, a joint or a fact, and says all that there is to say of it.
void check_rows(const ScoringJob& job) {
  const std::vector<std::string_view> thing{"object", "x", "y", "z"}, joint{"joint", "position"}, fact{"fact"};
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    std::vector<std::string_view> said;
    for (const std::string_view column : {"object", "x", "y", "z", "joint", "position", "fact"})
      if (!rows.is_null(i, column)) said.push_back(column);
    const std::string where = job.answers.where + ", answer " + std::to_string(i + 1);
    if (said != thing && said != joint && said != fact)
      throw Error(where, "it is about no thing, joint or fact, or about several",
                  "say object, x, y and z, or joint and position, or fact; leave out the others");
    if (said == fact) (void)fact_of(rows.text(i, "fact"), where);
  }
}

// Errors, and those of saying that nothing moves.
struct Errors {
  Mean said, still;
  void add(double error, double moved) { said.add(error), still.add(moved); }
};

void add_figures(const Errors& errors, const std::string& name, std::int64_t horizon, const std::string& words,
                 std::vector<Figure>& figures) {
  const std::string after = "_" + std::to_string(horizon);
  figures.push_back({name + "_error" + after, errors.said.value(), "mean error of " + words, false});
  if (errors.still.sum > 0)
    figures.push_back({name + "_relative" + after, errors.said.sum / errors.still.sum,
                       "the same by that of saying that nothing moves", false});
}

void score_positions(const ScoringJob& job, const Places& places, std::int64_t horizon, std::vector<Figure>& figures) {
  for (const auto& [table, name] : {std::pair{"hands", "hand"}, {"poses", "thing"}}) {
    Errors errors;
    const Rows rows =
        job.hidden.query(std::string("SELECT a.episode, a.frame, a.object, a.x, a.y, a.z, b.x AS bx, b.y AS by, "
                                     "b.z AS bz FROM ") +
                             table + " a JOIN " + table +
                             " b ON b.episode = a.episode AND b.object = a.object AND b.frame = a.frame - ?1 "
                             "WHERE a.frame % ?2 = ?1 ORDER BY a.episode, a.frame, a.object",
                         {horizon, kPredictedEvery});
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const std::size_t row =
          row_about(job, places, {rows.integer(i, "episode"), rows.integer(i, "frame"), rows.text(i, "object")});
      const auto distance = [&](const Rows& from, std::size_t j, const char* x, const char* y, const char* z) {
        return std::hypot(rows.real(i, "x") - from.real(j, x), rows.real(i, "y") - from.real(j, y),
                          rows.real(i, "z") - from.real(j, z));
      };
      const double moved = distance(rows, i, "bx", "by", "bz");
      if (std::string(table) == "poses" && moved < kMovedBetween) continue;
      errors.add(distance(job.answers.rows, row, "x", "y", "z"), moved);
    }
    if (errors.said.count > 0)  // of recordings, nobody knows where things were
      add_figures(errors, name, horizon, std::string(name) + "s " + std::to_string(horizon) + " frames on, m", figures);
  }
}

// Of the arm all joints; of things the joints that moved, hinges and sliders apart.
void score_joints(const ScoringJob& job, const Places& places, std::int64_t horizon, std::vector<Figure>& figures) {
  if (places.empty() || !job.hidden.has("joints")) return;
  Errors arm, hinges, sliders;
  const Rows rows = job.hidden.query(
      "SELECT a.episode, a.frame, a.joint, a.kind, a.driven, a.arm_joint, a.position, b.position AS before FROM joints "
      "a JOIN "
      "joints "
      "b ON b.episode = a.episode AND b.joint = a.joint AND b.frame = a.frame - ?1 WHERE a.frame % ?2 = ?1 "
      "ORDER BY a.episode, a.frame, a.joint",
      {horizon, kPredictedEvery});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool hinge = rows.text(i, "kind") == "hinge", of_arm = !rows.is_null(i, "arm_joint");
    if (rows.integer(i, "driven") != 0 && !of_arm) continue;  // fingers
    const std::size_t row =
        row_about(job, places, {rows.integer(i, "episode"), rows.integer(i, "frame"), rows.text(i, "joint")});
    const double there = rows.real(i, "position"), moved = std::abs(there - rows.real(i, "before"));
    if (!of_arm && moved < kMovedBetween) continue;
    (of_arm ? arm : hinge ? hinges : sliders).add(std::abs(job.answers.rows.real(row, "position") - there), moved);
  }
  const std::string on = std::to_string(horizon) + " frames on, ";
  add_figures(arm, "joint", horizon, "the arm's joints " + on + "rad", figures);
  if (hinges.said.count > 0)
    add_figures(hinges, "hinge", horizon, "hinges of things that moved " + on + "rad", figures);
  if (sliders.said.count > 0)
    add_figures(sliders, "slider", horizon, "sliders of things that moved " + on + "m", figures);
}

using FactsOf = std::map<std::pair<std::int64_t, std::int64_t>, std::set<std::string>>;  // by episode and frame

std::set<std::string> without(const std::set<std::string>& facts, const std::set<std::string>& others) {
  std::set<std::string> rest;
  for (const std::string& fact : facts)
    if (!others.contains(fact)) rest.insert(fact);
  return rest;
}

// Changes since the context: facts that began to hold, and facts that no longer do.
void score_changes(const ScoringJob& job, FactsOf& truth, FactsOf& said, std::int64_t horizon,
                   std::vector<Figure>& figures) {
  double there = 0, answered = 0, both = 0;
  for (const std::int64_t episode : job.test_units) {
    const std::int64_t frames =
        job.hidden.query("SELECT frames FROM episodes WHERE episode = ?1", {episode}).integer(0, "frames");
    for (std::int64_t frame = 0; frame + horizon < frames; frame += kPredictedEvery) {
      const std::set<std::string>& before = truth[{episode, frame}];
      const std::set<std::string>&after = truth[{episode, frame + horizon}], &guess = said[{episode, frame + horizon}];
      for (const auto& [changed, claimed] : {std::pair{without(after, before), without(guess, before)},
                                             {without(before, after), without(before, guess)}}) {
        there += static_cast<double>(changed.size()), answered += static_cast<double>(claimed.size());
        both += static_cast<double>(claimed.size() - without(claimed, changed).size());
      }
    }
  }
  if (there == 0) return;
  const std::string words = "facts that change within " + std::to_string(horizon) + " frames";
  const std::string after = "_" + std::to_string(horizon);
  figures.push_back({"changes_f1" + after, 2 * both / (there + answered), "F1 of " + words});
  figures.push_back({"changes_precision" + after, answered > 0 ? both / answered : 0, "precision of the same"});
  figures.push_back({"changes_recall" + after, both / there, "recall of the same"});
}

void score_changes(const ScoringJob& job, std::vector<Figure>& figures) {
  const Places places = places_of(job, "fact");
  if (places.empty() || !job.hidden.has("facts")) return;
  FactsOf truth, said;
  const Rows rows = job.hidden.query("SELECT episode, frame, fact FROM facts");
  for (std::size_t i = 0; i < rows.size(); ++i)
    truth[{rows.integer(i, "episode"), rows.integer(i, "frame")}].insert(rows.text(i, "fact"));
  for (const auto& [place, row] : places) said[{std::get<0>(place), std::get<1>(place)}].insert(std::get<2>(place));
  for (const std::int64_t horizon : kPredicted) score_changes(job, truth, said, horizon, figures);
}

}  // namespace

std::vector<Figure> score_predictions(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  check_rows(job);
  std::vector<Figure> figures;
  const Places things = places_of(job, "object"), joints = places_of(job, "joint");
  for (const std::int64_t horizon : kPredicted) score_positions(job, things, horizon, figures);
  for (const std::int64_t horizon : kPredicted) score_joints(job, joints, horizon, figures);
  score_changes(job, figures);
  return figures;
}

}  // namespace stampede::research
