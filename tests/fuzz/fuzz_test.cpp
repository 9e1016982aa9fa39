// What fuzzers found, and what they begin with; `.ci/soak fuzz` goes on from there for hours.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "engine/base/random.h"
#include "tests/fuzz/targets.h"

using namespace stampede::fuzz;
using stampede::Random;
using stampede::RandomKey;
namespace fs = std::filesystem;

namespace {

// Bytes turned, cut out, doubled, and numbers made extreme: what a reader meets in a file that nobody vouches for.
std::string mutated(std::string bytes, Random& random) {
  static const std::vector<std::string> extremes = {"-1",  "0", "4294967295", "2147483648", "1e30",
                                                    "nan", "",  "<",          "\"",         "{"};
  const auto below = [&](std::size_t end) {
    return static_cast<std::size_t>(random.below(static_cast<std::int64_t>(end)));
  };
  for (std::size_t times = 1 + below(4); times > 0 && !bytes.empty(); --times) {
    const std::size_t at = below(bytes.size()), size = 1 + below(std::min<std::size_t>(bytes.size() - at, 40));
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(below(256));
        break;
      case 1:
        bytes.erase(at, size);
        break;
      case 2:
        bytes.insert(below(bytes.size()), bytes.substr(at, size));
        break;
      case 3:
        bytes.insert(at, std::string(4, static_cast<char>(below(2) == 0 ? 255 : 0)));
        break;
      default: {
        const std::size_t digit = bytes.find_first_of("0123456789", at);
        const std::size_t end = bytes.find_first_not_of("0123456789.", digit);
        if (digit != std::string::npos)
          bytes.replace(digit, std::min(end, bytes.size()) - digit, extremes[below(extremes.size())]);
      }
    }
  }
  return bytes;
}

}  // namespace

// STAMPEDE_MUTATIONS: how many of each input, where this is to go on for longer; STAMPEDE_MUTATED: of which kind of
// file.
TEST_CASE("files that were changed at random are read or refused") {
  const char *const asked = std::getenv("STAMPEDE_MUTATIONS"), *const kind = std::getenv("STAMPEDE_MUTATED");
  const int count = asked == nullptr ? 40 : std::atoi(asked);
  for (const std::string name :
       {"urdf", "obj", "ply", "stl", "dae", "gltf", "glb", "png", "answers", "calibration", "scene", "pddl", "bddl"}) {
    if (kind != nullptr && name != kind) continue;
    int read = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(STAMPEDE_SOURCE_DIR) / "tests/fuzz/inputs" / name)) {
      std::ifstream in(entry.path(), std::ios::binary);
      const std::string bytes(std::istreambuf_iterator<char>(in), {});
      for (int i = 0; i < count; ++i, ++read) {
        Random random(RandomKey("mutate").with(entry.path().filename().string()).with(i));
        const std::string changed = mutated(bytes, random);
        INFO(entry.path().string() << " " << i);
        REQUIRE_NOTHROW(target(name).read(changed));
      }
    }
    CHECK(read >= count);
  }
}

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

TEST_CASE("no schema of a catalogue runs, whatever it says") {
  const char* asked = std::getenv("STAMPEDE_SCHEMAS");  // how many; `.ci/soak schema` asks for a million
  const std::int64_t count = asked ? std::atoll(asked) : 60;
  const Target& schema = target("schema");
  const char* from = std::getenv("STAMPEDE_FIRST_SCHEMA");  // to see one again that was told
  for (std::int64_t i = from ? std::atoll(from) : 0; i < count; ++i) {
    Random random(RandomKey("schema").with(i));
    std::string bytes(static_cast<std::size_t>(6 + random.below(40)), '\0');
    for (char& byte : bytes) byte = static_cast<char>(random.below(256));
    INFO("schema " << i);
    REQUIRE_NOTHROW(schema.read(bytes));
  }
}
