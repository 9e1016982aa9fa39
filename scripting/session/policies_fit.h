// Whether the policies that skills have as their bodies are there, told before anything runs.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "scripting/session/episode_job.h"

namespace stampede {

// Throws Error where the plan for one of these episodes calls a skill that asks for a policy by a name that nobody has
// registered. Only where such a skill exists are starts made and planned for.
void check_policies(const std::shared_ptr<const Library>& library, const std::vector<EpisodeJob>& jobs,
                    const RunOptions& options, const std::atomic<bool>* stop);

}  // namespace stampede
