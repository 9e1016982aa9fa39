#include "engine/base/nearest.h"

#include <algorithm>

namespace stampede {

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> before(b.size() + 1), last(b.size() + 1), now(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) last[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    now[0] = static_cast<int>(i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      now[j] = std::min({last[j] + 1, now[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) now[j] = std::min(now[j], before[j - 2] + 1);
    }
    std::swap(before, last);
    std::swap(last, now);
  }
  return last[b.size()];
}

std::optional<std::string> nearest(std::string_view word, const std::vector<std::string>& known) {
  std::optional<std::string> best;
  const int limit = std::max(1, static_cast<int>(std::min<std::size_t>(word.size(), 64) + 2) / 3);
  int best_distance = limit + 1;
  for (const std::string& candidate : known) {
    const int distance = edit_distance(word.substr(0, 64), candidate);
    if (distance < best_distance || (distance == best_distance && best && candidate < *best)) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& known) {
  if (const auto best = nearest(word, known)) return "did you mean '" + *best + "'?";
  if (known.empty() || known.size() > 24) return {};
  std::vector<std::string> sorted = known;
  std::sort(sorted.begin(), sorted.end());
  std::string text = "known: ";
  for (std::size_t i = 0; i < sorted.size(); ++i) text += (i > 0 ? ", " : "") + sorted[i];
  return text;
}

}  // namespace stampede
