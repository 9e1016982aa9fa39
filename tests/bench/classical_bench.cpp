// Six classical domains at three sizes: CPU time, steps and states of `solve`, each plan validated. `classical_bench`:
// all; `classical_bench NAME...`: these; `classical_bench write FOLDER`: the same problems as PDDL files, for other
// planners.
#include <cstdio>
#include <cstring>
#include <ctime>
#include <fstream>
#include <string>

#include "classical_problems.h"
#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"

namespace {

using namespace stampede;

constexpr std::int64_t kSeed = 1;

// Of this process's CPU: other work on the machine does not count.
double seconds_since(std::clock_t begin) { return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC; }

void plan(const bench::ClassicalDomain& one, std::int64_t size) {
  const bench::PlanningProblem text = one.generate(size, kSeed);
  const Domain domain = domain_from_pddl(text.domain, one.name);
  const Problem problem = problem_from_pddl(text.problem, one.name, domain);
  std::clock_t begin = std::clock();
  const PlanOutcome outcome = solve(domain, problem);
  const double planned = seconds_since(begin);
  begin = std::clock();
  const bool is_valid = validate(domain, problem, outcome.plan).valid;
  const double validated = seconds_since(begin);
  begin = std::clock();
  validate(domain, problem, {});
  std::printf("%-10s %4lld  %8.2f s  %5zu steps  %8lld states  valid: %-3s in %.2f s, empty plan in %.2f s  %s\n",
              one.name, static_cast<long long>(size), planned, outcome.plan.size(),
              static_cast<long long>(outcome.expanded), is_valid ? "yes" : "no", validated, seconds_since(begin),
              outcome.solved ? "" : to_text(outcome.end).c_str());
  std::fflush(stdout);
}

void write(const bench::ClassicalDomain& one, const std::string& folder) {
  for (const std::int64_t size : one.sizes) {
    const bench::PlanningProblem text = one.generate(size, kSeed);
    const std::string stem = folder + "/" + one.name;
    std::ofstream(stem + "-domain.pddl") << text.domain;
    std::ofstream(stem + "-n" + std::to_string(size) + ".pddl") << text.problem;
  }
}

bool is_wanted(const char* name, int argc, char** argv) {
  for (int i = 1; i < argc; ++i) {
    if (std::strcmp(argv[i], name) == 0) return true;
  }
  return argc < 2;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const bool writes = argc == 3 && std::strcmp(argv[1], "write") == 0;
    for (const bench::ClassicalDomain& one : bench::kClassicalDomains) {
      if (writes) {
        write(one, argv[2]);
      } else if (is_wanted(one.name, argc, argv)) {
        for (const std::int64_t size : one.sizes) plan(one, size);
      }
    }
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
}
