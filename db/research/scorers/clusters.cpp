// Names given to pieces of motion against the skills that made them.
#include <map>
#include <set>

#include "db/research/matching.h"
#include "db/research/scorers/functions.h"
#include "engine/base/error.h"

namespace stampede::research {

std::vector<Figure> score_clusters(const ScoringJob& job) {
  std::map<std::int64_t, std::string> answers;
  for (std::size_t i = 0; i < job.answers.rows.size(); ++i) {
    const auto [place, fresh] =
        answers.emplace(job.answers.rows.integer(i, "piece"), job.answers.rows.text(i, "cluster"));
    if (!fresh)
      throw Error(job.answers.where + ", answer " + std::to_string(i + 1),
                  "piece " + std::to_string(place->first) + " is answered twice", "give each piece one cluster");
  }
  std::map<std::pair<std::string, std::string>, double> counts;
  std::set<std::string> clusters, skills;
  for (const std::int64_t piece : job.test_units) {
    const std::string skill = job.hidden.query("SELECT skill FROM skills WHERE piece = ?1", {piece}).text(0, "skill");
    clusters.insert(answers.at(piece)), skills.insert(skill);
    ++counts[{answers.at(piece), skill}];
  }
  Eigen::MatrixXd table(clusters.size(), skills.size());
  Eigen::Index row = 0;
  for (const std::string& cluster : clusters) {
    Eigen::Index column = 0;
    for (const std::string& skill : skills) table(row, column++) = counts[{cluster, skill}];
    ++row;
  }
  const std::vector<int> match = best_matching(table);
  double right = 0;
  for (std::size_t i = 0; i < match.size(); ++i)
    if (match[i] >= 0) right += table(static_cast<Eigen::Index>(i), match[i]);
  const double total = table.sum();
  return {
      {"purity", table.rowwise().maxCoeff().sum() / total, "pieces whose skill is the most frequent of their cluster"},
      {"nmi", normalised_mutual_information(table), "mutual information of clusters and skills"},
      {"adjusted_rand", adjusted_rand_index(table), "pairs of pieces put together or apart rightly, chance is 0"},
      {"accuracy", right / total, "pieces right after matching clusters with skills one to one"},
      {"clusters", static_cast<double>(clusters.size()), "clusters that the answers use", false}};
}

}  // namespace stampede::research
