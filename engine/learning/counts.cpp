#include "engine/learning/counts.h"

#include <cmath>

namespace stampede::learning {

double Counts::precision() const {
  const std::int64_t said = right + wrong;
  if (said == 0) return missed == 0 ? 1 : 0;
  return static_cast<double>(right) / static_cast<double>(said);
}

double Counts::recall() const {
  const std::int64_t asked = right + missed;
  if (asked == 0) return wrong == 0 ? 1 : 0;
  return static_cast<double>(right) / static_cast<double>(asked);
}

double Counts::f1() const {
  const std::int64_t all = 2 * right + wrong + missed;
  return all == 0 ? 1 : 2 * static_cast<double>(right) / static_cast<double>(all);
}

Counts& Counts::operator+=(const Counts& other) {
  right += other.right;
  wrong += other.wrong;
  missed += other.missed;
  return *this;
}

double Confusion::mcc() const {
  const auto tp = static_cast<double>(both), fp = static_cast<double>(only_said), fn = static_cast<double>(only_true),
             tn = static_cast<double>(neither);
  const double scale = std::sqrt((tp + fp) * (tp + fn)) * std::sqrt((tn + fp) * (tn + fn));
  return scale == 0 ? 0 : (tp * tn - fp * fn) / scale;
}

}  // namespace stampede::learning
