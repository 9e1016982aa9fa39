#include "db/research/dataset.h"

#include <fmt/format.h>

#include <algorithm>
#include <ostream>

#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

void list_problems(bool as_json, Console& console) {
  JsonText json;
  json.array();
  for (const research::ResearchProblem& problem : research::all_problems()) {
    if (!as_json) {
      console.out << padded(problem.name, 24) << problem.title << "\n";
      continue;
    }
    json.object().field("name", problem.name).field("serves", problem.serves).field("title", problem.title);
    for (const auto& [part, uses] : {std::pair{"given", &problem.given}, {"hidden", &problem.hidden}}) {
      json.key(part).array();
      for (const research::TableUse& use : *uses) json.value(use.table());
      json.end();
    }
    json.field("scoring", problem.scoring).end();
  }
  if (as_json) console.out << json.end().text();
}

// Without links, `.` and a slash at the end, there or not.
std::filesystem::path canonical(const std::string& folder) {
  const std::filesystem::path path = std::filesystem::weakly_canonical(std::filesystem::absolute(folder));
  return path.has_filename() ? path : path.parent_path();
}

bool holds(const std::filesystem::path& outer, const std::filesystem::path& inner) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

// Whoever has the given part would have the other with it.
void refuse_nested(const std::string& out, const std::string& hidden) {
  const std::filesystem::path given = canonical(out), kept = canonical(hidden);
  const char* cure = "what is hidden must lie elsewhere: name two folders side by side";
  if (given == kept) throw UsageError("--out and --hidden are the same folder", cure);
  if (holds(given, kept)) throw UsageError("--hidden " + hidden + " lies in --out " + out, cure);
  if (holds(kept, given)) throw UsageError("--out " + out + " lies in --hidden " + hidden, cure);
}

ExitCode do_dataset(const Arguments& arguments, Console& console) {
  if (arguments.flag("--list")) {
    list_problems(arguments.flag("--json"), console);
    return kDone;
  }
  if (!arguments.has("PROBLEM") || !arguments.has("FILE"))
    throw UsageError("stampede dataset needs a problem and a catalogue",
                     "`stampede dataset --list` names the problems");
  if (!arguments.has("--out")) throw UsageError("stampede dataset needs --out DIR");
  const research::ResearchProblem& problem = research::find_problem(arguments.text("PROBLEM"));
  const std::string out = arguments.text("--out"), hidden = arguments.text("--hidden");
  if (!hidden.empty()) refuse_nested(out, hidden);
  const research::DatasetReport report = research::make_dataset(
      problem, {arguments.text("FILE"), out, hidden, arguments.text("--split"), arguments.text("--where")});
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("dataset", report.id).field("problem", problem.name).field("out", out);
    if (!hidden.empty()) json.field("hidden", hidden);
    json.field("train", report.train).field("validation", report.validation).field("test", report.test);
    json.field("given_rows", report.given_rows).field("hidden_rows", report.hidden_rows);
    console.out << json.field("leaks", report.leaks).end().text();
  } else {
    console.out << fmt::format("{}: {} {}, {} train, {} validation, {} test, {} rows given, {} hidden{}\n", out,
                               problem.name, report.id, report.train, report.validation, report.test, report.given_rows,
                               report.hidden_rows, hidden.empty() ? " (not written)" : "");
  }
  if (!report.leaks.empty())
    console.err << "remark: what is held out shows in training: " << report.leaks << "\n    " << out
                << "/README.md counts it\n";
  return kDone;
}

}  // namespace

CommandRow dataset_command() {
  return {
      "dataset",
      "Make a data set for a research problem of a catalogue",
      "What a learner is given and what it is scored against, in two folders: plain SQLite files, each with a page "
      "that says what is in it. Episodes get new numbers; nothing in the given part says what is hidden. The same "
      "episodes make the same bytes. The exit code is 3 when the catalogue has nothing to serve. Axes are those of the "
      "tasks' variations (view `axes`); those of the last example come from `stampede run push_buttons --episodes 30 "
      "--out buttons.db`.",
      {{"PROBLEM", "which; see --list", false, false}, {"FILE", "the catalogue", false, false}},
      {{"--list", "", "the problems", Takes::flag, "", {}, false},
       {"--out",
        "DIR",
        "where the given part goes: a folder that is new, empty, or of a data set to be made anew",
        Takes::path,
        "",
        {},
        false},
       {"--hidden", "DIR", "where the hidden part goes, likewise; nowhere when not given", Takes::path, "", {}, false},
       {"--split",
        "RULE",
        "what is kept for tests: seeds, AXIS=VALUE,…, object=CLASS,…, task=NAME,…, composition (pairs of consecutive "
        "skills) or composition=AXIS+AXIS (pairs of values)",
        Takes::text,
        "seeds",
        {},
        false},
       {"--where",
        "SQL",
        "of which episodes, by columns of view `episodes`: of one robot's world, say, where a catalogue has several",
        Takes::text,
        "",
        {},
        false}},
      {"stampede dataset --list", "stampede dataset segments demos.db --out given --hidden hidden",
       "stampede dataset transfer demos.db --out one_arm --hidden one_arm_hidden --where \"world = 'tabletop'\"",
       "stampede dataset behaviour buttons.db --out behaviour --hidden behaviour_hidden --split count=2"},
      do_dataset};
}

}  // namespace stampede::program
