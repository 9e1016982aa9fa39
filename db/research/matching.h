// One-to-one matching of greatest weight: how names of a learner are compared with ours.
#pragma once

#include <Eigen/Dense>
#include <vector>

namespace stampede::research {

// Of each row the column matched with it, or -1: where there are more rows than columns some stay alone. The sum of
// weights is the greatest there is (Kuhn 1955, doi:10.1002/nav.3800020109, by shortest augmenting paths, O(n^3)).
std::vector<int> best_matching(const Eigen::MatrixXd& weights);

// Normalised mutual information of two labellings, 0 to 1, and the adjusted Rand index, from counts of pairs: row the
// learner's label, column the true one. NMI divides by the mean of both entropies; of one class each it is 1.
double normalised_mutual_information(const Eigen::MatrixXd& counts);
double adjusted_rand_index(const Eigen::MatrixXd& counts);

}  // namespace stampede::research
