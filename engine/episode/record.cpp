#include "engine/episode/record.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 6> kChosenBy{"default", "stream", "planner", "agent", "task", "caller"};
constexpr std::array<std::string_view, 3> kSegmentKinds{"subgoal", "skill", "motion"};

template <typename Enumeration, std::size_t N>
std::optional<Enumeration> value_of(const std::array<std::string_view, N>& names, std::string_view name) {
  for (std::size_t i = 0; i < N; ++i)
    if (names[i] == name) return static_cast<Enumeration>(i);
  return std::nullopt;
}

}  // namespace

std::string_view to_string(Outcome outcome) { return outcome == Outcome::success ? "success" : "failure"; }

std::string_view to_string(ChosenBy value) { return kChosenBy.at(static_cast<std::size_t>(value)); }
std::optional<ChosenBy> chosen_by_from(std::string_view name) { return value_of<ChosenBy>(kChosenBy, name); }

std::string_view to_string(SegmentKind kind) { return kSegmentKinds.at(static_cast<std::size_t>(kind)); }
std::optional<SegmentKind> segment_kind_from(std::string_view name) {
  return value_of<SegmentKind>(kSegmentKinds, name);
}

}  // namespace stampede
