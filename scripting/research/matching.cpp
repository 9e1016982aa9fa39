#include "scripting/research/matching.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stampede::research {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

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
  const auto rows = static_cast<int>(weights.rows()), columns = static_cast<int>(weights.cols());
  const int n = std::max(rows, columns);
  const auto cost = [&](int row, int column) {  // from 1; what is not there costs nothing
    return row <= rows && column <= columns ? -weights(row - 1, column - 1) : 0.0;
  };
  const auto size = static_cast<std::size_t>(n) + 1;
  std::vector<double> of_row(size, 0), of_column(size, 0);
  std::vector<int> row_of(size, 0), way(size, 0);
  for (int row = 1; row <= n; ++row) {
    row_of[0] = row;
    int column = 0;
    std::vector<double> least(size, kFar);
    std::vector<bool> used(size, false);
    do {
      used[static_cast<std::size_t>(column)] = true;
      const int at = row_of[static_cast<std::size_t>(column)];
      double step = kFar;
      int next = 0;
      for (int j = 1; j <= n; ++j) {
        const auto place = static_cast<std::size_t>(j);
        if (used[place]) continue;
        const double reduced = cost(at, j) - of_row[static_cast<std::size_t>(at)] - of_column[place];
        if (reduced < least[place]) least[place] = reduced, way[place] = column;
        if (least[place] < step) step = least[place], next = j;
      }
      for (std::size_t j = 0; j < size; ++j) {
        if (used[j])
          of_row[static_cast<std::size_t>(row_of[j])] += step, of_column[j] -= step;
        else
          least[j] -= step;
      }
      column = next;
    } while (row_of[static_cast<std::size_t>(column)] != 0);
    while (column != 0) {
      const int before = way[static_cast<std::size_t>(column)];
      row_of[static_cast<std::size_t>(column)] = row_of[static_cast<std::size_t>(before)];
      column = before;
    }
  }
  std::vector<int> match(static_cast<std::size_t>(rows), -1);
  for (int column = 1; column <= columns; ++column) {
    const int row = row_of[static_cast<std::size_t>(column)];
    if (row >= 1 && row <= rows) match[static_cast<std::size_t>(row) - 1] = column - 1;
  }
  return match;
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
