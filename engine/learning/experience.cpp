#include "engine/learning/experience.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace stampede::learning {
namespace {

// Frames at which some fact begins or ends to hold, ascending.
std::vector<std::int64_t> change_frames(const History& history) {
  std::set<std::int64_t> frames;
  for (const Span& span : history.spans) {
    if (span.first > 0) frames.insert(span.first);
    if (span.end < history.frames) frames.insert(span.end);
  }
  return {frames.begin(), frames.end()};
}

}  // namespace

Facts facts_at(const History& history, std::int64_t frame) {
  Facts facts;
  for (const Span& span : history.spans)
    if (span.first <= frame && frame < span.end) facts.insert(span.fact);
  return facts;
}

std::vector<Transition> events(const History& history, std::int64_t gap) {
  const std::vector<std::int64_t> changes = change_frames(history);
  std::vector<Transition> found;
  for (std::size_t from = 0; from < changes.size();) {
    std::size_t last = from;
    while (last + 1 < changes.size() && changes[last + 1] - changes[last] <= gap) ++last;
    Transition one;
    one.before = facts_at(history, changes[from] - 1);
    one.after = facts_at(history, changes[last]);
    one.objects = history.objects;
    if (one.before != one.after) found.push_back(std::move(one));
    from = last + 1;
  }
  return found;
}

std::int64_t natural_gap(const std::vector<History>& histories) {
  std::vector<std::int64_t> gaps;
  for (const History& history : histories) {
    const std::vector<std::int64_t> changes = change_frames(history);
    for (std::size_t i = 1; i < changes.size(); ++i) gaps.push_back(changes[i] - changes[i - 1]);
  }
  std::sort(gaps.begin(), gaps.end());
  if (gaps.size() < 2 || gaps.front() == gaps.back()) return 1;
  double sum = 0;
  for (const std::int64_t one : gaps) sum += std::log(static_cast<double>(one));
  std::int64_t best = 1;
  double widest = -1, left = 0;
  for (std::size_t i = 0; i + 1 < gaps.size(); ++i) {
    left += std::log(static_cast<double>(gaps[i]));
    if (gaps[i] == gaps[i + 1]) continue;
    const auto n = static_cast<double>(i + 1), rest = static_cast<double>(gaps.size() - i - 1);
    const double apart = left / n - (sum - left) / rest;
    const double between = n * rest * apart * apart;  // the most between is the least within
    if (between > widest) {
      widest = between;
      best = gaps[i];
    }
  }
  return best;
}

}  // namespace stampede::learning
