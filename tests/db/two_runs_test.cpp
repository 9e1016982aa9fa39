// Two programs that write to one file.
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <functional>

#include "db/catalogue_writer.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

// Both at once, each in a process of its own; whether both ended well.
bool together(const std::function<void()>& one, const std::function<void()>& other) {
  std::vector<pid_t> children;
  for (const auto* work : {&one, &other}) {
    const pid_t child = ::fork();
    if (child == 0) {
      try {
        (*work)();
      } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        ::_exit(1);
      }
      ::_exit(0);
    }
    children.push_back(child);
  }
  bool good = true;
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    good = good && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }
  return good;
}

void run_all(const std::filesystem::path& path, int episodes) {
  CatalogueWriter writer(path, {kEngine, 1'000'000, {}});
  for (int seed = 0; seed < episodes; ++seed) {
    const EpisodeRecord episode = sample_episode("lift", "colour=red", seed);
    if (writer.has(episode.made.key)) {
      writer.abandon(seed);
    } else {
      writer.finished(seed, episode);
    }
  }
  writer.finish();
}

}  // namespace

TEST_CASE("two runs make one new file at once") {
  for (int round = 0; round < 10; ++round) {
    const Folder folder;
    const auto open = [&] { Catalogue::write(folder / "a.db"); };
    REQUIRE(together(open, open));
    CHECK_NOTHROW(Catalogue::open(folder / "a.db").query("SELECT * FROM transitions"));
  }
}

TEST_CASE("two runs of the same work share it: each episode is stored once, and nobody stops") {
  const Folder folder;
  run_all(folder / "alone.db", 20);
  for (int round = 0; round < 3; ++round) {
    const auto path = folder / ("both" + std::to_string(round) + ".db");
    REQUIRE(together([&] { run_all(path, 20); }, [&] { run_all(path, 20); }));
    CHECK(Catalogue::open(path).content_hash() == Catalogue::open(folder / "alone.db").content_hash());
  }
}

TEST_CASE("a run learns what another one has stored") {
  const Folder folder;
  CatalogueWriter first(folder / "a.db", {kEngine, 1'000'000, {}}), second(folder / "a.db", {kEngine, 1'000'000, {}});
  const EpisodeRecord shared = sample_episode("lift", "colour=red", 1), own = sample_episode("lift", "colour=red", 2);
  first.finished(0, shared);
  first.finish();
  CHECK(!second.has(shared.made.key));  // not asked yet
  second.finished(0, own);
  second.finished(1, shared);  // leaves no trace, and is no error
  second.finish();
  CHECK(second.has(shared.made.key));
  CHECK(Catalogue::open(folder / "a.db").episodes().size() == 2);
}
