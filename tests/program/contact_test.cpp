// The same bytes for any number of workers where it is hardest: tasks that push, press, slide and stack.
#include <catch2/catch.hpp>

#include "db/catalogue.h"
#include "tests/program/say.h"

namespace stampede::program {

TEST_CASE("one, two and four workers write the same of tasks full of contacts") {
  const Folder folder;
  std::vector<std::string> hashes;
  for (const char* workers : {"1", "2", "4"}) {
    const std::string out = folder / (std::string(workers) + ".db");
    const Said said =
        say({"run", "slide_block_to_target", "push_buttons", "close_drawer", "put_item_in_drawer", "stack_blocks",
             "--episodes", "2", "--seed", "23", "--workers", workers, "--root", STAMPEDE_SOURCE_DIR, "--out", out});
    INFO(said.out << said.err);
    REQUIRE(said.code == kDone);
    hashes.push_back(Catalogue::open(out).content_hash());
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(hashes[0] == hashes[2]);
}

}  // namespace stampede::program
