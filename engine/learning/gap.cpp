// Which changes belong to one event.
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "engine/learning/experience.h"
#include "engine/learning/lifting.h"

namespace stampede::learning {
namespace {

// Bits of a literal of a kind, of a moment, and of an object of an event: about what some dozens of predicates, some
// hundred frames and some ten objects take.
constexpr double kLiteral = 6, kMoment = 8, kObject = 3;
constexpr std::size_t kMostObjects = 6;  // beyond that a change is no kind, and told fact by fact
constexpr std::size_t kMostGaps = 24;    // that are tried

double bits(const std::vector<History>& histories, std::int64_t gap) {
  std::map<std::pair<LiftedAtoms, LiftedAtoms>, double> kinds;
  double sum = 0, all = 0;
  for (const History& history : histories)
    for (const Transition& one : events(history, gap)) {
      const LiftedChange change = lifted_change(one.before, one.after, {}, kMostObjects);
      if (change.orders.empty()) {
        Facts changed;
        std::set_symmetric_difference(one.before.begin(), one.before.end(), one.after.begin(), one.after.end(),
                                      std::inserter(changed, changed.end()));
        sum += kMoment + static_cast<double>(changed.size()) * (kLiteral + 2 * kObject);
        continue;
      }
      ++kinds[{change.added, change.removed}];
      ++all;
      sum += kMoment + kObject * static_cast<double>(change.orders.front().size());
    }
  for (const auto& [kind, count] : kinds)
    sum += kLiteral * static_cast<double>(kind.first.size() + kind.second.size()) + count * std::log2(all / count);
  return sum;
}

// Of all gaps that there are, evenly chosen.
std::vector<std::int64_t> gaps_to_try(const std::vector<History>& histories) {
  std::set<std::int64_t> gaps = {1};
  for (const History& history : histories) {
    const std::vector<std::int64_t> changes = change_frames(history);
    for (std::size_t i = 1; i < changes.size(); ++i) gaps.insert(changes[i] - changes[i - 1]);
  }
  const std::vector<std::int64_t> all(gaps.begin(), gaps.end());
  std::vector<std::int64_t> some;
  const std::size_t count = std::min(kMostGaps, all.size());
  for (std::size_t i = 0; i < count; ++i) some.push_back(all[i * all.size() / count]);
  return some;
}

}  // namespace

std::int64_t natural_gap(const std::vector<History>& histories) {
  std::int64_t best = 1;
  double least = -1;
  for (const std::int64_t gap : gaps_to_try(histories)) {
    const double now = bits(histories, gap);
    if (least >= 0 && now >= least) continue;
    least = now;
    best = gap;
  }
  return best;
}

}  // namespace stampede::learning
