// What fuzzers found, and what they begin with; `.ci/soak fuzz` goes on from there for hours.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "tests/fuzz/targets.h"

using namespace stampede::fuzz;
namespace fs = std::filesystem;

TEST_CASE("each reader survives sound files, cut ones, and those that once did harm") {
  for (const Target& target : targets()) {
    std::size_t read = 0;
    for (const auto& entry :
         fs::directory_iterator(fs::path(STAMPEDE_SOURCE_DIR) / "tests/fuzz/inputs" / target.name)) {
      INFO(entry.path().string());
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(in), {});
      CHECK_NOTHROW(target.read(bytes));
      for (const std::size_t part : {1, 5, 9}) CHECK_NOTHROW(target.read(bytes.substr(0, bytes.size() * part / 10)));
      ++read;
    }
    INFO(target.name);
    CHECK(read > 0);
  }
}
