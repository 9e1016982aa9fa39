// Which episodes a command line asks for, for the commands that run some: `run` and `evaluate`.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "scripting/program/command.h"
#include "scripting/program/progress.h"
#include "scripting/session/run_job.h"

namespace stampede::program {

// What --shard says. Throws UsageError.
Shard shard_option(const Arguments& arguments);

// Of TASK, --episodes, --seed, --variation and, where the command has it, --shard. Throws UsageError.
JobRequest job_request(const Arguments& arguments, Split split);

// What --camera-file and --add-camera add to each task's scene; --camera and --channels are checked against it.
std::map<std::string, std::vector<Camera>> cameras_by_task(const std::shared_ptr<const Library>& library,
                                                           const JobList& jobs, const Arguments& arguments);

// `stack_blocks colour=red seed 3: success, 12.1 s`.
std::string episode_line(const EpisodeRecord& episode);

// A run moves this bar and says its remarks there. Lifetime: both, longer than the run.
void tell_of(Progress& progress, Console& console, RunSettings& settings);

}  // namespace stampede::program
