#include "scripting/commands/symbol_options.h"

#include <iterator>

#include "engine/symbolic/external_planner.h"
#include "scripting/commands/commands.h"
#include "scripting/session/constraints_fit.h"
#include "scripting/session/settings_fit.h"

namespace stampede::program {
namespace {

constexpr std::int64_t kMostSkills = 10'000;

}  // namespace

std::vector<OptionRow> constraint_options() {
  return {{"--where",
           "FORMULA",
           "what must hold at the start, in PDDL: '(not (open chest.top_drawer))'; variations that cannot are left out",
           Takes::text,
           "",
           {},
           false},
          {"--goal",
           "FORMULA",
           "instead of the task's goal, in PDDL: '(inside item chest.top_drawer)'",
           Takes::text,
           "",
           {},
           false}};
}

std::vector<OptionRow> behaviour_options() {
  return {{"--behaviour",
           "NAME",
           "what decides on the next skill: a plan for the goal, or seeded draws of any skill or of those whose "
           "precondition holds",
           Takes::text,
           "plan",
           {"plan", "random_skills", "random_applicable"},
           false},
          {"--skills", "N", "how many skills a random behaviour draws", Takes::integer, "20", {}, false}};
}

std::vector<OptionRow> setting_options() {
  return {{"--set",
           "SKILL.NAME=VALUE",
           "a continuous parameter of a skill or its controller, instead of what is drawn: pick.height=0.2, "
           "pick.controller=cartesian_impedance; vectors 0,0,1 or one component direction.3=1",
           Takes::text,
           "",
           {},
           true}};
}

void read_settings(const Arguments& arguments, const Library& library, RunOptions& options) {
  try {
    options.set = settings_from(arguments.list("--set"), library, "--set");
  } catch (const Error& error) {
    throw UsageError(error.where() + ": " + error.message(), error.hint());
  }
}

std::vector<OptionRow> planner_options() {
  return {{"--planner",
           "COMMAND",
           "another task planner: a command line with {domain}, {problem} and {plan}, the files it reads and writes",
           Takes::text,
           "",
           {},
           false}};
}

void add_options(std::vector<OptionRow>& options, std::vector<OptionRow> further) {
  options.insert(options.end(), std::make_move_iterator(further.begin()), std::make_move_iterator(further.end()));
}

std::function<PlanOutcome(const Domain& domain, const Problem& problem)> named_planner(const std::string& command) {
  for (const char* file : {"{domain}", "{problem}", "{plan}"})
    if (command.find(file) == std::string::npos)
      throw UsageError("--planner: the command does not mention " + std::string(file),
                       "--planner \"COMMAND {domain} {problem} {plan}\"");
  return [command](const Domain& domain, const Problem& problem) { return solve_externally(command, domain, problem); };
}

void read_symbol_options(const Arguments& arguments, RunOptions& options) {
  if (arguments.has("--where")) options.where = formula_option(arguments.text("--where"), "--where");
  if (arguments.has("--goal")) options.goal = formula_option(arguments.text("--goal"), "--goal");
  if (arguments.has("--behaviour")) options.behaviour = *behaviour_from(arguments.text("--behaviour"));
  if (arguments.has("--skills")) {
    if (options.behaviour == Behaviour::plan)
      throw UsageError("--skills is of random behaviours", "add --behaviour random_applicable, or leave it out");
    options.skills = static_cast<int>(in_range(arguments, "--skills", 1, kMostSkills));
  }
  if (arguments.has("--planner")) {
    options.planner.name = arguments.text("--planner");
    options.planner.plan = named_planner(options.planner.name);
  }
}

}  // namespace stampede::program
