// The Lua side of one episode: draws its task, and implements Symbols and SkillLibrary over one fresh state.
#pragma once

#include <memory>
#include <string>

#include "engine/start/predicates.h"
#include "engine/start/skills.h"
#include "engine/start/task.h"
#include "scripting/library/library.h"
#include "scripting/runtime/job.h"

namespace stampede {

class Assets;

// One episode's scripts. Lifetime: outlives the episode's runner; used by one thread. Throws Error for bad scripts.
class EpisodeScripts {
 public:
  // `further_things`: how many stand about that have no part in it. `assets`: of the same library, where one thread
  // makes many episodes; null: read anew.
  EpisodeScripts(std::shared_ptr<const Library> library, const EpisodeJob& job, int further_things = 0,
                 std::shared_ptr<Assets> assets = nullptr);
  EpisodeScripts(std::shared_ptr<const Library> library, std::string_view task, std::string_view variation,
                 std::int64_t seed);
  ~EpisodeScripts();
  TaskDraw task();  // lifetime: until these scripts end
  Symbols& symbols();
  SkillLibrary& skills();
  // Files that took part: the task, its world, robot, objects, all predicates and skills of the domain, modules.
  std::vector<DefinitionRecord> definitions() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace stampede
