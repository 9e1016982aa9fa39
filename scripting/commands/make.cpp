#include <fmt/format.h>

#include <ostream>
#include <set>

#include "db/catalogue_writer.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/job_request.h"
#include "scripting/commands/lock_check.h"
#include "scripting/program/progress.h"
#include "scripting/session/lock.h"
#include "scripting/session/run_job.h"

namespace stampede::program {
namespace {

std::vector<std::string> tasks_of(const LockedRun& run) {
  std::set<std::string> tasks;
  for (const LockedStrand& strand : run.strands) tasks.insert(strand.episodes.task);
  return {tasks.begin(), tasks.end()};
}

// Told before anything runs.
void require_same_engine(const Lock& lock, const std::string& file, bool anyway, Console& console) {
  const std::string why = makes_other_data(lock, this_engine());
  if (why.empty()) return;
  if (!anyway)
    throw Error(file, why,
                "take the release and a machine like those that locked it; --anyway makes what comes out here, and "
                "`stampede verify` says how far it differs");
  console.err << file << ": " << why << "\n";
}

struct Made {
  std::int64_t finished = 0, existing = 0;
  bool interrupted = false;
};

Made make_all(const Lock& lock, const Arguments& arguments, Shard shard, Console& console) {
  Made made;
  Progress progress(console);
  for (const LockedRun& run : lock.runs) {
    const auto library = Library::load(roots_of(lock, run, roots_of(arguments)), tasks_of(run));
    tell_left_out(*library, {}, console);
    const JobList jobs = jobs_of(*library, run, shard);
    RunSettings settings;
    settings.options = options_from(run.options);
    settings.options.split = run.split;
    settings.workers = workers_of(arguments);
    settings.stop = console.stop;
    tell_of(progress, console, settings);
    CatalogueWriterOptions writing;
    writing.engine = this_engine();
    writing.queue_bytes = queue_bytes(settings);
    CatalogueWriter writer(arguments.text("--out"), std::move(writing));
    const RunTally tally = run_jobs(library, jobs, settings, &writer);
    writer.finish();
    made.finished += tally.finished, made.existing += tally.existing;
    made.interrupted = tally.interrupted;
    if (made.interrupted) break;
  }
  progress.finish();
  return made;
}

ExitCode do_make(const Arguments& arguments, Console& console) {
  const std::string file = arguments.text("LOCK"), out = arguments.text("--out");
  const Lock lock = lock_from_file(file);
  require_same_engine(lock, file, arguments.flag("--anyway"), console);
  const bool whole = !arguments.has("--shard");
  const Made made = make_all(lock, arguments, whole ? Shard() : shard_option(arguments), console);
  if (made.interrupted) {
    console.err << "interrupted: the same command goes on from there\n";
    return kInterrupted;
  }
  if (!arguments.flag("--json")) {
    console.out << fmt::format("{}: {} episodes made", out, made.finished);
    if (made.existing > 0) console.out << fmt::format(", {} were there already", made.existing);
    if (!whole) console.out << fmt::format(", of {}", lock.episodes());
    console.out << "\n";
  }
  if (!whole) return kDone;
  const Catalogue catalogue = Catalogue::open(out);
  const LockCheck check = verify(lock, {&catalogue});
  return tell_check(check, lock, arguments.flag("--json"), console);
}

}  // namespace

CommandRow make_command() {
  return {"make",
          "Make the episodes of a lock",
          "The scripts are those in the lock; what they read beside them (meshes, robot descriptions) comes from "
          "--root and --path. Where this release or processor makes other data than was locked, that is said before "
          "work starts. The same command goes on where it was interrupted. In the end the catalogue is compared with "
          "the lock; the exit code is 1 where they differ.",
          {{"LOCK", "what `stampede lock` or `run --plan` wrote", true, false}},
          {{"--out", "FILE", "the catalogue", Takes::path, "demos.db", {}, false},
           {"--workers", "W", "cores to use, default: all; they do not change the data", Takes::integer, "", {}, false},
           {"--shard", "I/N", "only the I-th of N parts, as of `run`", Takes::text, "", {}, false},
           {"--anyway", "", "also where this release or processor makes other data", Takes::flag, "", {}, false}},
          {"stampede make buttons.lock --out again.db", "stampede make buttons.lock --shard 3/100 --out part3.db"},
          do_make};
}

}  // namespace stampede::program
