// What an environment needs from outside: the scripts of its task, and a place for episodes that have ended.
#pragma once

#include <memory>

#include "engine/base/error.h"
#include "engine/base/reason.h"
#include "engine/start/options.h"
#include "engine/start/task.h"
#include "stampede/environment.h"

namespace stampede {

class SkillLibrary;
class Symbols;

// What reset throws where no start was found.
class NoStart : public Error {
 public:
  NoStart(const std::string& task, Reason reason, const std::string& detail)
      : Error(task, std::string(describe(reason)) + ": " + detail,
              "another seed or variation, or a `where` that can be met"),
        reason_(reason),
        detail_(detail) {}
  Reason reason() const { return reason_; }
  const std::string& detail() const { return detail_; }

 private:
  Reason reason_;
  std::string detail_;
};

class EpisodeSource {
 public:
  virtual ~EpisodeSource() = default;

  // One task at a variation and seed. Lifetime: `owner` keeps all of it.
  struct Opened {
    TaskDraw draw;
    Symbols* symbols = nullptr;
    SkillLibrary* skills = nullptr;
    RunOptions options;
    std::shared_ptr<void> owner;
  };
  // Of the request, everything but its frame and channels. Throws Error.
  virtual Opened open(const ResetRequest& request) = 0;

  // One that has ended: gets its key and definitions, and is stored where there is a catalogue.
  virtual Episode close(EpisodeRecord record, const std::shared_ptr<void>& owner) = 0;

  // What one was recorded as, from memory or the catalogue. Throws Error.
  virtual std::shared_ptr<const EpisodeRecord> record_of(const Episode& episode) = 0;
};

Environment make_environment(std::shared_ptr<EpisodeSource> source, EnvironmentSettings settings);

}  // namespace stampede
