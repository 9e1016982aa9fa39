// Task planning, whole: lifting, grounding, search, improvement. `symbolic_bench`: generated problems of each size and
// seed; `symbolic_bench --benchmark_filter=...` picks some; `symbolic_bench write FOLDER COUNT` writes problems as
// PDDL files; `symbolic_bench files DOMAIN PROBLEM...` plans files. Counters: steps, expansions.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/symbolic/pddl.h"
#include "planning_problems.h"

namespace {

using namespace stampede;
using Generator = bench::PlanningProblem (*)(std::int64_t, std::int64_t);

void plan_all(benchmark::State& state, Generator generate) {
  const bench::PlanningProblem text = generate(state.range(0), state.range(1));
  const Domain domain = domain_from_pddl(text.domain, "domain");
  const Problem problem = problem_from_pddl(text.problem, "problem", domain);
  PlanOutcome outcome;
  for (auto _ : state) outcome = solve(domain, problem);
  if (!validate(domain, problem, outcome.plan).valid) state.SkipWithError("the plan does not validate");
  state.counters["steps"] = static_cast<double>(outcome.plan.size());
  state.counters["expanded"] = static_cast<double>(outcome.expanded);
}

void read_large(benchmark::State& state) {  // facts of a problem of about 5 MB
  const Domain domain = domain_from_pddl("(define (domain large) (:predicates (near ?a ?b)))", "domain");
  std::string text = "(define (problem large) (:domain large) (:objects";
  for (int i = 0; i < 1000; ++i) text += " object" + std::to_string(i);
  text += ") (:init";
  for (int i = 0; i < 200'000; ++i) {
    text += "\n  (near object" + std::to_string(i % 1000) + " object" + std::to_string(i / 1000) + ")";
  }
  text += ") (:goal (near object0 object0)))";
  for (auto _ : state) benchmark::DoNotOptimize(problem_from_pddl(text, "problem", domain));
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
}

void sizes_and_seeds(benchmark::internal::Benchmark* bench, std::vector<std::int64_t> sizes) {
  for (const std::int64_t size : sizes) {
    for (std::int64_t seed = 1; seed <= 5; ++seed) bench->Args({size, seed});
  }
  bench->Unit(benchmark::kMillisecond);
}

BENCHMARK_CAPTURE(plan_all, blocks, bench::blocks)->Apply([](auto* b) { sizes_and_seeds(b, {10, 20, 40}); });
BENCHMARK_CAPTURE(plan_all, tabletop, bench::tabletop)->Apply([](auto* b) { sizes_and_seeds(b, {10, 20, 60}); });
BENCHMARK_CAPTURE(plan_all, gripper, bench::gripper)->Apply([](auto* b) { sizes_and_seeds(b, {10, 20, 60}); });
BENCHMARK(read_large)->Unit(benchmark::kMillisecond);

std::string file_text(const char* path) {
  std::ifstream file(path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// The median wall time of five runs of `solve` for each problem.
int plan_files(int count, char** paths) {
  const Domain domain = domain_from_pddl(file_text(paths[0]), paths[0]);
  for (int i = 1; i < count; ++i) {
    const Problem problem = problem_from_pddl(file_text(paths[i]), paths[i], domain);
    std::vector<double> times;
    PlanOutcome outcome;
    for (int run = 0; run < 5; ++run) {
      const auto begin = std::chrono::steady_clock::now();
      outcome = solve(domain, problem);
      times.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count());
    }
    std::sort(times.begin(), times.end());
    std::printf("%s: %s, %zu steps, %lld states, median %.1f ms (%.1f to %.1f), valid: %s\n", paths[i],
                to_text(outcome.end).c_str(), outcome.plan.size(), static_cast<long long>(outcome.expanded), times[2],
                times[0], times[4], validate(domain, problem, outcome.plan).valid ? "yes" : "no");
  }
  return 0;
}

int write_files(const std::string& folder, std::int64_t seeds) {
  const std::pair<const char*, Generator> all[] = {
      {"blocks", bench::blocks}, {"tabletop", bench::tabletop}, {"gripper", bench::gripper}};
  for (const auto& [name, generate] : all) {
    for (const std::int64_t size : {10, 20, name == all[0].first ? 40 : 60}) {
      for (std::int64_t seed = 1; seed <= seeds; ++seed) {
        const bench::PlanningProblem text = generate(size, seed);
        const std::string stem = folder + "/" + name;
        std::ofstream(stem + "-domain.pddl") << text.domain;
        std::ofstream(stem + "-n" + std::to_string(size) + "-s" + std::to_string(seed) + ".pddl") << text.problem;
      }
    }
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc > 3 && std::strcmp(argv[1], "files") == 0) return plan_files(argc - 2, argv + 2);
    if (argc > 3 && std::strcmp(argv[1], "write") == 0) return write_files(argv[2], std::stoll(argv[3]));
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
