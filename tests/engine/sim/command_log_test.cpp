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

TEST_CASE("copies of a log share what was before and part from there", "[sim]") {
  CommandLog log;
  CHECK(steps_of(log).empty());
  log.add(command(1));
  log.add(command(2));
  log.mark();
  CommandLog early = log;
  log.add(command(3));
  log.mark();
  const CommandLog late = log;
  log.add(command(4));
  early.add(command(9));
  CHECK(steps_of(log) == std::vector<std::int64_t>{1, 2, 3, 4});
  CHECK(steps_of(late) == std::vector<std::int64_t>{1, 2, 3});
  CHECK(steps_of(early) == std::vector<std::int64_t>{1, 2, 9});
  early = late;
  early.add(command(5));
  early.mark();
  early.mark();  // nothing was added
  CHECK(steps_of(early) == std::vector<std::int64_t>{1, 2, 3, 5});
  CHECK(steps_of(late) == std::vector<std::int64_t>{1, 2, 3});
}

TEST_CASE("a log of half a million marks is given back without running out of stack", "[sim]") {
  CommandLog log;
  for (int i = 0; i < 500'000; ++i) {
    log.add(command(i));
    log.mark();
  }
  const CommandLog kept = log;
  log = {};
  CHECK(kept.size() == 500'000);
}
