#include "engine/symbolic/external_planner.h"

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>
#include <system_error>

#include "engine/base/error.h"
#include "engine/base/shell_program.h"
#include "engine/base/temporary_folder.h"
#include "engine/symbolic/pddl.h"

namespace stampede {
namespace {

namespace fs = std::filesystem;

// Puts a file's name in place of every `{word}`.
void fill_in(std::string& command, const std::string& word, const fs::path& file) {
  const std::string mark = "{" + word + "}";
  if (command.find(mark) == std::string::npos) {
    throw Error("--planner", "the command has no " + mark, "write COMMAND {domain} {problem} {plan}");
  }
  const std::string name = shell_word(file.string());
  for (std::size_t at = command.find(mark); at != std::string::npos; at = command.find(mark, at + name.size())) {
    command.replace(at, mark.size(), name);
  }
}

void write_file(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw Error(path.string(), "cannot be written", "make room there, or set TMPDIR");
}

std::optional<std::string> file_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

// The plan file, or the last of an anytime planner's.
std::optional<std::string> plan_text(const fs::path& path) {
  std::optional<std::string> best = file_text(path);
  for (int number = 1;; ++number) {
    std::optional<std::string> later = file_text(path.string() + "." + std::to_string(number));
    if (!later) return best;
    best = std::move(later);
  }
}

std::string last_lines(const std::string& text) {
  constexpr std::size_t kMost = 600;
  std::size_t begin = text.size() > kMost ? text.size() - kMost : 0;
  if (begin > 0) begin = std::min(text.size(), text.find('\n', begin) + 1);
  return text.substr(begin);
}

// Fast Downward's codes; what others mean by theirs is not known.
PlanEnd end_of(int exit_code) {
  if (exit_code == 10 || exit_code == 11) return PlanEnd::unsolvable;
  if (exit_code == 20 || exit_code == 22) return PlanEnd::memory_limit;
  return PlanEnd::no_answer;
}

}  // namespace

PlanOutcome solve_externally(const std::string& command, const Domain& domain, const Problem& problem) {
  const TemporaryFolder temporary;
  const fs::path& folder = temporary.path();
  const fs::path plan_path = folder / "plan.txt", log_path = folder / "log.txt";
  std::string line = command;
  fill_in(line, "domain", folder / "domain.pddl");
  fill_in(line, "problem", folder / "problem.pddl");
  fill_in(line, "plan", plan_path);
  write_file(folder / "domain.pddl", to_pddl(domain));
  write_file(folder / "problem.pddl", to_pddl(problem, domain));
  const std::string whole = "cd " + shell_word(folder.string()) + " && { " + line + "\n} >" +
                            shell_word(log_path.string()) + " 2>&1 </dev/null";
  int status = 0;
  try {
    status = ShellProgram(whole, -1, -1, ShellProgram::Group::ours, ShellProgram::Orphans::searched).wait();
  } catch (const std::system_error& error) {
    throw Error("--planner", "the planner could not be started: " + error.code().message(), "");
  }
  const int exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  const std::string said = last_lines(file_text(log_path).value_or(""));
  if (exit_code == 127 || exit_code == 126) {
    throw Error("--planner", "the planner could not be started: " + said, "check its path: `" + command + "`");
  }
  PlanOutcome outcome;
  const std::optional<std::string> text = plan_text(plan_path);
  if (!text) {
    outcome.end = end_of(exit_code);
    outcome.explanation = (exit_code < 0 ? "the planner was killed by a signal"
                                         : "the planner ended with code " + std::to_string(exit_code)) +
                          " and wrote no plan" + (said.empty() ? "" : ":\n" + said);
    return outcome;
  }
  outcome.plan = plan_from_text(*text, "the planner's plan");
  const Validation verdict = validate(domain, problem, outcome.plan);
  if (!verdict.valid) {
    throw Error("the planner's plan", verdict.explanation, "the planner and this program read the problem differently");
  }
  outcome.solved = true;
  outcome.end = PlanEnd::solved;
  outcome.cost = plan_cost(domain, problem, outcome.plan);
  return outcome;
}

}  // namespace stampede
