#include "scripting/commands/run_request.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "engine/motion/planner.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/job_request.h"
#include "scripting/commands/picture_options.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/session/constraints_fit.h"

namespace stampede::program {
namespace {

RunOptions run_options(const Arguments& arguments) {
  RunOptions options;
  options.split = *split_from(arguments.text("--split"));
  options.on_failure = *on_failure_from(arguments.text("--on-failure"));
  options.controller = arguments.text("--controller");
  options.motion_planner = arguments.text("--motion-planner");
  check_motion_planner(options.motion_planner, "--motion-planner");
  read_symbol_options(arguments, options);
  options.observation = picture_choice(arguments, PictureUse::run);
  if (arguments.flag("--randomise")) options.randomise = default_randomisation();
  return options;
}

// Which variations of each task can meet --where and --goal; told before anything runs.
void leave_out_misfits(const std::shared_ptr<const Library>& library, const RunOptions& options, JobRequest& request,
                       Console& console) {
  if (!options.where && !options.goal) return;
  request.variations.emplace();
  for (const std::string& name : request.tasks) {
    const std::vector<std::string> all = matching_variations(task_info(*library, name), request.variation);
    std::vector<std::string> fitting = fitting_variations(library, name, all, request.first_seed, options);
    if (fitting.size() < all.size())
      console.err << fmt::format("{}: {} of {} variations can meet --where and --goal\n", name, fitting.size(),
                                 all.size());
    (*request.variations)[name] = std::move(fitting);
  }
}

}  // namespace

RunRequestRead read_run_request(const Arguments& arguments, Console& console) {
  RunSettings settings;
  settings.options = run_options(arguments);
  JobRequest request = job_request(arguments, settings.options.split);
  const auto library = load_library(arguments, request.tasks);
  read_settings(arguments, *library, settings.options);
  leave_out_misfits(library, settings.options, request, console);
  JobList jobs(*library, request);
  settings.cameras = cameras_by_task(library, jobs, arguments);
  return {std::move(request), std::move(settings), library, std::move(jobs)};
}

Lock plan_of(const RunRequestRead& read, const Arguments& arguments, const std::string& where) {
  const auto refuse = [&](const std::string& what, const std::string& cure) {
    throw UsageError(where + ": " + what, cure);
  };
  if (arguments.has("--policy")) refuse("what a policy does cannot be planned", "leave --policy out");
  if (arguments.has("--planner")) refuse("another program cannot be planned", "leave --planner out");
  if (arguments.has("--shard")) refuse("a plan is of the whole run", "say --shard to `stampede make`");
  if (arguments.flag("--sentences")) refuse("it has no room for sentences that a model made", "leave --sentences out");
  if (std::ranges::any_of(read.settings.cameras, [](const auto& of_task) { return !of_task.second.empty(); }))
    refuse("it has no room for cameras", "put them into the world's file");
  return stampede::plan_of(*read.library, read.jobs, read.settings.options, this_engine());
}

std::vector<OptionRow> run_request_options() {
  std::vector<OptionRow> options = {
      {"--episodes", "N", "episodes per task, good or bad", Takes::integer, "1", {}, false},
      {"--variation", "TEXT", "only this variation, or those with some axes: colour=red", Takes::text, "", {}, false},
      {"--seed", "S", "the first seed; default: 0, or 1000000 in the test split", Takes::integer, "", {}, false},
      {"--split", "NAME", "seeds from 1000000 up are the test split's", Takes::text, "train", {"train", "test"}, false},
      {"--on-failure", "WAY", "after a failed skill", Takes::text, "undo", {"undo", "stop", "recover"}, false},
      {"--controller",
       "NAME",
       "instead of each skill's own",
       Takes::text,
       "",
       {"joint_position", "joint_impedance", "cartesian_impedance"},
       false},
      {"--motion-planner",
       "NAME",
       "what finds the arm's way instead of our own planner: a geometric planner of OMPL, ompl:RRTConnect or "
       "ompl:BITstar",
       Takes::text,
       "",
       {},
       false},
      {"--randomise",
       "",
       "draw looks, light, cameras and dynamics of worlds without ranges of their own",
       Takes::flag,
       "",
       {},
       false}};
  add_options(options, constraint_options());
  add_options(options, behaviour_options());
  add_options(options, setting_options());
  add_options(options, picture_options(PictureUse::run));
  return options;
}

}  // namespace stampede::program
