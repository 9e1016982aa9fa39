#include "db/research/baseline.h"

#include <fmt/format.h>

#include <ostream>

#include "engine/base/text.h"
#include "scripting/commands/commands.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

void list_baselines(bool as_json, Console& console) {
  JsonText json;
  json.array();
  for (const research::Baseline& baseline : research::all_baselines()) {
    if (as_json) {
      json.object().field("name", baseline.name).field("about", baseline.about).key("problems").array();
      for (const std::string& problem : baseline.problems) json.value(problem);
      json.end().end();
      continue;
    }
    console.out << fmt::format("{:22} {} ({})\n", baseline.name, baseline.about, joined(baseline.problems));
  }
  if (as_json) console.out << json.end().text();
}

ExitCode do_baseline(const Arguments& arguments, Console& console) {
  if (arguments.flag("--list")) {
    list_baselines(arguments.flag("--json"), console);
    return kDone;
  }
  if (!arguments.has("NAME") || !arguments.has("DIR"))
    throw UsageError("stampede baseline needs a baseline and the folder of a given part",
                     "`stampede baseline --list` names the baselines");
  if (!arguments.has("--out")) throw UsageError("stampede baseline needs --out FILE");
  const research::Baseline& baseline = research::find_baseline(arguments.text("NAME"));
  const OutputRules rules = output_rules(arguments, console);
  const OutputKind kind = marked_kind("answers of a baseline", "{\"by\":\"stampede baseline\"", "\"dataset\":");
  check_output(arguments.text("--out"), kind, rules);
  const research::Answers answers = research::answer_by(baseline, arguments.text("DIR"));
  OutputFile file(arguments.text("--out"), kind, rules);
  file.write(research::answers_text(answers));
  file.finish();
  const auto rows = static_cast<std::int64_t>(answers.rows.size());
  if (arguments.flag("--json")) {
    JsonText json;
    json.object()
        .field("out", arguments.text("--out"))
        .field("problem", answers.problem)
        .field("dataset", answers.dataset);
    console.out << json.field("answers", rows).end().text();
  } else {
    console.out << fmt::format("{}: {} by {}, {} answers\n", arguments.text("--out"), answers.problem, baseline.name,
                               rows);
  }
  return kDone;
}

}  // namespace

CommandRow baseline_command() {
  return {
      "baseline",
      "Answer a research problem in a simple way",
      "Reads the given part of a data set alone and writes answers that `stampede score` takes: what a learner has to "
      "beat.",
      {{"NAME", "which; see --list", false, false}, {"DIR", "the folder of the given part", false, false}},
      {{"--list", "", "the baselines, and which problems each answers", Takes::flag, "", {}, false},
       {"--out", "FILE", "where the answers go", Takes::output, "", {}, false}},
      {"stampede baseline --list", "stampede baseline keyframes given --out answers.json"},
      do_baseline};
}

}  // namespace stampede::program
