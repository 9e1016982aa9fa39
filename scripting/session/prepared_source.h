// One prepared episode, for an environment that takes it once.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/episode/episode_source.h"
#include "engine/start/altered_task.h"
#include "scripting/session/episode_job.h"

namespace stampede {

// What the episode's task says that is to be done, as its agent hears it.
inline std::vector<std::string> instructions_of(PreparedEpisode& prepared) {
  EpisodeScripts& scripts = prepared.scripts();
  return altered(scripts.task()(0), scripts.symbols(), prepared.options()).instructions;
}

// Lifetime: refers to the prepared episode.
class PreparedSource final : public EpisodeSource {
 public:
  // `policy`: who acts, as the episode's options name it.
  PreparedSource(PreparedEpisode& prepared, std::string policy) : prepared_(prepared), policy_(std::move(policy)) {}

  Opened open(const ResetRequest&) override {
    EpisodeScripts& scripts = prepared_.scripts();
    return {scripts.task(), &scripts.symbols(), &scripts.skills(), prepared_.options(), nullptr};
  }
  Episode close(EpisodeRecord record, const std::shared_ptr<void>&) override {
    record.made.options["policy"] = policy_;
    prepared_.complete(record);
    record.made.key = acted_key(record);
    closed_ = std::move(record);
    return {};
  }
  std::shared_ptr<const EpisodeRecord> record_of(const Episode&) override {
    throw Error("policy", "an episode of it starts at its beginning");
  }

  EpisodeRecord take() { return std::move(closed_); }

  // An episode of which nothing is kept but why it failed.
  EpisodeRecord failed(Reason reason, const std::string& detail) {
    EpisodeRecord record = prepared_.failed(reason, detail);
    record.made.options["behaviour"] = "agent";
    close(std::move(record), nullptr);
    return take();
  }

 private:
  PreparedEpisode& prepared_;
  std::string policy_;
  EpisodeRecord closed_;
};

}  // namespace stampede
