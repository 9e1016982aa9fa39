// Runs tasks of this repository, and those of this folder's `data`, from a test.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "engine/episode/runner.h"
#include "scripting/library/library.h"
#include "scripting/runtime/episode_scripts.h"

namespace stampede::test {

inline std::shared_ptr<const Library> all_tasks() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/data"}});
  return shared;
}

// What ships, without this folder's own.
inline std::shared_ptr<const Library> shipped() {
  static const std::shared_ptr<const Library> shared = Library::load(Roots{{STAMPEDE_SOURCE_DIR}});
  return shared;
}

// What ships, with skills, things and tasks that authors asked for.
inline std::shared_ptr<const Library> authors() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/authors"}});
  return shared;
}

// What ships, but for the knowledge that an open drawer covers those below it.
inline std::shared_ptr<const Library> unaware() {
  static const std::shared_ptr<const Library> shared =
      Library::load(Roots{{STAMPEDE_SOURCE_DIR, STAMPEDE_SOURCE_DIR "/tests/tasks/unaware"}});
  return shared;
}

// Every `parts`-th of what ships, from number `part` on.
inline std::vector<std::string> shipped_tasks(int part = 0, int parts = 1) {
  std::vector<std::string> names;
  int index = 0;
  for (const ScriptFile* file : shipped()->files(DefinitionKind::task))
    if (index++ % parts == part) names.push_back(file->name);
  return names;
}

inline EpisodeRecord run_task(const std::string& task, const std::string& variation, RunOptions options,
                              const std::shared_ptr<const Library>& library = all_tasks()) {
  EpisodeScripts scripts(library, task, variation, options.seed);
  return run_episode(scripts.task(), scripts.symbols(), scripts.skills(), options);
}

inline std::string first_variation(const std::string& task) {
  const auto& texts = all_tasks()->task(task)->variation_texts;
  return texts.empty() ? "" : texts.front();
}

// `pick item`: skills that the episode kept, in order.
inline std::vector<std::string> skills_of(const EpisodeRecord& episode) {
  std::vector<std::string> skills;
  for (const SegmentRecord& segment : episode.labels.segments)
    if (segment.kind == SegmentKind::skill)
      skills.push_back(segment.skill + (segment.arguments.empty() ? "" : " " + segment.arguments[0]));
  return skills;
}

inline std::string verdict(const EpisodeRecord& episode) {
  return std::string(to_string(episode.outcome)) + ", " + std::string(to_string(episode.reason)) + " " + episode.detail;
}

}  // namespace stampede::test
