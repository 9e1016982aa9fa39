#include <fmt/format.h>

#include <ostream>

#include "engine/episode/planning.h"
#include "engine/episode/start.h"
#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/program/episode_job.h"
#include "scripting/program/json_text.h"

namespace stampede::program {
namespace {

struct Answer {
  Start start;
  PlanningTask asked;
  PlanOutcome outcome;
  bool from_steps = false;  // the task says how
};

Answer find_plan(EpisodeScripts& scripts, const RunOptions& options, const std::atomic<bool>* stop) {
  Answer answer;
  const PreparedStart start = prepare_start(scripts.task(), scripts.symbols(), options, stop);
  answer.start = start;
  if (answer.start.reason != Reason::none) return answer;
  World world(answer.start.scene);
  WorldView view(world);
  view.restore(start.history);
  FactTracker facts(scripts.symbols(), view);
  facts.begin(start.values);  // as the episode begins: a fresh world has no contacts to read `on` from
  answer.asked = planning_task(scripts.task(), scripts.symbols().domain(), facts, 0);
  if (const auto steps = scripts.task().steps()) {
    answer.from_steps = true;
    answer.outcome.solved = true;
    answer.outcome.plan = *steps;
  } else {
    answer.outcome = solve(answer.asked.domain, answer.asked.problem);
  }
  return answer;
}

void print_json(const Answer& answer, const EpisodeJob& job, const Domain& domain, bool pddl, std::ostream& out) {
  JsonText json;
  json.object().field("task", job.task).field("variation", job.variation).field("seed", job.seed);
  json.field("solved", answer.outcome.solved).field("explanation", answer.outcome.explanation);
  json.field("from_steps", answer.from_steps).key("plan").array();
  for (const PlanStep& step : answer.outcome.plan) {
    json.object().field("action", step.action).key("arguments").array();
    for (const std::string& argument : step.arguments) json.value(argument);
    json.end().end();
  }
  json.end();
  if (pddl) json.field("domain", to_pddl(domain)).field("problem", to_pddl(answer.asked.problem, domain));
  out << json.end().text();
}

ExitCode run(const Arguments& arguments, Console& console) {
  const auto library = load_library(arguments);
  const Library::TaskInfo& task = task_info(*library, arguments.text("TASK"));
  const std::vector<std::string> variations = matching_variations(task, arguments.text("--variation"));
  const EpisodeJob job{task.name, variations.empty() ? "" : variations.front(),
                       in_range(arguments, "--seed", 0, kLargestSeed)};
  RunOptions options;
  options.seed = job.seed;
  PreparedEpisode prepared(library, job, options);
  const Answer answer = find_plan(prepared.scripts(), prepared.options(), console.stop);
  if (answer.start.reason != Reason::none) {
    console.err << fmt::format("{} {}: no start: {}\n    {}\n", job.task, job.variation, to_string(answer.start.reason),
                               answer.start.detail);
    return kNo;
  }
  const Domain& domain = answer.asked.domain;
  const bool pddl = arguments.flag("--pddl");
  if (arguments.flag("--json")) {
    print_json(answer, job, domain, pddl, console.out);
  } else {
    if (pddl) console.out << to_pddl(domain) << "\n" << to_pddl(answer.asked.problem, domain) << "\n";
    console.out << (pddl ? "; plan\n" : "") << to_text(answer.outcome.plan);
  }
  const PlanOutcome& outcome = answer.outcome;
  console.err << fmt::format("{} {}, seed {}: ", job.task, job.variation, job.seed);
  if (outcome.solved) {
    console.err << fmt::format("{} steps, {} states expanded\n", outcome.plan.size(), outcome.expanded);
    return kDone;
  }
  console.err << "no plan\n    " << outcome.explanation << "\n";
  return outcome.expanded >= PlanLimits{}.expansions ? kBudgetSpent : kNo;
}

}  // namespace

CommandRow plan_command() {
  return {"plan",
          "Print the plan of one start of a task",
          "Makes the start of one variation from one seed, reads its facts, and asks the task planner (or the task's "
          "own steps). With --pddl it prints the domain and the problem too. Without a plan it says which goal "
          "literal cannot be made true and which action or fact is missing.",
          {{"TASK", "the task's name", true, false}},
          {{"--variation",
            "TEXT",
            "the variation, or some of its axes: colour=red; default: the first",
            Takes::text,
            "",
            {},
            false},
           {"--seed", "S", "the seed", Takes::integer, "0", {}, false},
           {"--pddl", "", "print the PDDL domain and problem before the plan", Takes::flag, "", {}, false}},
          {"stampede plan stack_blocks --variation colour=red,height=3", "stampede plan put_item_in_drawer --pddl"},
          run};
}

}  // namespace stampede::program
