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

std::vector<EpisodeRecord> eight() {
  std::vector<EpisodeRecord> list;
  for (const char* task : {"lift", "close"})
    for (const char* variation : {"colour=red", "colour=blue"})
      for (const std::int64_t seed : {1, 2}) list.push_back(sample_episode(task, variation, seed));
  return list;
}

std::vector<EpisodeIdentity> identities(const std::vector<EpisodeRecord>& episodes) {
  std::vector<EpisodeIdentity> list;
  for (const EpisodeRecord& e : episodes) list.push_back({e.task, e.variation, e.seed, e.key});
  return list;
}

std::vector<std::string> stored_keys(const std::filesystem::path& path) {
  std::vector<std::string> keys;
  for (const EpisodeSummary& e : Catalogue::open(path).episodes()) keys.push_back(e.key);
  return keys;
}

CatalogueWriterOptions options(std::int64_t queue_bytes = 1'000'000'000) { return {kEngine, queue_bytes, {}}; }

}  // namespace

TEST_CASE("ids follow task, variation and seed whoever finishes first") {
  const Folder folder;
  std::vector<EpisodeRecord> episodes = eight();
  std::vector<EpisodeIdentity> sorted = identities(episodes);
  std::sort(sorted.begin(), sorted.end());
  std::vector<std::string> expected;
  for (const EpisodeIdentity& e : sorted) expected.push_back(e.key);
  REQUIRE(sorted.front().task == "close");
  std::string hash;
  for (int turn = 0; turn < 4; ++turn) {
    std::rotate(episodes.begin(), episodes.begin() + 3, episodes.end());
    const auto path = folder / (std::to_string(turn) + ".db");
    CatalogueWriter writer(path, options());
    CHECK(writer.expect(identities(episodes)) == sorted);
    std::vector<std::thread> workers;
    for (const EpisodeRecord& episode : episodes) workers.emplace_back([&] { writer.finished(episode); });
    for (std::thread& worker : workers) worker.join();
    writer.finish();
    CHECK(stored_keys(path) == expected);
    const std::string now = Catalogue::open(path).content_hash();
    if (turn > 0) CHECK(now == hash);
    hash = now;
  }
}

TEST_CASE("a full queue holds up all but the next in line") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  CatalogueWriter writer(folder / "a.db", options(1));  // one at a time
  const std::vector<EpisodeIdentity> order = writer.expect(identities(episodes));
  std::vector<std::thread> workers;
  for (auto identity = order.rbegin(); identity != order.rend(); ++identity)  // the last first: the worst order
    workers.emplace_back([&, key = identity->key] {
      writer.finished(*std::find_if(episodes.begin(), episodes.end(), [&](auto& e) { return e.key == key; }));
    });
  for (std::thread& worker : workers) worker.join();
  writer.finish();
  CHECK(stored_keys(folder / "a.db").size() == 8);
}

TEST_CASE("nobody waits for the abandoned; at the end gaps are stepped over") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  std::atomic<int> commits = 0;
  CatalogueWriterOptions chosen = options();
  chosen.committed = [&](std::int64_t, const EpisodeRecord&) { ++commits; };
  CatalogueWriter writer(folder / "a.db", chosen);
  const auto order = writer.expect(identities(episodes));
  const auto episode = [&](std::size_t i) {
    return *std::find_if(episodes.begin(), episodes.end(), [&](auto& e) { return e.key == order[i].key; });
  };
  writer.abandon(order[0].key);
  writer.finished(episode(1));
  while (commits < 1) std::this_thread::yield();  // 0 was abandoned: 1 is next
  writer.finished(episode(5));
  writer.finished(episode(3));  // 2 never comes
  EpisodeRecord interrupted = episode(4);
  interrupted.outcome = Outcome::failure, interrupted.reason = Reason::interrupted;
  writer.finished(interrupted);
  writer.finish();
  CHECK(commits == 3);
  CHECK(stored_keys(folder / "a.db") == std::vector<std::string>{order[1].key, order[3].key, order[5].key});
}

TEST_CASE("running again goes on where it stopped and ends with the same content") {
  const Folder folder;
  const std::vector<EpisodeRecord> episodes = eight();
  const auto run = [&](const std::string& name, int most) {
    CatalogueWriter writer(folder / name, options());
    const auto todo = writer.expect(identities(episodes));
    for (const EpisodeRecord& e : episodes)
      if (std::any_of(todo.begin(), todo.end(), [&](auto& i) { return i.key == e.key; }) && most-- > 0)
        writer.finished(e);
    writer.finish();
    return todo.size();
  };
  CHECK(run("whole.db", 8) == 8);
  CHECK(run("parts.db", 3) == 8);
  CHECK(run("parts.db", 8) == 5);
  CHECK(run("parts.db", 8) == 0);
  CHECK(stored_keys(folder / "parts.db").size() == 8);
  // Ids differ (the first run's come first), what they hold does not.
  CHECK(stored_keys(folder / "parts.db") != stored_keys(folder / "whole.db"));
  CHECK(Catalogue::open(folder / "parts.db").content_hash() == Catalogue::open(folder / "whole.db").content_hash());
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
  CHECK(plain == hash_of("b.db", [](EpisodeRecord& e) { e.wall_s = 99; }));
  CHECK(plain != hash_of("c.db", [](EpisodeRecord& e) { e.frames[4].joint_effort[1] *= 1 + 1e-15; }));
  CHECK(plain != hash_of("d.db", [](EpisodeRecord& e) { e.documents[0].text += " "; }));
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
  CHECK(last.keyframes == wanted.keyframes);
}
