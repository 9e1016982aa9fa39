// A few mutants of each kind of file; .ci/soak tries them for hours.
#include <catch2/catch.hpp>

#include "tests/fuzz/mutate.h"

using namespace stampede;
using namespace stampede::fuzz;

TEST_CASE("each reader survives sound files, and files that are nearly so") {
  for (const Target& target : targets()) {
    INFO(target.name);
    REQUIRE_FALSE(target.seeds.empty());
    for (const std::string& seed : target.seeds) CHECK_NOTHROW(target.read(seed));
    Random random(RandomKey("fuzz").with(target.name));
    const int count = target.name == "ply" || target.name == "obj" || target.name == "lua" ? 20 : 100;
    for (int i = 0; i < count; ++i) {
      const auto any = [&] {
        return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(target.seeds.size())));
      };
      const std::string bytes = mutated(target.seeds[any()], target.seeds[any()], target.words, random);
      INFO("mutant " << i);
      CHECK_NOTHROW(target.read(bytes));
    }
  }
}

TEST_CASE("mutants are repeatable, and differ") {
  Random one(RandomKey("a")), same(RandomKey("a")), other(RandomKey("b"));
  const std::string bytes(200, 'x');
  const std::string first = mutated(bytes, bytes, {"word"}, one);
  CHECK(first == mutated(bytes, bytes, {"word"}, same));
  CHECK(first != mutated(bytes, bytes, {"word"}, other));
}
