#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <thread>

#include "db/catalogue_writer.h"
#include "sample_episode.h"

using namespace stampede;
using namespace stampede::test;

namespace {

// In the order of their places: task, variation, seed.
std::vector<EpisodeRecord> eight() {
  std::vector<EpisodeRecord> list;
  for (const char* task : {"close", "lift"})
    for (const char* variation : {"colour=blue", "colour=red"})
      for (const std::int64_t seed : {1, 2}) list.push_back(sample_episode(task, variation, seed));
  return list;
}

std::vector<std::string> keys_of(const std::vector<EpisodeRecord>& episodes) {
  std::vector<std::string> keys;
  for (const EpisodeRecord& e : episodes) keys.push_back(e.made.key);
  return keys;
}

std::vector<std::string> stored_keys(const std::filesystem::path& path) {
  std::vector<std::string> keys;
  for (const EpisodeSummary& e : Catalogue::open(path).episodes()) keys.push_back(e.key);
  return keys;
}

CatalogueWriterOptions options(std::int64_t queue_bytes = 1'000'000'000) { return {kEngine, queue_bytes, {}}; }

}  // namespace

TEST_CASE("ids follow the places whoever finishes first") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  std::vector<std::int64_t> order = {0, 1, 2, 3, 4, 5, 6, 7};
  std::string hash;
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(order.begin(), order.begin() + 3, order.end());
    const auto path = folder / (std::to_string(turn) + ".db");
    CatalogueWriter writer(path, options());
    std::vector<std::thread> workers;
    for (const std::int64_t place : order)
      workers.emplace_back([&, place] { writer.finished(place, episodes[static_cast<std::size_t>(place)]); });
    for (std::thread& worker : workers) worker.join();
    writer.finish();
    CHECK(stored_keys(path) == keys_of(episodes));
    const std::string now = Catalogue::open(path).content_hash();
    if (turn > 0) CHECK(now == hash);
    hash = now;
  }
}

TEST_CASE("a full queue holds up all but the next in line") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  CatalogueWriter writer(folder / "a.db", options(1));  // one at a time
  std::vector<std::thread> workers;
  for (std::int64_t place = 7; place >= 0; --place)  // the last first: the worst order
    workers.emplace_back([&, place] { writer.finished(place, episodes[static_cast<std::size_t>(place)]); });
  for (std::thread& worker : workers) worker.join();
  writer.finish();
  CHECK(stored_keys(folder / "a.db") == keys_of(episodes));
}

TEST_CASE("a queue of no bytes: what was handed over is stored") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  std::atomic<int> commits = 0;
  CatalogueWriterOptions chosen = options(0);
  chosen.committed = [&](std::int64_t, const EpisodeRecord&) { ++commits; };
  CatalogueWriter writer(folder / "a.db", chosen);
  for (int place = 0; place < 8; ++place) {
    writer.finished(place, episodes[static_cast<std::size_t>(place)]);
    CHECK(commits == place + 1);
  }
  writer.finish();
  CHECK(stored_keys(folder / "a.db") == keys_of(episodes));
}

TEST_CASE("nobody waits for the abandoned, at the end gaps are stepped over") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  std::atomic<int> commits = 0;
  CatalogueWriterOptions chosen = options();
  chosen.committed = [&](std::int64_t, const EpisodeRecord&) { ++commits; };
  CatalogueWriter writer(folder / "a.db", chosen);
  writer.abandon(0);
  writer.finished(1, episodes[1]);
  while (commits < 1) std::this_thread::yield();  // 0 was abandoned: 1 is next
  writer.finished(5, episodes[5]);
  writer.finished(3, episodes[3]);  // 2 never comes
  EpisodeRecord interrupted = episodes[4];
  interrupted.outcome = Outcome::failure, interrupted.reason = Reason::interrupted;
  writer.finished(4, interrupted);
  writer.finish();
  CHECK(commits == 3);
  CHECK(stored_keys(folder / "a.db") ==
        std::vector<std::string>{episodes[1].made.key, episodes[3].made.key, episodes[5].made.key});
}

TEST_CASE("running again goes on where it stopped and ends with the same content") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  const auto run = [&](const std::string& name, int most) {
    CatalogueWriter writer(folder / name, options());
    const bool part = most < 8;
    int fresh = 0;
    for (std::size_t i = 0; i < episodes.size(); ++i) {
      const auto place = static_cast<std::int64_t>(i);
      const bool there = writer.has(episodes[i].made.key);
      fresh += there ? 0 : 1;
      // The later half first, so that ids differ from those of one run.
      if (there || most == 0 || (part && i < 4)) {
        writer.abandon(place);
      } else {
        --most;
        writer.finished(place, episodes[i]);
      }
    }
    writer.finish();
    return fresh;
  };
  CHECK(run("whole.db", 8) == 8);
  CHECK(run("parts.db", 3) == 8);
  CHECK(run("parts.db", 8) == 5);
  CHECK(run("parts.db", 8) == 0);
  CHECK(stored_keys(folder / "parts.db").size() == 8);
  CHECK(stored_keys(folder / "parts.db") != stored_keys(folder / "whole.db"));
  CHECK(Catalogue::open(folder / "parts.db").content_hash() == Catalogue::open(folder / "whole.db").content_hash());
}

TEST_CASE("an episode that is stored already is not stored twice, and nobody waits for it") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  CatalogueWriter writer(folder / "a.db", options());
  writer.finished(0, episodes[0]);
  writer.finished(1, episodes[0]);
  writer.finished(2, episodes[1]);
  writer.finish();
  CHECK(stored_keys(folder / "a.db") == std::vector<std::string>{episodes[0].made.key, episodes[1].made.key});
}

TEST_CASE("the content hash sees every value but wall times") {
  const Folder folder;
  const auto hash_of = [&](const std::string& name, auto change) {
    EpisodeRecord e = sample_episode("lift", "colour=red", 1);
    change(e);
    Catalogue catalogue = Catalogue::write(folder / name);
    catalogue.add(e, kEngine);
    return catalogue.content_hash();
  };
  const std::string plain = hash_of("a.db", [](EpisodeRecord&) {});
  CHECK(plain == hash_of("b.db", [](EpisodeRecord& e) { e.made.wall_s = 99; }));
  CHECK(plain != hash_of("c.db", [](EpisodeRecord& e) { e.frames[4].joint_effort[1] *= 1 + 1e-15; }));
  CHECK(plain != hash_of("d.db", [](EpisodeRecord& e) { e.labels.documents[0].text += " "; }));
  CHECK(plain != hash_of("e.db", [](EpisodeRecord& e) { e.commands.pop_back(); }));
}

TEST_CASE("a killed run leaves whole episodes only") {
  const Folder folder;
  const auto path = folder / "a.db";
  const std::vector<EpisodeRecord> episodes = eight();
  const pid_t child = ::fork();
  if (child == 0) {
    Catalogue catalogue = Catalogue::write(path);
    catalogue.add(episodes[0], kEngine);
    catalogue.add(episodes[1], kEngine);
    for (int seed = 100;; ++seed) {
      if (seed == 140) ::kill(::getpid(), SIGKILL);
      catalogue.add(sample_episode("lift", "colour=red", seed), kEngine);
    }
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  REQUIRE(WIFSIGNALED(status));
  CHECK(Catalogue::open(path).episodes().size() == 42);
  Catalogue::write(path).close();  // takes the log in
  CHECK_FALSE(std::filesystem::exists(path.string() + "-wal"));
  Catalogue catalogue = Catalogue::open(path);
  CHECK(catalogue.read_episode(2).frames.size() == episodes[1].frames.size());
}

TEST_CASE("a file that others read is written beside them, and they see the end") {
  const Folder folder;
  const auto path = folder / "a.db";
  Catalogue held = Catalogue::write(path);
  held.add(sample_episode("lift", "colour=red", 0), kEngine);
  Catalogue catalogue = Catalogue::write(path, Journal::in_place);
  catalogue.add(sample_episode("lift", "colour=red", 1), kEngine);
  CHECK(held.episodes().size() == 2);
  held.add(sample_episode("lift", "colour=red", 2), kEngine);
  CHECK(catalogue.episodes().size() == 3);
}

TEST_CASE("a key that is known last is the episode's, and one that is there already changes nothing") {
  const Folder folder;
  Catalogue catalogue = Catalogue::write(folder / "a.db");
  EpisodeRecord e = sample_episode("lift", "colour=red", 0);
  const std::string key = e.made.key;
  e.made.key = "not yet";
  CHECK(catalogue.add_if_new(e, kEngine, [&] { return key; }) == 1);
  CHECK(catalogue.find(key) == 1);
  CHECK_FALSE(catalogue.find("not yet"));
  const std::string before = catalogue.content_hash();
  CHECK_FALSE(catalogue.add_if_new(e, kEngine, [&] { return key; }));
  CHECK_THROWS_WITH(catalogue.add_if_new(e, kEngine, []() -> std::string { throw std::runtime_error("no"); }), "no");
  CHECK(catalogue.content_hash() == before);
}

TEST_CASE("killed at any moment, what is there is whole") {
  const Folder folder;
  const auto path = folder / "a.db";
  const pid_t child = ::fork();
  if (child == 0) {
    Catalogue catalogue = Catalogue::write(path);
    for (int seed = 0;; ++seed) catalogue.add(sample_episode("lift", "colour=red", seed, {120, 15, 10}), kEngine);
  }
  while (!std::filesystem::exists(path.string() + "-wal") ||
         std::filesystem::file_size(path.string() + "-wal") < 2'000'000)
    ::usleep(1000);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
  Catalogue catalogue = Catalogue::write(path);
  const auto list = catalogue.episodes();
  REQUIRE(!list.empty());
  CHECK(list.back().id == static_cast<std::int64_t>(list.size()));
  const EpisodeRecord last = catalogue.read_episode(list.back().id);
  const EpisodeRecord wanted = sample_episode("lift", "colour=red", last.seed, {120, 15, 10});
  CHECK(last.frames.back().joint_position == wanted.frames.back().joint_position);
  CHECK(last.commands.size() == wanted.commands.size());
  CHECK(last.labels.keyframes == wanted.labels.keyframes);
}
