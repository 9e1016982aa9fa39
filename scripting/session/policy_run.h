// Episodes in which a program acts instead of the planner: see POLICIES.md.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "engine/base/temporary_folder.h"
#include "engine/record/record.h"
#include "scripting/session/episode_job.h"
#include "scripting/session/policy_program.h"
#include "stampede/environment.h"

namespace stampede {

struct PolicySettings {
  std::string command;                   // for /bin/sh -c
  std::chrono::seconds patience{60};     // for each answer
  EnvironmentSettings environment = {};  // `record` is set in any case
};

// Lifetime: one program for all episodes, started with the first; used by one thread.
class PolicyRun {
 public:
  // `stop`: looked at between steps and while an answer is awaited; may be null.
  PolicyRun(PolicySettings settings, const std::atomic<bool>* stop);
  ~PolicyRun();

  // One episode from reset to verdict, with a key of what was done. A start that cannot be made and a script that
  // fails are episodes with that reason; interrupted, it has that reason and nothing else. Its options name the
  // renderer, where pictures are to be stored.
  // Throws Error for a program that does not keep to the protocol, and for channels that there are not.
  EpisodeRecord act(PreparedEpisode& prepared);

 private:
  bool converse(PreparedEpisode& prepared, Environment& world);
  std::optional<AgentAction> understood(const std::string& line, const std::string& awaited) const;
  void look_at_patience(const StepResult& result);
  std::string put_picture(const ChannelValue& picture);
  bool stopped() const { return stop_ != nullptr && stop_->load(); }

  PolicySettings settings_;
  const std::atomic<bool>* stop_;
  std::optional<TemporaryFolder> pictures_;  // from the first picture on
  std::unique_ptr<PolicyProgram> program_;   // ends before its pictures go
  bool told_start_ = false;                  // of this episode
  int refusals_ = 0, idle_ = 0;              // in a row, without a frame going by
};

}  // namespace stampede
