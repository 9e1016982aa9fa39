#include "engine/base/random.h"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <set>
#include <vector>

using namespace stampede;

TEST_CASE("a key alone decides the numbers, every part of it") {
  const auto first = [](RandomKey key) { return Random(key).bits(); };
  CHECK(first(RandomKey("a").with(1).with("x")) == first(RandomKey("a").with(1).with("x")));
  const std::set<std::uint64_t> draws{first(RandomKey("a")),
                                      first(RandomKey("b")),
                                      first(RandomKey("a").with(0)),
                                      first(RandomKey("a").with(1)),
                                      first(RandomKey("a").with(-1)),
                                      first(RandomKey("a").with("1")),
                                      first(RandomKey("a").with("")),
                                      first(RandomKey("a").with(0).with(1)),
                                      first(RandomKey("a").with(1).with(0))};
  CHECK(draws.size() == 9);
}

TEST_CASE("a copy branches: both go on alike") {
  Random random(RandomKey("copy"));
  (void)random.bits();
  Random copy = random;
  CHECK(copy.bits() == random.bits());
}

TEST_CASE("uniform and normal have the moments they promise") {
  constexpr int n = 100000;
  Random random(RandomKey("moments"));
  double sum = 0, square = 0, normal_sum = 0, normal_square = 0;
  for (int i = 0; i < n; ++i) {
    const double u = random.uniform(), g = random.normal();
    REQUIRE((u >= 0 && u < 1));
    sum += u, square += u * u, normal_sum += g, normal_square += g * g;
  }
  // Five standard errors of each mean.
  CHECK(std::abs(sum / n - 0.5) < 5 * std::sqrt(1.0 / 12 / n));
  CHECK(std::abs(square / n - 1.0 / 3) < 5 * std::sqrt(4.0 / 45 / n));
  CHECK(std::abs(normal_sum / n) < 5 / std::sqrt(n));
  CHECK(std::abs(normal_square / n - 1) < 5 * std::sqrt(2.0 / n));
}

TEST_CASE("below(n) hits every number equally often") {
  Random random(RandomKey("below"));
  std::array<int, 7> counts{};
  for (int i = 0; i < 70000; ++i) ++counts.at(static_cast<std::size_t>(random.below(7)));
  for (const int count : counts) CHECK(std::abs(count - 10000) < 5 * std::sqrt(10000 * 6.0 / 7));
  CHECK(random.below(1) == 0);
}

TEST_CASE("every order of three is drawn equally often") {
  Random random(RandomKey("orders"));
  std::map<std::vector<int>, int> counts;
  for (int i = 0; i < 60000; ++i) {
    std::vector<int> values = {1, 2, 3};
    random.shuffle(values);
    ++counts[values];
  }
  CHECK(counts.size() == 6);
  for (const auto& [order, count] : counts) CHECK(std::abs(count - 10000) < 5 * std::sqrt(10000 * 5.0 / 6));
}
