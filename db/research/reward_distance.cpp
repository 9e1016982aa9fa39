#include "db/research/reward_distance.h"

#include <algorithm>
#include <cmath>

namespace stampede::research {

Eigen::MatrixXd canonical_reward(const Eigen::MatrixXd& rewards, double discount) {
  const Eigen::VectorXd onwards = rewards.rowwise().mean();  // from each state to any
  Eigen::MatrixXd canonical = rewards;
  canonical.rowwise() += discount * onwards.transpose();
  canonical.colwise() -= onwards;
  canonical.array() -= discount * rewards.mean();
  // Rounding of a reward that is shaping alone is not what is left of it.
  if (canonical.cwiseAbs().maxCoeff() < 1e-9 * rewards.cwiseAbs().maxCoeff()) canonical.setZero();
  return canonical;
}

std::optional<double> pearson_distance(const std::vector<Eigen::MatrixXd>& a, const std::vector<Eigen::MatrixXd>& b) {
  double both = 0, of_a = 0, of_b = 0;  // canonical rewards have mean 0
  for (std::size_t i = 0; i < a.size(); ++i) {
    both += a[i].cwiseProduct(b[i]).sum();
    of_a += a[i].squaredNorm(), of_b += b[i].squaredNorm();
  }
  if (of_a == 0 || of_b == 0) return std::nullopt;
  return std::sqrt(std::clamp((1 - both / std::sqrt(of_a * of_b)) / 2, 0.0, 1.0));
}

}  // namespace stampede::research
