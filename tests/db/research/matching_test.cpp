// Matching, agreement of labels and ranks against values worked out by hand or by trying all.
#include "db/research/matching.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>

#include "db/research/ranks.h"
#include "db/research/signals.h"
#include "engine/base/random.h"

namespace stampede::research {
namespace {

double best_of_all(const Eigen::MatrixXd& weights) {  // a square one
  std::vector<int> order(static_cast<std::size_t>(weights.rows()));
  std::iota(order.begin(), order.end(), 0);
  double best = -1e9;
  do {
    double sum = 0;
    for (std::size_t i = 0; i < order.size(); ++i) sum += weights(static_cast<Eigen::Index>(i), order[i]);
    best = std::max(best, sum);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

}  // namespace

TEST_CASE("the matching is the best of all") {
  Random random(RandomKey("matching_test"));
  for (int round = 0; round < 200; ++round) {
    const int rows = static_cast<int>(1 + random.below(5)), columns = static_cast<int>(1 + random.below(5));
    const int n = std::max(rows, columns);
    Eigen::MatrixXd weights(rows, columns), square = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < weights.size(); ++i) weights.data()[i] = random.uniform();
    square.topLeftCorner(rows, columns) = weights;
    const std::vector<int> match = best_matching(weights);
    double sum = 0;
    std::vector<int> taken;
    for (int row = 0; row < rows; ++row) {
      const int column = match[static_cast<std::size_t>(row)];
      if (column < 0) continue;
      sum += weights(row, column);
      taken.push_back(column);
    }
    std::sort(taken.begin(), taken.end());
    CHECK(std::adjacent_find(taken.begin(), taken.end()) == taken.end());
    CHECK(static_cast<int>(taken.size()) == std::min(rows, columns));
    CHECK(sum == Approx(best_of_all(square)));
  }
}

TEST_CASE("agreement of labels: equal up to names is 1, one name for all is 0") {
  Eigen::MatrixXd same(3, 3), all(1, 3), half(2, 2);
  same << 0, 5, 0, 7, 0, 0, 0, 0, 2;
  all << 5, 7, 2;
  half << 2, 1, 1, 2;
  CHECK(normalised_mutual_information(same) == Approx(1));
  CHECK(adjusted_rand_index(same) == Approx(1));
  CHECK(normalised_mutual_information(all) == Approx(0).margin(1e-12));
  CHECK(adjusted_rand_index(all) == Approx(0).margin(1e-12));
  // 1 - H(1/3) / ln 2, by hand; Rand: (2 - 36 / 15) / (6 - 36 / 15)
  CHECK(normalised_mutual_information(half) == Approx(0.0817042));
  CHECK(adjusted_rand_index(half) == Approx(-1.0 / 9));
}

TEST_CASE("rank correlations share ties") {
  CHECK(*spearman({1, 2, 3, 4}, {10, 20, 30, 1000}) == Approx(1));
  CHECK(*kendall({1, 2, 3, 4}, {4, 3, 2, 1}) == Approx(-1));
  CHECK(*spearman({1, 2, 2, 3}, {1, 2, 3, 4}) == Approx(0.9486833));
  CHECK(*kendall({1, 2, 2, 3}, {1, 2, 3, 4}) == Approx(0.9128709));
  CHECK_FALSE(spearman({1, 1, 1}, {1, 2, 3}).has_value());
  CHECK(area_under_curve({2, 3}, {1, 2}) == Approx(0.875));
}

TEST_CASE("k-means finds groups that lie apart, the same ones every time") {
  Eigen::MatrixXd rows(60, 2);
  Random random(RandomKey("k_means_test"));
  for (Eigen::Index i = 0; i < 60; ++i)
    rows.row(i) << 10.0 * static_cast<double>(i % 3) + random.normal(), random.normal();
  const std::vector<int> groups = k_means(rows, 3);
  for (std::size_t i = 3; i < 60; ++i) CHECK(groups[i] == groups[i % 3]);
  CHECK(groups[0] != groups[1]);
  CHECK(groups == k_means(rows, 3));
  CHECK(k_means(rows.topRows(2), 5).size() == 2);
}

}  // namespace stampede::research
