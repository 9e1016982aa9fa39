#include "engine/learning/assignment.h"

#include <algorithm>
#include <limits>

namespace stampede::learning {
namespace {

// Shortest augmenting paths over costs of a square matrix; rows and columns count from 1, 0 is nobody.
class Matching {
 public:
  explicit Matching(std::vector<std::vector<double>> costs)
      : costs_(std::move(costs)), n_(costs_.size()), row_(n_ + 1), column_(n_ + 1), of_column_(n_ + 1), way_(n_ + 1) {
    for (std::size_t row = 1; row <= n_; ++row) add(row);
  }
  std::size_t row_of(std::size_t column) const { return of_column_[column + 1] - 1; }

 private:
  void add(std::size_t row) {
    std::vector<double> least(n_ + 1, std::numeric_limits<double>::infinity());
    std::vector<char> used(n_ + 1, 0);
    of_column_[0] = row;
    std::size_t at = 0;
    do {
      used[at] = 1;
      at = nearest(at, least, used);
    } while (of_column_[at] != 0);
    for (; at != 0; at = way_[at]) of_column_[at] = of_column_[way_[at]];
  }

  // Looks at all columns from `at`, shifts the potentials and says which free column is nearest now.
  std::size_t nearest(std::size_t at, std::vector<double>& least, const std::vector<char>& used) {
    const std::size_t row = of_column_[at];
    std::size_t next = 0;
    double step = std::numeric_limits<double>::infinity();
    for (std::size_t column = 1; column <= n_; ++column) {
      if (used[column] != 0) continue;
      const double cost = costs_[row - 1][column - 1] - row_[row] - column_[column];
      if (cost < least[column]) {
        least[column] = cost;
        way_[column] = at;
      }
      if (least[column] < step) {
        step = least[column];
        next = column;
      }
    }
    for (std::size_t column = 0; column <= n_; ++column) {
      if (used[column] != 0) {
        row_[of_column_[column]] += step;
        column_[column] -= step;
      } else {
        least[column] -= step;
      }
    }
    return next;
  }

  std::vector<std::vector<double>> costs_;
  std::size_t n_;
  std::vector<double> row_, column_;  // potentials
  std::vector<std::size_t> of_column_, way_;
};

}  // namespace

std::vector<int> full_assignment(const std::vector<std::vector<double>>& gains) {
  std::size_t size = gains.size();
  for (const auto& row : gains) size = std::max(size, row.size());
  std::vector<std::vector<double>> costs(size, std::vector<double>(size, 0));
  for (std::size_t row = 0; row < gains.size(); ++row)
    for (std::size_t column = 0; column < gains[row].size(); ++column) costs[row][column] = -gains[row][column];
  const Matching matching(std::move(costs));
  std::vector<int> found(gains.size(), -1);
  for (std::size_t column = 0; column < size; ++column) {
    const std::size_t row = matching.row_of(column);
    if (row < gains.size() && column < gains[row].size()) found[row] = static_cast<int>(column);
  }
  return found;
}

std::vector<int> best_assignment(const std::vector<std::vector<double>>& gains) {
  std::vector<std::vector<double>> wanted = gains;
  for (auto& row : wanted)
    for (double& gain : row) gain = std::max(0.0, gain);
  std::vector<int> found = full_assignment(wanted);
  for (std::size_t row = 0; row < gains.size(); ++row)
    if (found[row] >= 0 && gains[row][static_cast<std::size_t>(found[row])] <= 0) found[row] = -1;
  return found;
}

}  // namespace stampede::learning
