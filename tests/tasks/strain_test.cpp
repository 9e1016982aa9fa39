// Every task that ships, one seed each: no joint, contact or motion goes beyond what a real arm and its surroundings
// bear. With STAMPEDE_STRAIN set, the figures are printed.
#include "tests/tasks/strain.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <iostream>

#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

std::vector<std::string> shipped_tasks() {
  static const auto library = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  std::vector<std::string> names;
  const char* only = std::getenv("STAMPEDE_STRAIN");
  for (const ScriptFile* file : library->files(DefinitionKind::task))
    if (only == nullptr || *only == 0 || std::string(only) == "all" ||
        (" " + std::string(only) + " ").find(" " + file->name + " ") != std::string::npos)
      names.push_back(file->name);
  return names;
}

}  // namespace

TEST_CASE("joints keep their stops, contacts stay gentle and free motions free, in every task that ships") {
  const std::string task = GENERATE(from_range(shipped_tasks()));
  RunOptions options;
  options.seed = 11;
  if (const char* seed = std::getenv("STAMPEDE_SEED")) options.seed = std::atoi(seed);
  const EpisodeRecord episode = run_task(task, first_variation(task), options);
  const Strain strain = strain_of(episode);
  INFO(task << ": " << verdict(episode) << "\n" << to_text(strain));
  if (std::getenv("STAMPEDE_STRAIN") != nullptr)
    std::cout << "== " << task << ": " << verdict(episode) << ", " << episode.attempts.size() << " undone\n"
              << to_text(strain) << std::flush;
  CHECK(episode.outcome == Outcome::success);
  CHECK(strain.beyond_m.value < 0.0005);
  CHECK(strain.beyond_rad.value < 0.5 * 3.14159265358979 / 180);
  CHECK(strain.force.value < 100);
  CHECK(strain.free_force.value < 1);
  CHECK(strain.depth.value < 0.002);
  CHECK(strain.tool_speed.value < 1.7);
  CHECK(strain.end_speed.value < 0.02);
  CHECK(strain.slip.value < 0.003);
}
