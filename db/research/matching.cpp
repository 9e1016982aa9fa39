#include "db/research/matching.h"

#include <algorithm>
#include <cmath>

#include "engine/learning/assignment.h"

namespace stampede::research {
namespace {

double entropy_of(const Eigen::VectorXd& counts, double total) {
  double entropy = 0;
  for (const double count : counts)
    if (count > 0) entropy -= count / total * std::log(count / total);
  return entropy;
}

double pairs_in(double count) { return count * (count - 1) / 2; }

double pairs_in(const Eigen::MatrixXd& counts) {
  double sum = 0;
  for (Eigen::Index i = 0; i < counts.size(); ++i) sum += pairs_in(counts.data()[i]);
  return sum;
}

}  // namespace

std::vector<int> best_matching(const Eigen::MatrixXd& weights) {
  std::vector<std::vector<double>> gains(static_cast<std::size_t>(weights.rows()));
  for (Eigen::Index row = 0; row < weights.rows(); ++row)
    for (Eigen::Index column = 0; column < weights.cols(); ++column)
      gains[static_cast<std::size_t>(row)].push_back(weights(row, column));
  return learning::full_assignment(gains);
}

double normalised_mutual_information(const Eigen::MatrixXd& counts) {
  const double total = counts.sum();
  if (total == 0) return 0;
  const Eigen::VectorXd rows = counts.rowwise().sum(), columns = counts.colwise().sum();
  const double both = (entropy_of(rows, total) + entropy_of(columns, total)) / 2;
  if (both == 0) return 1;
  double information = 0;
  for (Eigen::Index i = 0; i < counts.rows(); ++i)
    for (Eigen::Index j = 0; j < counts.cols(); ++j)
      if (counts(i, j) > 0)
        information += counts(i, j) / total * std::log(counts(i, j) * total / (rows(i) * columns(j)));
  return std::clamp(information / both, 0.0, 1.0);
}

double adjusted_rand_index(const Eigen::MatrixXd& counts) {
  const double total = pairs_in(counts.sum());
  if (total == 0) return 0;
  const double rows = pairs_in(counts.rowwise().sum().eval()), columns = pairs_in(counts.colwise().sum().eval());
  const double expected = rows * columns / total, most = (rows + columns) / 2;
  return most == expected ? 1 : (pairs_in(counts) - expected) / (most - expected);
}

}  // namespace stampede::research
