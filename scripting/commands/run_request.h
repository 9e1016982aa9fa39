// What a command line asks to be made: `run` makes it here, `cluster` has it made on many machines.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scripting/program/command.h"
#include "scripting/session/lock.h"
#include "scripting/session/run_job.h"

namespace stampede::program {

struct RunRequestRead {
  JobRequest request;
  RunSettings settings;  // of them the options and cameras
  std::shared_ptr<const Library> library;
  JobList jobs;
};

// Which episodes of which tasks, with which options. What a command line says of pictures and symbols is among them.
std::vector<OptionRow> run_request_options();

// Reads TASK and those options. On stderr: which variations --where and --goal leave out. Throws UsageError and Error.
RunRequestRead read_run_request(const Arguments& arguments, Console& console);

// What of it was never made as a plan. `where`: as an error names who wants one. Throws UsageError for what a plan has
// no room for.
Lock plan_of(const RunRequestRead& read, const Arguments& arguments, const std::string& where);

}  // namespace stampede::program
