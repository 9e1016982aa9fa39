// Which changes belong to one event.
#include <algorithm>

#include "engine/learning/experience.h"

namespace stampede::learning {

std::int64_t natural_gap(const std::vector<History>& histories) {
  std::vector<std::int64_t> gaps;
  for (const History& history : histories) {
    const std::vector<std::int64_t> changes = change_frames(history);
    for (std::size_t i = 1; i < changes.size(); ++i) gaps.push_back(changes[i] - changes[i - 1]);
  }
  std::sort(gaps.begin(), gaps.end());
  double sum = 0;
  for (const std::int64_t one : gaps) sum += static_cast<double>(one);
  std::int64_t best = 1;
  double widest = -1, left = 0;
  for (std::size_t i = 0; i + 1 < gaps.size(); ++i) {
    left += static_cast<double>(gaps[i]);
    if (gaps[i] == gaps[i + 1]) continue;
    const auto count = static_cast<double>(i + 1), rest = static_cast<double>(gaps.size() - i - 1);
    const double apart = left / count - (sum - left) / rest;
    const double between = count * rest * apart * apart;  // the most between is the least within
    if (between <= widest) continue;
    widest = between;
    best = gaps[i];
  }
  return best;
}

}  // namespace stampede::learning
