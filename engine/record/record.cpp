#include "engine/record/record.h"

#include "engine/base/enum_names.h"

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

}  // namespace

std::string_view to_string(Outcome outcome) { return outcome == Outcome::success ? "success" : "failure"; }

std::string_view to_string(ChosenBy value) { return enum_name(kChosenBy, value); }
std::optional<ChosenBy> chosen_by_from(std::string_view name) { return enum_from<ChosenBy>(kChosenBy, name); }

std::string_view to_string(SegmentKind kind) { return enum_name(kSegmentKinds, kind); }
std::optional<SegmentKind> segment_kind_from(std::string_view name) {
  return enum_from<SegmentKind>(kSegmentKinds, name);
}

std::string_view to_string(Labeller value) { return enum_name(kLabellers, value); }
std::optional<Labeller> labeller_from(std::string_view name) { return enum_from<Labeller>(kLabellers, name); }

std::string_view to_string(LanguageSource source) { return enum_name(kLanguageSources, source); }
std::optional<LanguageSource> language_source_from(std::string_view name) {
  return enum_from<LanguageSource>(kLanguageSources, name);
}

std::string_view to_string(LanguageGrain grain) { return enum_name(kLanguageGrains, grain); }
std::optional<LanguageGrain> language_grain_from(std::string_view name) {
  return enum_from<LanguageGrain>(kLanguageGrains, name);
}

std::string_view to_string(LanguageLevel level) { return enum_name(kLanguageLevels, level); }
std::optional<LanguageLevel> language_level_from(std::string_view name) {
  return enum_from<LanguageLevel>(kLanguageLevels, name);
}

std::string_view to_string(DocumentKind kind) { return enum_name(kDocumentKinds, kind); }
std::optional<DocumentKind> document_kind_from(std::string_view name) {
  return enum_from<DocumentKind>(kDocumentKinds, name);
}

std::string_view to_string(Split split) { return enum_name(kSplits, split); }
std::optional<Split> split_from(std::string_view name) { return enum_from<Split>(kSplits, name); }

const std::string* document_of(const EpisodeRecord& episode, DocumentKind kind) {
  for (const DocumentRecord& one : episode.labels.documents)
    if (one.kind == kind) return &one.text;
  return nullptr;
}

}  // namespace stampede
