#include "engine/sim/command_log.h"

#include <catch2/catch.hpp>

using namespace stampede;

namespace {

Command command(std::int64_t step) { return {step, operation::Boundary{}}; }

std::vector<std::int64_t> steps_of(const CommandLog& log) {
  std::vector<std::int64_t> steps;
  for (const Command& one : log.commands()) steps.push_back(one.step);
  CHECK(steps.size() == log.size());
  return steps;
}

}  // namespace

TEST_CASE("a log goes back to what it was, and other logs to the same", "[sim]") {
  CommandLog log, other;
  CHECK(log.mark() == nullptr);
  log.add(command(1));
  log.add(command(2));
  const CommandLog::Mark early = log.mark();
  log.add(command(3));
  const CommandLog::Mark late = log.mark();
  CHECK(log.mark() == late);  // nothing was added
  log.add(command(4));
  CHECK(steps_of(log) == std::vector<std::int64_t>{1, 2, 3, 4});
  log.back_to(early);
  CHECK(steps_of(log) == std::vector<std::int64_t>{1, 2});
  log.add(command(9));
  other.add(command(8));
  other.back_to(late);
  other.add(command(5));
  CHECK(steps_of(log) == std::vector<std::int64_t>{1, 2, 9});
  CHECK(steps_of(other) == std::vector<std::int64_t>{1, 2, 3, 5});
  other.clear();
  CHECK(steps_of(other).empty());
}

TEST_CASE("a log of half a million marks is given back without running out of stack", "[sim]") {
  CommandLog log;
  for (int i = 0; i < 500'000; ++i) {
    log.add(command(i));
    log.mark();
  }
  CHECK(log.size() == 500'000);
  log.clear();
}
