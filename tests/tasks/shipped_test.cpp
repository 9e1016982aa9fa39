// Whatever lies in tasks/ and skills/ is run: a file that is added is tested without a word here. The tasks are dealt
// out to several test cases, so that they run beside each other.
#include <catch2/catch.hpp>

#include "tests/support/labels.h"
#include "tests/tasks/run_task.h"
#include "tests/tasks/strain.h"

using namespace stampede;
using namespace stampede::test;

namespace {

constexpr std::int64_t kSeed = 11;

EpisodeRecord run_shipped(const std::string& task) {
  RunOptions options;
  options.seed = kSeed;
  return run_task(task, first_variation(task), options);
}

// No joint, contact or motion goes beyond what a real arm and its surroundings bear. `-s` prints the figures.
void check_strain(const EpisodeRecord& episode) {
  const Strain strain = strain_of(episode);
  INFO(to_text(strain));
  CHECK(strain.beyond_m.value < 0.0005);
  CHECK(strain.beyond_rad.value < 0.0087);  // half a degree
  CHECK(strain.force.value < 100);
  CHECK(strain.free_force.value < 1);
  CHECK(strain.depth.value < 0.002);
  CHECK(strain.tool_speed.value < 1.7);
  CHECK(strain.end_speed.value < 0.03);
  CHECK(strain.slip.value < 0.003);
}

// Every `of`-th task, from `first` on; each in a section of its name (`-c push_buttons` runs that alone).
void check_share(std::size_t first, std::size_t of) {
  const std::vector<const ScriptFile*> files = shipped()->files(DefinitionKind::task);
  for (std::size_t i = first; i < files.size(); i += of) DYNAMIC_SECTION(files[i]->name) {
      const EpisodeRecord episode = run_shipped(files[i]->name);
      INFO(files[i]->name << " " << episode.variation << " seed " << kSeed << ": " << verdict(episode));
      CHECK(episode.outcome == Outcome::success);
      REQUIRE_FALSE(skills_of(episode).empty());
      check_tiling(episode);
      check_plan(episode);
      CHECK(replay_episode(episode) == "");
      check_strain(episode);
    }
}

}  // namespace

TEST_CASE("each task that ships succeeds, and its labels, plan and replay are sound (1 of 4)") { check_share(0, 4); }
TEST_CASE("each task that ships succeeds, and its labels, plan and replay are sound (2 of 4)") { check_share(1, 4); }
TEST_CASE("each task that ships succeeds, and its labels, plan and replay are sound (3 of 4)") { check_share(2, 4); }
TEST_CASE("each task that ships succeeds, and its labels, plan and replay are sound (4 of 4)") { check_share(3, 4); }

TEST_CASE("each skill that ships is run by a task that ships") {
  std::set<std::string> unused;
  for (const ScriptFile* file : shipped()->files(DefinitionKind::skill)) unused.insert(file->name);
  CHECK_FALSE(unused.empty());
  for (const ScriptFile* file : shipped()->files(DefinitionKind::task)) {
    if (unused.empty()) break;
    for (const SegmentRecord& segment : run_shipped(file->name).labels.segments)
      if (segment.kind == SegmentKind::skill && segment.outcome == Outcome::success) unused.erase(segment.skill);
  }
  std::string names;
  for (const std::string& name : unused) names += name + " ";
  INFO("no task runs " << names << "to its end: add a task that needs it, or to tests/tasks/data");
  CHECK(unused.empty());
}
