// Plans whose later steps are known to the earlier ones: what is filled is shut again, things are taken so that they
// can be put where the plan puts them.
#include <catch2/catch.hpp>

#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::shared_ptr<const Library> later() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/later"}});
  return shared;
}

// The way down of the hand that took the item, which lay flat: -1 from straight above.
double down_at_grasp(const EpisodeRecord& episode) {
  for (const SegmentRecord& segment : episode.labels.segments)
    for (const ParameterRecord& one : segment.parameters)
      if (segment.skill == "pick" && one.name == "grasp")
        return (Quaternion(one.values[6], one.values[3], one.values[4], one.values[5]) * Vector3::UnitZ()).z();
  return 0;
}

}  // namespace

TEST_CASE("drawers, boxes, ovens, fridges, cabinets and microwaves are shut again with what was put in") {
  for (const ScriptFile* file : later()->files(DefinitionKind::task)) {
    if (!file->path.string().starts_with(STAMPEDE_SOURCE_DIR "/tests/tasks/later")) continue;
    std::vector<std::string> variations = later()->task(file->name)->variation_texts;
    if (variations.empty()) variations.emplace_back();
    for (const std::string& variation : variations) {
      const EpisodeRecord episode = run_task(file->name, variation, {}, later());
      INFO(file->name + " " + variation + ": " + verdict(episode));
      CHECK(episode.outcome == Outcome::success);
    }
  }
}

TEST_CASE("what lies flat is taken from above for a drawer, at a slant for a shelf with a roof") {
  const EpisodeRecord drawer = run_task("flat_in_drawer", "level=top,thing=steak", {}, later());
  const EpisodeRecord shelf = run_task("warm_in_microwave", "thing=steak", {}, later());
  INFO(verdict(drawer) + "; " + verdict(shelf));
  REQUIRE((drawer.outcome == Outcome::success && shelf.outcome == Outcome::success));
  CHECK(down_at_grasp(drawer) < -0.95);
  CHECK(down_at_grasp(shelf) > -0.85);
}

TEST_CASE("a door that the arm cannot push shut at one go is touched again, without undoing anything") {
  RunOptions options;
  options.on_failure = OnFailure::stop;
  const EpisodeRecord episode = run_task("again_warm", "where=left", options, later());
  INFO(verdict(episode));
  CHECK(episode.outcome == Outcome::success);
}
