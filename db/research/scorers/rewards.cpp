// Rewards against how far plan and goal have come: by ranks, and as rewards.
#include <map>

#include "db/research/frame_answers.h"
#include "db/research/ranks.h"
#include "db/research/reward_distance.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"

namespace stampede::research {
namespace {

constexpr std::int64_t kRankedEvery = 10, kPairedEvery = 40;  // frames
constexpr double kComparedDiscount = 0.99;

// Values of frames and, where the answers have some, rewards of going from a frame to another of the same episode.
struct Said {
  Places values;                                                                      // episode, frame
  std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, std::size_t> pairs;  // episode, frame, next frame
};

Said what_is_said(const ScoringJob& job) {
  Said said;
  const Rows& rows = job.answers.rows;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::int64_t episode = rows.integer(i, "episode"), frame = rows.integer(i, "frame");
    const bool fresh = rows.is_null(i, "next_frame")
                           ? said.values.emplace(Place{episode, frame, ""}, i).second
                           : said.pairs.emplace(std::tuple{episode, frame, rows.integer(i, "next_frame")}, i).second;
    if (!fresh)
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1),
                  name_of(episode, frame) + " is answered twice");
  }
  return said;
}

double said_of(const ScoringJob& job, const Places& places, std::int64_t episode, std::int64_t frame) {
  return job.answers.rows.real(row_about(job, places, {episode, frame, ""}), "value");
}

// True and answered values of frames.
struct Ranked {
  std::vector<double> there, said;
  void add(const Ranked& more) {
    there.insert(there.end(), more.there.begin(), more.there.end());
    said.insert(said.end(), more.said.begin(), more.said.end());
  }
};

Ranked ranked(const ScoringJob& job, const Places& places, std::int64_t episode, const std::string& select) {
  Ranked result;
  const Rows rows =
      job.hidden.query(select + " WHERE episode = ?1 AND frame % ?2 = 0 ORDER BY frame", {episode, kRankedEvery});
  for (std::size_t i = 0; i < rows.size(); ++i) {
    result.there.push_back(rows.real(i, "value"));
    result.said.push_back(said_of(job, places, episode, rows.integer(i, "frame")));
  }
  return result;
}

// Rewards of all pairs of some frames of an episode: the truth's is the share of the goal where one arrives.
struct Pairs {
  std::vector<Eigen::MatrixXd> there, said;  // canonical, by episode
};

void add_pairs(const ScoringJob& job, const Said& said, std::int64_t episode, Pairs& pairs) {
  const Rows rows =
      job.hidden.query("SELECT frame, share FROM goal_share WHERE episode = ?1 AND frame % ?2 = 0 ORDER BY frame",
                       {episode, kPairedEvery});
  const auto count = static_cast<Eigen::Index>(rows.size());
  if (count == 0) return;
  Eigen::MatrixXd there(count, count), here(count, count);
  for (Eigen::Index j = 0; j < count; ++j) {
    const std::int64_t next = rows.integer(static_cast<std::size_t>(j), "frame");
    there.col(j).setConstant(rows.real(static_cast<std::size_t>(j), "share"));
    for (Eigen::Index i = 0; i < count; ++i) {
      const std::int64_t frame = rows.integer(static_cast<std::size_t>(i), "frame");
      const auto found = said.pairs.find({episode, frame, next});
      if (found == said.pairs.end() && !said.pairs.empty())
        throw Error(job.answers.where,
                    "there is no reward for going from frame " + std::to_string(frame) + " to frame " +
                        std::to_string(next) + " of episode " + std::to_string(episode),
                    "where there is any 'next_frame', all pairs of every " + std::to_string(kPairedEvery) +
                        "th frame of each test episode are asked about");
      here(i, j) =
          said.pairs.empty() ? said_of(job, said.values, episode, next) : job.answers.rows.real(found->second, "value");
    }
  }
  pairs.there.push_back(canonical_reward(there, kComparedDiscount)),
      pairs.said.push_back(canonical_reward(here, kComparedDiscount));
}

}  // namespace

std::vector<Figure> score_rewards(const ScoringJob& job) {
  refuse_beyond_the_end(job);
  const Said said = what_is_said(job);
  Ranked planned, goals;
  Mean within;
  Pairs pairs;
  std::vector<double> last_of_successes, last_of_failures;
  for (const std::int64_t episode : job.test_units) {
    const Ranked plan = ranked(job, said.values, episode, "SELECT frame, progress AS value FROM progress");
    const Ranked goal = ranked(job, said.values, episode, "SELECT frame, share AS value FROM goal_share");
    planned.add(plan), goals.add(goal);
    add_pairs(job, said, episode, pairs);
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
  if (const auto distance = pearson_distance(pairs.there, pairs.said))
    figures.push_back(
        {"epic", *distance, "EPIC distance to the share of the goal: 0 equal, 0.71 unrelated, 1 opposite", false});
  return figures;
}

}  // namespace stampede::research
