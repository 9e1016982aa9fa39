#include <fmt/format.h>

#include <algorithm>
#include <ostream>
#include <utility>

#include "db/catalogue_writer.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/job_request.h"
#include "scripting/commands/language_options.h"
#include "scripting/commands/policy_options.h"
#include "scripting/commands/run_request.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/program/json_text.h"
#include "scripting/program/progress.h"

namespace stampede::program {
namespace {

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

// The same answer where all episodes were there already.
bool any_success(const std::string& file, const std::vector<std::string>& tasks) {
  const Catalogue catalogue = Catalogue::open(file);
  return std::ranges::any_of(tasks, [&](const std::string& task) {
    const QueryOptions of{{task}, 1};
    return !catalogue.query("SELECT 1 FROM demos WHERE task = ?1 LIMIT 1", of).rows.empty();
  });
}

ExitCode do_run(const Arguments& arguments, Console& console) {
  RunRequestRead read = read_run_request(arguments, console);
  if (arguments.flag("--plan")) {
    console.out << to_text(plan_of(read, arguments, "--plan"));
    return kDone;
  }
  RunSettings& settings = read.settings;
  settings.workers = workers_of(arguments);
  settings.stop = console.stop;
  const std::optional<PolicySettings> acting = policy_settings(arguments, settings.options.observation);
  if (arguments.flag("--sentences")) settings.sentences = made_sentences(*read.library, read.request.tasks, console);
  const std::string out = arguments.text("--out");
  CatalogueWriterOptions writing;
  writing.engine = this_engine();
  writing.queue_bytes = queue_bytes(settings);
  CatalogueWriter writer(out, std::move(writing));
  Progress progress(console);
  tell_of(progress, console, settings);
  tell_left_out(*read.library, {}, console);
  std::optional<PolicyRun> policy;
  if (acting) {
    settings.helpers = std::exchange(settings.workers, 1) - 1;  // one program acts
    policy.emplace(*acting, settings.stop);
    settings.act = [&](PreparedEpisode& prepared) { return policy->act(prepared); };
  }
  const RunTally tally = run_jobs(read.library, read.jobs, settings, &writer);
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
  return tally.total == 0 || tally.succeeded > 0 || any_success(out, read.request.tasks) ? kDone : kNo;
}

std::vector<OptionRow> own_options() {
  return {{"--workers", "W", "cores to use, default: all; they do not change the data", Takes::integer, "", {}, false},
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
          {"--sentences",
           "",
           "add what `stampede paraphrase` stored beside each task; nobody is asked",
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
      run_request_options(),
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
  add_options(row.options, own_options());
  add_options(row.options, planner_options());
  add_options(row.options, policy_options());
  return row;
}

}  // namespace stampede::program
