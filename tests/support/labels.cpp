#include "tests/support/labels.h"

#include <algorithm>
#include <catch2/catch.hpp>

#include "engine/symbolic/pddl.h"

namespace stampede::test {

void check_tiling(const EpisodeRecord& episode) {
  auto verdict = static_cast<std::ptrdiff_t>(episode.frames.size());
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::motion && segment.skill == "hold") verdict = segment.span.first_frame;
  for (const SegmentKind kind : {SegmentKind::subgoal, SegmentKind::skill, SegmentKind::motion}) {
    std::vector<int> covered(episode.frames.size(), 0);
    for (const SegmentRecord& segment : episode.labels.segments)
      if (segment.kind == kind)
        for (std::int64_t frame = segment.span.first_frame; frame < segment.span.end_frame; ++frame)
          ++covered[static_cast<std::size_t>(frame)];
    INFO(to_string(kind));
    std::vector<int> expected(episode.frames.size(), 1);
    if (kind == SegmentKind::skill) std::fill(expected.begin() + verdict, expected.end(), 0);
    CHECK(covered == expected);
  }
}

void check_plan(const EpisodeRecord& episode) {
  const Domain domain = domain_from_pddl(*document_of(episode, DocumentKind::pddl_domain), "domain");
  const Problem problem = problem_from_pddl(*document_of(episode, DocumentKind::pddl_problem), "problem", domain);
  const Validation verdict =
      validate(domain, problem, plan_from_text(*document_of(episode, DocumentKind::plan), "plan"));
  INFO(verdict.explanation);
  CHECK(verdict.valid);
}

}  // namespace stampede::test
