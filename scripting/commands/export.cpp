#include <fmt/format.h>

#include <ostream>
#include <set>

#include "db/catalogue.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/export_kinds.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

// A new kind is one file and one line here.
const std::map<std::string, ExportFunction>& kinds() {
  static const std::map<std::string, ExportFunction> all = {
      {"pddl", export_pddl}, {"bddl", export_bddl_files}, {"recording", export_recordings}};
  return all;
}

std::vector<std::int64_t> chosen_episodes(const Arguments& arguments, const Catalogue& catalogue) {
  std::vector<std::int64_t> ids;
  for (const std::string& text : arguments.list("--episode")) ids.push_back(episode_number(text));
  if (ids.empty())
    for (const EpisodeSummary& episode : catalogue.episodes()) ids.push_back(episode.id);
  return ids;
}

ExitCode do_export(const Arguments& arguments, Console& console) {
  const std::string what = arguments.text("WHAT");
  const auto kind = kinds().find(what);
  if (kind == kinds().end())
    throw UsageError("stampede export cannot write '" + what + "'", "it writes pddl, bddl and recording");
  if (!arguments.has("--out")) throw UsageError("stampede export needs --out FOLDER");
  if (what != "bddl")
    for (const char* option : {"--dialect", "--mapping", "--frame", "--leave-out"})
      if (arguments.has(option)) throw UsageError(std::string(option) + " is of export bddl", "leave it out");
  if (what != "pddl" && arguments.has("--known")) throw UsageError("--known is of export pddl", "leave it out");
  const Catalogue catalogue = Catalogue::open(arguments.text("FILE"));
  const ExportJob job{catalogue, chosen_episodes(arguments, catalogue), arguments.text("--out"), arguments, console};
  const ExportCount count = kind->second(job);
  if (console.stopped()) console.err << "interrupted: what is written stays\n";
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("out", arguments.text("--out")).field("files", count.files);
    console.out << json.field("left_out", count.left_out).end().text();
  } else {
    console.out << fmt::format("{}: {} files, {} left out{}\n", arguments.text("--out"), count.files, count.left_out,
                               what == "recording" ? "" : "; index.csv lists all");
  }
  if (console.stopped()) return kInterrupted;
  return count.files == 0 ? kNo : kDone;
}

}  // namespace

CommandRow export_command() {
  return {
      "export",
      "Write what episodes say in symbols as files, or episodes as recording folders",
      "pddl: each distinct domain once, and of every episode the problem at its start and at every boundary of a "
      "skill, with the facts that held there, the plan that was executed from there on, and how the episode "
      "ended. bddl: the problem of a frame in the words of LIBERO or BEHAVIOR; comments say whether a word means "
      "the same there, and what a dialect cannot say is left out with the reason. index.csv and index.json list "
      "all files. recording: the form in which recordings of real robots come in (db/recording/README.md), with "
      "the pictures that are stored: one episode in FOLDER itself, several each in FOLDER/episode_000001 and so on; "
      "FOLDER must be new or empty. The exit code is 1 when nothing could be written.",
      {{"WHAT", "pddl, bddl or recording", true, false}, {"FILE", "the catalogue", true, false}},
      {{"--out", "FOLDER", "where to; made when it is not there", Takes::output, "", {}, false},
       {"--episode", "N", "only these episodes", Takes::integer, "", {}, true},
       {"--known",
        "",
        "pddl: as an agent knows it: what was hidden and never seen is not in the problems",
        Takes::flag,
        "",
        {},
        false},
       {"--dialect", "NAME", "bddl: whose", Takes::text, "both", {"both", "libero", "behavior"}, false},
       {"--mapping",
        "FILE",
        "bddl: a Lua file with their words for ours, which go before those of worlds/bddl; see "
        "worlds/bddl/README.md",
        Takes::path,
        "",
        {},
        false},
       {"--frame", "N", "bddl: the moment", Takes::integer, "0", {}, false},
       {"--leave-out", "PREDICATE", "bddl: not in the goal: hand_empty", Takes::text, "", {}, true}},
      {"stampede export pddl demos.db --out problems", "stampede export recording demos.db --episode 1 --out recorded",
       "stampede export bddl demos.db --out bddl --dialect libero --leave-out hand_empty"},
      do_export};
}

}  // namespace stampede::program
