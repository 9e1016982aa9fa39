#include "engine/base/temporary_folder.h"

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>

#include "engine/base/error.h"

namespace stampede {
namespace fs = std::filesystem;

TEST_CASE("a temporary folder goes with what is in it, and no two are one") {
  fs::path path;
  {
    const TemporaryFolder folder, other;
    path = folder.path();
    CHECK(path != other.path());
    std::ofstream(path / "a.txt") << "a";
    CHECK(fs::exists(path / "a.txt"));
  }
  CHECK_FALSE(fs::exists(path));
}

TEST_CASE("where no temporary folder can be made, TMPDIR is named") {
  const char* found = std::getenv("TMPDIR");
  const std::string before = found == nullptr ? "/tmp" : found;
  setenv("TMPDIR", "/dev/null", 1);
  CHECK_THROWS_WITH(TemporaryFolder(), Catch::Contains("/dev/null") && Catch::Contains("set TMPDIR"));
  setenv("TMPDIR", before.c_str(), 1);
}

}  // namespace stampede
