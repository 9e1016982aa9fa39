#include "engine/base/ordered_work.h"

#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <string>

namespace stampede {
namespace {

// The later a piece of work, the sooner it is done: everyone but the first is ahead of its turn.
int slow_square(std::size_t i) {
  std::this_thread::sleep_for(std::chrono::microseconds(200 * (20 - i)));
  return static_cast<int>(i * i);
}

}  // namespace

TEST_CASE("results are taken in order and one at a time, whoever is first") {
  for (const int workers : {1, 2, 5, 50}) {
    std::vector<int> taken;
    std::atomic<int> started = 0;
    in_order(
        20, {workers}, [&] { return ++started; }, [](int, std::size_t i) { return slow_square(i); },
        [&](std::size_t i, int square) {
          CHECK(i == taken.size());
          taken.push_back(square);
        });
    REQUIRE(taken.size() == 20);
    for (std::size_t i = 0; i < 20; ++i) CHECK(taken[i] == static_cast<int>(i * i));
    CHECK(started == std::min(workers, 20));
  }
}

TEST_CASE("what is thrown first comes out, whoever waits for a turn that never comes") {
  for (const int workers : {1, 3}) {
    std::size_t taken = 0;
    const auto start = [] { return 0; };
    const auto count = [&](std::size_t, int) { ++taken; };
    const auto make = [](int, std::size_t i) {
      if (i == 3) throw std::runtime_error("three");
      return slow_square(i);
    };
    CHECK_THROWS_WITH(in_order(20, {workers}, start, make, count), "three");
    CHECK(taken <= 3);
    const auto refuse = [](std::size_t i, int) {
      if (i == 2) throw std::runtime_error("two");
    };
    CHECK_THROWS_WITH(in_order(
                          20, {workers}, start, [](int, std::size_t i) { return slow_square(i); }, refuse),
                      "two");
    const auto fail = []() -> int { throw std::runtime_error("no worker"); };
    CHECK_THROWS_WITH(in_order(
                          20, {workers}, fail, [](int, std::size_t i) { return slow_square(i); }, count),
                      "no worker");
  }
}

TEST_CASE("of two that throw the first in order comes out, though the other was sooner") {
  for (const int workers : {1, 2, 5}) {
    std::size_t taken = 0;
    const auto make = [](int, std::size_t i) {
      if (i == 3 || i == 4) {
        slow_square(i == 3 ? 0 : 19);
        throw std::runtime_error(std::to_string(i));
      }
      return static_cast<int>(i);
    };
    CHECK_THROWS_WITH(in_order(
                          20, {workers}, [] { return 0; }, make, [&](std::size_t, int) { ++taken; }),
                      "3");
    CHECK(taken == 3);
  }
}

TEST_CASE("the stop of the thread that calls reaches all of the crew, and is thrown") {
  std::atomic<bool> stop = false;
  const StopScope scope(&stop);
  std::size_t taken = 0;
  const auto run = [&] {
    in_order(
        20, {3}, [] { return 0; },
        [](int, std::size_t i) {
          heed_stop();
          return i;
        },
        [&](std::size_t i, std::size_t) {
          ++taken;
          stop = i == 4;
        });
  };
  CHECK_THROWS_AS(run(), Interrupted);
  CHECK(taken == 5);
}

TEST_CASE("a stop ends it between two results, and nothing is taken after it") {
  std::atomic<bool> stop = false;
  std::vector<std::size_t> taken;
  in_order(
      20, {3, &stop}, [] { return 0; }, [](int, std::size_t i) { return slow_square(i); },
      [&](std::size_t i, int) {
        taken.push_back(i);
        stop = i == 4;
      });
  CHECK(taken == std::vector<std::size_t>{0, 1, 2, 3, 4});
  in_order(
      0, {3}, [] { return 0; }, [](int, std::size_t) { return 0; }, [](std::size_t, int) { FAIL("no work"); });
}

}  // namespace stampede
