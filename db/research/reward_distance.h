// EPIC, a distance of rewards that no shaping and no scale changes (Gleave, Dennis, Legg, Russell, Leike, Quantifying
// differences in reward functions, ICLR 2021).
#pragma once

#include <Eigen/Dense>
#include <optional>
#include <vector>

namespace stampede::research {

// `rewards`(i, j): of going from state i to state j. What is left of it once shaping is taken away: any potential P
// that is added as discount * P(j) - P(i) leaves the same. States are drawn uniformly and independently; rewards do not
// depend on actions.
Eigen::MatrixXd canonical_reward(const Eigen::MatrixXd& rewards, double discount);

// Pearson's distance of two rewards over all pairs of states of each of some worlds (their canonical rewards, one
// matrix a world, together): 0 equal but for scale, sqrt(1/2) unrelated, 1 opposite. Nothing where one is constant.
std::optional<double> pearson_distance(const std::vector<Eigen::MatrixXd>& a, const std::vector<Eigen::MatrixXd>& b);

}  // namespace stampede::research
