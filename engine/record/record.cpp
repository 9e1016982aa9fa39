#include "engine/record/record.h"

namespace stampede {
namespace {

constexpr std::array<std::string_view, 6> kChosenBy{"default", "stream", "planner", "agent", "task", "caller"};
constexpr std::array<std::string_view, 3> kSegmentKinds{"subgoal", "skill", "motion"};
constexpr std::array<std::string_view, 3> kLabellers{"simulator", "person", "model"};
constexpr std::array<std::string_view, 5> kLanguageLevels{"task", "world", "subgoal", "skill", "motion"};
constexpr std::array<std::string_view, 3> kLanguageSources{"template", "model", "person"};
constexpr std::array<std::string_view, 3> kLanguageGrains{"goal", "steps", "motions"};
constexpr std::array<std::string_view, 8> kDocumentKinds{"pddl_domain", "pddl_problem",   "plan",
                                                         "failed_plan", "ordered_domain", "ordered_problem",
                                                         "bddl_libero", "bddl_behavior"};
constexpr std::array<std::string_view, 2> kSplits{"train", "test"};

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

std::string_view to_string(Labeller value) { return kLabellers.at(static_cast<std::size_t>(value)); }
std::optional<Labeller> labeller_from(std::string_view name) { return value_of<Labeller>(kLabellers, name); }

std::string_view to_string(LanguageSource source) { return kLanguageSources.at(static_cast<std::size_t>(source)); }
std::optional<LanguageSource> language_source_from(std::string_view name) {
  return value_of<LanguageSource>(kLanguageSources, name);
}

std::string_view to_string(LanguageGrain grain) { return kLanguageGrains.at(static_cast<std::size_t>(grain)); }
std::optional<LanguageGrain> language_grain_from(std::string_view name) {
  return value_of<LanguageGrain>(kLanguageGrains, name);
}

std::string_view to_string(LanguageLevel level) { return kLanguageLevels.at(static_cast<std::size_t>(level)); }
std::optional<LanguageLevel> language_level_from(std::string_view name) {
  return value_of<LanguageLevel>(kLanguageLevels, name);
}

std::string_view to_string(DocumentKind kind) { return kDocumentKinds.at(static_cast<std::size_t>(kind)); }
std::optional<DocumentKind> document_kind_from(std::string_view name) {
  return value_of<DocumentKind>(kDocumentKinds, name);
}

std::string_view to_string(Split split) { return kSplits.at(static_cast<std::size_t>(split)); }
std::optional<Split> split_from(std::string_view name) { return value_of<Split>(kSplits, name); }

const std::string* document_of(const EpisodeRecord& episode, DocumentKind kind) {
  for (const DocumentRecord& one : episode.documents)
    if (one.kind == kind) return &one.text;
  return nullptr;
}

}  // namespace stampede
