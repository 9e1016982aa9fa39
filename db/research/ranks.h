// Rank correlations, ties shared. Nothing where one side has no two different values.
#pragma once

#include <optional>
#include <vector>

namespace stampede::research {

std::optional<double> spearman(const std::vector<double>& a, const std::vector<double>& b);
std::optional<double> kendall(const std::vector<double>& a, const std::vector<double>& b);  // tau-b; O(n^2)

// How often a value of `high` is above one of `low`, ties half: area under the ROC curve. Neither is empty.
double area_under_curve(const std::vector<double>& high, const std::vector<double>& low);

}  // namespace stampede::research
