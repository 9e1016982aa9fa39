#include "engine/base/late_library.h"

#include <catch2/catch.hpp>

#include "engine/base/error.h"

using namespace stampede;
using Catch::Contains;

TEST_CASE("a library is loaded when asked for, and what it lacks is said with the cure") {
  const LateLibrary mathematics("libm.so.6", "sums", "install libc6");
  double (*cosine)(double) = nullptr;
  mathematics.find("cos", cosine);
  CHECK(cosine(0) == 1);
  CHECK_THROWS_WITH(mathematics.find("no_such_function", cosine),
                    Contains("sums") && Contains("libm.so.6 has no no_such_function") && Contains("install libc6"));
  CHECK_THROWS_WITH(LateLibrary("libnothing.so.1", "films", "install libnothing"),
                    Contains("films") && Contains("libnothing.so.1") && Contains("install libnothing"));
}
