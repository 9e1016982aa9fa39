#include "engine/learning/assignment.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "engine/base/random.h"

using namespace stampede;
using namespace stampede::learning;

namespace {

double gain(const std::vector<std::vector<double>>& gains, const std::vector<int>& of_row) {
  double sum = 0;
  for (std::size_t row = 0; row < gains.size(); ++row)
    if (of_row[row] >= 0) sum += gains[row][static_cast<std::size_t>(of_row[row])];
  return sum;
}

// Of all orders of the columns (and of nobody, where there are fewer columns than rows).
double best_of_all(const std::vector<std::vector<double>>& gains) {
  const std::size_t rows = gains.size(), columns = gains[0].size(), size = std::max(rows, columns);
  std::vector<std::size_t> order(size);
  std::iota(order.begin(), order.end(), std::size_t{0});
  double best = 0;
  do {
    double sum = 0;
    for (std::size_t row = 0; row < rows; ++row)
      if (order[row] < columns) sum += std::max(0.0, gains[row][order[row]]);
    best = std::max(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace

TEST_CASE("the best assignment is as good as the best of all, for tables of any shape") {
  Random random(RandomKey("assignment"));
  for (int i = 0; i < 300; ++i) {
    const auto rows = static_cast<std::size_t>(1 + random.below(6)),
               columns = static_cast<std::size_t>(1 + random.below(6));
    std::vector<std::vector<double>> gains(rows, std::vector<double>(columns));
    for (auto& row : gains)
      for (double& one : row) one = static_cast<double>(random.below(21)) - 5;
    const std::vector<int> found = best_assignment(gains);
    CHECK(gain(gains, found) == Approx(best_of_all(gains)));
    std::vector<int> used;
    for (std::size_t row = 0; row < rows; ++row) {
      if (found[row] < 0) continue;
      CHECK(gains[row][static_cast<std::size_t>(found[row])] > 0);
      used.push_back(found[row]);
    }
    std::sort(used.begin(), used.end());
    CHECK(std::adjacent_find(used.begin(), used.end()) == used.end());
  }
}

TEST_CASE("nobody is assigned where there is nobody") {
  CHECK(best_assignment({}).empty());
  CHECK(best_assignment({{}, {}}) == std::vector<int>{-1, -1});
}
