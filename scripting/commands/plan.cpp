#include <fmt/format.h>

#include <ostream>

#include "engine/base/text_file.h"
#include "engine/symbolic/pddl.h"
#include "scripting/commands/commands.h"
#include "scripting/commands/plan_output.h"
#include "scripting/commands/symbol_options.h"
#include "scripting/runtime/bddl_mapping_reader.h"
#include "scripting/session/constraints_fit.h"
#include "scripting/session/start_question.h"
#include "scripting/session/stored_symbols.h"

namespace stampede::program {
namespace {

// The task's own steps, or what the planner finds.
FoundPlans plans_for(const Arguments& arguments, const StartQuestion& question) {
  if (!question.said) return ask_for_plans(arguments, question.asked.domain, question.asked.problem);
  return {{question.said->plan}, *question.said, true};
}

// The start in the words of a BDDL dialect. Throws Error where the dialect cannot say it.
std::string bddl_of(const Arguments& arguments, const Library& library, const StartQuestion& question,
                    const Domain& own, const std::string& task) {
  EpisodeRecord record;
  record.task = task;
  record.labels.language = {{LanguageLevel::task, question.instructions.front(), -1}};
  const StoredSymbols symbols{own, question.plain};
  std::string refusals;
  std::string text =
      bddl_text({record, *question.start.scene, symbols, question.state},
                bddl_mappings_of(library, arguments.text("--bddl")), arguments.list("--leave-out"), refusals);
  if (!refusals.empty()) throw Error(task, refusals.substr(0, refusals.size() - 1));
  return text;
}

EpisodeJob job_of(const Arguments& arguments, const std::shared_ptr<const Library>& library,
                  const RunOptions& options) {
  const Library::TaskInfo& task = task_info(*library, arguments.text("TASK"));
  const std::int64_t seed = in_range(arguments, "--seed", 0, kLargestSeed);
  const std::vector<std::string> variations =
      fitting_variations(library, task.name, matching_variations(task, arguments.text("--variation")), seed, options);
  return {task.name, variations.empty() ? "" : variations.front(), seed};
}

ExitCode plan_task(const Arguments& arguments, Console& console) {
  RunOptions options;
  read_symbol_options(arguments, options);
  const auto library = load_library(arguments, {arguments.text("TASK")});
  const EpisodeJob job = job_of(arguments, library, options);
  options.seed = job.seed;
  PreparedEpisode prepared(library, job, options);
  const StartQuestion question = question_at_start(prepared.scripts(), prepared.options(), console.stop);
  if (question.start.reason != Reason::none) {
    console.err << fmt::format("{} {}: no start: {}\n    {}\n", job.task, job.variation,
                               to_string(question.start.reason), question.start.detail);
    return kNo;
  }
  if (arguments.has("--bddl")) {
    console.out << bddl_of(arguments, *library, question, prepared.scripts().symbols().domain(), job.task);
    return kDone;
  }
  FoundPlans found = plans_for(arguments, question);
  std::string& explanation = found.outcome.explanation;
  if (!found.outcome.solved) explanation += why_not_assumed(question.not_assumed, explanation);
  const bool pddl = arguments.flag("--pddl") || arguments.flag("--task-sized");
  const PlanNames names = pddl ? PlanNames::pddl : PlanNames::ours;
  PddlTexts texts;
  if (pddl) texts = pddl_of(question, prepared.scripts().symbols().domain(), arguments.flag("--task-sized"));
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("task", job.task).field("variation", job.variation).field("seed", job.seed);
    write_plans(found, question.asked.domain, question.asked.problem, names, json);
    json.field("beside_goal", question.beside_goal).key("assumed").array();
    for (const Fact& fact : question.assumed) json.value(to_text(fact));
    json.end();
    if (pddl) json.field("domain", texts.domain).field("problem", texts.problem);
    console.out << json.end().text();
  } else {
    if (pddl) console.out << texts.domain << "\n" << texts.problem << "\n; plan\n";
    write_plans(found, question.asked.domain, question.asked.problem, names, console.out);
    for (const Fact& fact : question.assumed)
      console.out << fmt::format("; assumes {}, which nobody can see at the start\n",
                                 pddl ? to_pddl_name(to_text(fact)) : to_text(fact));
  }
  console.err << fmt::format("{} {}, seed {}: ", job.task, job.variation, job.seed) << plan_story(found);
  return plan_code(found);
}

ExitCode plan_files(const Arguments& arguments, Console& console) {
  for (const char* option : {"--variation", "--seed", "--where", "--goal", "--bddl", "--leave-out"})
    if (arguments.has(option))
      throw UsageError(std::string(option) + " is for tasks, not for PDDL files", "leave it out, or name a task");
  const std::string domain_file = arguments.text("TASK"), problem_file = arguments.text("PROBLEM");
  Domain domain = domain_from_pddl(read_text_file(domain_file), domain_file);
  Problem problem = problem_from_pddl(read_text_file(problem_file), problem_file, domain);
  const FoundPlans found = ask_for_plans(arguments, domain, problem);
  const bool sized = arguments.flag("--task-sized"), pddl = sized || arguments.flag("--pddl");
  if (sized) {
    domain = task_sized(domain, problem);
    problem = restricted(problem, domain);
  }
  if (arguments.flag("--json")) {
    JsonText json;
    json.object().field("domain_file", domain_file).field("problem_file", problem_file);
    write_plans(found, domain, problem, PlanNames::pddl, json);
    if (pddl) json.field("domain", to_pddl(domain)).field("problem", to_pddl(problem, domain));
    console.out << json.end().text();
  } else {
    if (pddl) console.out << to_pddl(domain) << "\n" << to_pddl(problem, domain) << "\n; plan\n";
    write_plans(found, domain, problem, PlanNames::pddl, console.out);
  }
  console.err << problem_file << ": " << plan_story(found);
  return plan_code(found);
}

ExitCode do_plan(const Arguments& arguments, Console& console) {
  return arguments.has("PROBLEM") ? plan_files(arguments, console) : plan_task(arguments, console);
}

}  // namespace

CommandRow plan_command() {
  CommandRow row{
      "plan",
      "Print the plan of one start of a task, or of a PDDL problem",
      "Of a task: makes the start of one variation from one seed, reads its facts, and asks the task planner (or the "
      "task's own steps); what nobody can see there is not known, and what the plan has to assume of it is said below "
      "it; "
      "with --pddl it prints the domain of the world, the same for all its tasks, and the problem. "
      "Of two files: the PDDL domain and problem of any author. Without a plan it says which goal literal cannot be "
      "made true and which action or fact is missing. The exit code is 0 with a plan, 1 where none exists (proved), 5 "
      "where the planner gave up at a limit, 3 for files that are no PDDL and for a --planner that failed.",
      {{"TASK", "the task's name, or the file of a PDDL domain", true, false},
       {"PROBLEM", "the file of a PDDL problem, with a domain file before it", false, false}},
      {{"--variation",
        "TEXT",
        "the variation, or some of its axes: colour=red; default: the first",
        Takes::text,
        "",
        {},
        false},
       {"--seed", "S", "the seed", Takes::integer, "0", {}, false},
       {"--pddl", "", "print the PDDL domain and problem before the plan", Takes::flag, "", {}, false},
       {"--task-sized",
        "",
        "print PDDL with only what this problem needs, and fluents for the order of its goal",
        Takes::flag,
        "",
        {},
        false},
       {"--bddl",
        "DIALECT",
        "print the start and the goal as a BDDL problem instead",
        Takes::text,
        "",
        {"libero", "behavior"},
        false},
       {"--leave-out", "PREDICATE", "not in the goal of a BDDL problem", Takes::text, "", {}, true}},
      {"stampede plan stack_blocks --variation colour=red,height=3", "stampede plan put_item_in_drawer --pddl",
       "stampede plan pick_and_lift --where '(on target table)' --goal '(holding target)' --task-sized",
       "stampede plan put_item_in_drawer --bddl libero --leave-out hand_empty",
       "stampede plan domain.pddl problem.pddl --k 3"},
      do_plan};
  add_options(row.options, constraint_options());
  add_options(row.options, plan_limit_options());
  return row;
}

}  // namespace stampede::program
