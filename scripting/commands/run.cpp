#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "db/catalogue_writer.h"
#include "engine/motion/planner.h"
#include "engine/sim/numerics.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/job_request.h"
#include "scripting/commands/language_options.h"
#include "scripting/commands/picture_options.h"
#include "scripting/commands/policy_options.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"
#include "scripting/session/constraints_fit.h"
#include "scripting/session/lock.h"
#include "scripting/session/run_job.h"

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

void print_answer(const RunTally& tally, const std::string& out, bool json, Console& console) {
  if (!json) {
    for (const auto& [name, task] : tally.tasks) {
      console.out << fmt::format("{}: {} episodes, {} succeeded, {:.1f} s simulated", name, task.episodes,
                                 task.succeeded, 1e-6 * static_cast<double>(task.simulated_us));
      if (task.existing > 0) console.out << fmt::format(", {} were there already", task.existing);
      for (const auto& [reason, count] : task.reasons) console.out << fmt::format(", {} {}", count, reason);
      console.out << "\n";
    }
    return;
  }
  JsonText text;
  text.object().field("out", out).field("interrupted", tally.interrupted).key("tasks").array();
  for (const auto& [name, task] : tally.tasks) {
    text.object().field("task", name).field("episodes", task.episodes).field("succeeded", task.succeeded);
    text.field("existing", task.existing)
        .field("simulated_s", 1e-6 * static_cast<double>(task.simulated_us))
        .key("reasons")
        .object();
    for (const auto& [reason, count] : task.reasons) text.field(reason, count);
    text.end().end();
  }
  console.out << text.end().end().text();
}

// A plan has room for options and scripts.
void require_plannable(const Arguments& arguments, const RunSettings& settings) {
  const auto refuse = [](const std::string& what, const std::string& cure) {
    throw UsageError("--plan: " + what, cure);
  };
  if (arguments.has("--policy")) refuse("what a policy does cannot be planned", "leave --policy out");
  if (arguments.has("--planner")) refuse("another program cannot be planned", "leave --planner out");
  if (arguments.has("--shard")) refuse("a plan is of the whole run", "say --shard to `stampede make`");
  if (arguments.flag("--sentences")) refuse("it has no room for sentences that a model made", "leave --sentences out");
  if (std::ranges::any_of(settings.cameras, [](const auto& of_task) { return !of_task.second.empty(); }))
    refuse("it has no room for cameras", "put them into the world's file");
}

// The same answer where all episodes were there already.
bool any_success(const std::string& file, const std::vector<std::string>& tasks) {
  const Catalogue catalogue = Catalogue::open(file);
  return std::ranges::any_of(tasks, [&](const std::string& task) {
    const QueryOptions of{{task}, 1};
    return !catalogue.query("SELECT 1 FROM demos WHERE task = ?1 LIMIT 1", of).rows.empty();
  });
}

ExitCode do_run(const Arguments& arguments, Console& console) {
  RunSettings settings;
  settings.options = run_options(arguments);
  JobRequest request = job_request(arguments, settings.options.split);
  settings.workers = workers_of(arguments);
  settings.stop = console.stop;
  const std::optional<PolicySettings> acting = policy_settings(arguments, settings.options.observation);
  const auto library = load_library(arguments, request.tasks);
  read_settings(arguments, *library, settings.options);
  leave_out_misfits(library, settings.options, request, console);
  const JobList jobs(*library, request);
  settings.cameras = cameras_by_task(library, jobs, arguments);
  if (arguments.flag("--sentences")) settings.sentences = made_sentences(*library, request.tasks, console);
  const EngineInfo engine{STAMPEDE_VERSION, numerics_probe()};
  if (arguments.flag("--plan")) {
    require_plannable(arguments, settings);
    console.out << to_text(plan_of(*library, jobs, settings.options, engine));
    return kDone;
  }
  const std::string out = arguments.text("--out");
  CatalogueWriterOptions writing;
  writing.engine = engine;
  writing.queue_bytes = queue_bytes(settings);
  CatalogueWriter writer(out, std::move(writing));
  Progress progress(console);
  tell_of(progress, console, settings);
  tell_left_out(*library, {}, console);
  std::optional<PolicyRun> policy;
  if (acting) {
    settings.helpers = std::exchange(settings.workers, 1) - 1;  // one program acts
    policy.emplace(*acting, settings.stop);
    settings.act = [&](PreparedEpisode& prepared) { return policy->act(prepared); };
  }
  const RunTally tally = run_jobs(library, jobs, settings, &writer);
  policy.reset();
  writer.finish();
  progress.finish();
  print_answer(tally, out, arguments.flag("--json"), console);
  if (tally.interrupted) {
    console.err << fmt::format(
        "interrupted: {} of {} episodes are in {}; {}\n", tally.done(), tally.total, out,
        acting ? "the same command acts in all of them again" : "the same command goes on from there");
    return kInterrupted;
  }
  return tally.total == 0 || tally.succeeded > 0 || any_success(out, request.tasks) ? kDone : kNo;
}

std::vector<OptionRow> own_options() {
  return {
      {"--episodes", "N", "episodes per task, good or bad", Takes::integer, "1", {}, false},
      {"--variation", "TEXT", "only this variation, or those with some axes: colour=red", Takes::text, "", {}, false},
      {"--seed", "S", "the first seed; default: 0, or 1000000 in the test split", Takes::integer, "", {}, false},
      {"--split", "NAME", "seeds from 1000000 up are the test split's", Takes::text, "train", {"train", "test"}, false},
      {"--workers", "W", "cores to use, default: all; they do not change the data", Takes::integer, "", {}, false},
      {"--out", "FILE", "the catalogue", Takes::path, "demos.db", {}, false},
      {"--shard",
       "I/N",
       "only the I-th of N parts of this run, each into a file of its own; merged they are the whole, and `query` "
       "asks them as one",
       Takes::text,
       "",
       {},
       false},
      {"--plan",
       "",
       "run nothing, but say what would be, scripts and all, for `stampede make` on many machines and `verify`",
       Takes::flag,
       "",
       {},
       false},
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
      {"--sentences",
       "",
       "add what `stampede paraphrase` stored beside each task; nobody is asked",
       Takes::flag,
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
}

}  // namespace

CommandRow run_command() {
  CommandRow row{
      "run",
      "Run tasks and store every episode in a catalogue",
      "Episode i of a task has seed S+i and goes through the task's variations in a fixed shuffled order. Episodes "
      "that the catalogue has already are not run again: the same command goes on where it was interrupted. "
      "Ctrl-C keeps what is finished, and the exit code is then 6. Good and bad episodes are stored alike; it is 1 "
      "when "
      "the catalogue has no successful one of these tasks. What is said about pictures goes before what a task or "
      "world says in "
      "`observe`; `stampede render` makes the same pictures later. With --where the start is drawn until it holds, "
      "with "
      "--goal another goal is planned for; both speak of the objects, predicates, traits and attributes that "
      "`stampede list TASK` names, chest.top_drawer and chest--top_drawer alike, and the hand may be left out. With "
      "--policy a program of yours acts; its episodes are stored like others, unless the same was done in the same "
      "start before.",
      {{"TASK", "names of tasks", true, true}},
      own_options(),
      {"stampede run stack_blocks push_buttons --episodes 100 --workers 4 --out demos.db",
       "stampede run stack_blocks --variation colour=red --seed 7",
       "stampede run stack_blocks --episodes 100000 --shard 3/100 --out part3.db",
       "stampede run push_buttons --episodes 1000 --plan > buttons.plan",
       "stampede run put_item_in_drawer --where '(open chest.top_drawer)' --goal '(closed chest.top_drawer)'",
       "stampede run pick_and_lift --set pick.height=0.2 --set pick.controller=cartesian_impedance",
       "stampede run stack_blocks --behaviour random_applicable --skills 12 --on-failure recover",
       "stampede run pick_and_lift --images keyframes --camera front --camera wrist --size 256x256",
       "stampede run reach_target --policy \"sh policy.sh\" --observe gripper_pose,object_pose"},
      do_run};
  add_options(row.options, constraint_options());
  add_options(row.options, behaviour_options());
  add_options(row.options, setting_options());
  add_options(row.options, planner_options());
  add_options(row.options, policy_options());
  for (OptionRow& option : picture_options(PictureUse::run)) row.options.push_back(std::move(option));
  return row;
}

}  // namespace stampede::program
