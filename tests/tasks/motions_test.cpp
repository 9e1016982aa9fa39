// Motions that authors asked for: several grips, a search with a peg, pieces in a skill of their own.
#include <catch2/catch.hpp>

#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::shared_ptr<const Library> authored() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/authors"}});
  return shared;
}

EpisodeRecord run_authored(const std::string& task, const std::string& variation, std::uint64_t seed) {
  RunOptions options;
  options.seed = seed;
  options.on_failure = OnFailure::stop;
  EpisodeScripts scripts(authored(), task, variation, options.seed);
  return run_episode(scripts.task(), scripts.symbols(), scripts.skills(), options);
}

int motions_of(const EpisodeRecord& episode, const std::string& kind) {
  return static_cast<int>(std::count_if(episode.segments.begin(), episode.segments.end(), [&](const auto& segment) {
    return segment.kind == SegmentKind::motion && segment.skill == kind;
  }));
}

}  // namespace
