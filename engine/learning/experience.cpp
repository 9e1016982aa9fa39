#include "engine/learning/experience.h"

#include <algorithm>
#include <set>

namespace stampede::learning {

std::vector<std::int64_t> change_frames(const History& history) {
  std::set<std::int64_t> frames;
  for (const Span& span : history.spans) {
    if (span.first > 0) frames.insert(span.first);
    if (span.end < history.frames) frames.insert(span.end);
  }
  return {frames.begin(), frames.end()};
}

Facts facts_at(const History& history, std::int64_t frame) {
  Facts facts;
  for (const Span& span : history.spans)
    if (span.first <= frame && frame < span.end) facts.insert(span.fact);
  return facts;
}

std::vector<Transition> events(const History& history, std::int64_t gap) {
  std::vector<Transition> found;
  for (TimedEvent& one : timed_events(history, gap)) found.push_back(std::move(one.transition));
  return found;
}

std::vector<TimedEvent> timed_events(const History& history, std::int64_t gap) {
  const std::vector<std::int64_t> changes = change_frames(history);
  std::vector<TimedEvent> found;
  for (std::size_t from = 0; from < changes.size();) {
    std::size_t last = from;
    while (last + 1 < changes.size() && changes[last + 1] - changes[last] <= gap) ++last;
    Transition one;
    one.before = facts_at(history, changes[from] - 1);
    one.after = facts_at(history, changes[last]);
    one.objects = history.objects;
    if (one.before != one.after) found.push_back({changes[from], changes[last], std::move(one)});
    from = last + 1;
  }
  return found;
}

}  // namespace stampede::learning
