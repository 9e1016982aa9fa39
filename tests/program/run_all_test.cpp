// Many episodes for programs: one order, one set of bytes, a sink of one's own, an end at any time.
#include <algorithm>
#include <atomic>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "engine/record/arrays.h"
#include "engine/record/record.h"
#include "scripting/session/session_core.h"
#include "tests/program/say.h"

namespace stampede::program {
namespace {

std::shared_ptr<SessionCore> many_session(const std::string& catalogue = {}) {
  return std::make_shared<SessionCore>(STAMPEDE_SOURCE_DIR, std::vector<std::filesystem::path>{}, catalogue);
}

RunRequest two_tasks() { return {.tasks = {"reach_target", "close_drawer"}, .episodes = 3, .each = {.seed = 5}}; }

std::string stored_text(SessionCore& session) {
  std::string text;
  for (const auto& row : session.query("SELECT id, key, task, variation, seed FROM episode ORDER BY id").rows)
    for (const SqlValue& value : row)
      std::visit(
          [&](const auto& one) {
            using Value = std::decay_t<decltype(one)>;
            if constexpr (std::is_same_v<Value, std::string>) text += one + " ";
            if constexpr (std::is_same_v<Value, std::int64_t>) text += std::to_string(one) + " ";
          },
          value);
  return text;
}

std::int64_t stored_count(SessionCore& session) {
  return session.query("SELECT count(*) AS n FROM episodes").integer(0, "n");
}

}  // namespace

TEST_CASE("many episodes of a session are those of `run`, and several workers write the same bytes in the same order") {
  const Folder folder;
  std::vector<std::string> hashes, texts;
  for (const int workers : {1, 3}) {
    const std::string file = folder / (std::to_string(workers) + ".db");
    const auto session = many_session(file);
    RunRequest request = two_tasks();
    request.workers = workers;
    std::vector<std::int64_t> told;
    request.progress = [&](const RunProgress& now) {
      told.push_back(now.done);
      CHECK(now.total == 6);
      CHECK(now.episode.id == now.done);
      CHECK_FALSE(now.episode.record);
      CHECK(stored_count(*session) == now.done);  // it has been kept, and the session may be asked
    };
    const RunTally tally = session->run_all(request);
    CHECK(told == std::vector<std::int64_t>{1, 2, 3, 4, 5, 6});
    CHECK(tally.total == 6);
    CHECK(tally.finished == 6);
    CHECK_FALSE(tally.interrupted);
    CHECK(tally.tasks.at("reach_target").episodes == 3);
    hashes.push_back(Catalogue::open(file).content_hash());
    texts.push_back(stored_text(*session));

    // The same again, one by one or all at once, runs nothing.
    const RunTally again = session->run_all(request);
    CHECK(again.existing == 6);
    CHECK(again.finished == 0);
    const Rows last = session->query("SELECT variation, seed FROM episodes WHERE episode = 6");
    CHECK(session->run("reach_target", {.variation = last.text(0, "variation"), .seed = last.integer(0, "seed")}).id ==
          6);
  }
  CHECK(hashes[0] == hashes[1]);
  CHECK(texts[0] == texts[1]);
  REQUIRE(say({"run", "reach_target", "close_drawer", "--root", kRoot, "--episodes", "3", "--seed", "5", "--out",
               folder / "program.db"})
              .code == kDone);
  CHECK(Catalogue::open(folder / "program.db").content_hash() == hashes[0]);
}

TEST_CASE("what the scenes of a task have in common is stored once, wherever their arms begin") {
  const Folder folder;
  const auto session = many_session(folder / "a.db");
  RunRequest request{.tasks = {"reach_target"}};
  const auto shared_bytes = [&](int episodes) {
    request.episodes = episodes;
    session->run_all(request);
    const Catalogue catalogue = Catalogue::open(folder / "a.db");
    CHECK(catalogue.query("SELECT 1 FROM scene WHERE length(document) > 20000").rows.empty());
    return catalogue.query("SELECT sum(length(body)) AS bytes FROM asset").integer(0, "bytes");
  };
  const std::int64_t first = shared_bytes(1);
  CHECK(shared_bytes(6) < first + 2000);  // targets of other colours
}

TEST_CASE("shards that programs make are together what one run makes") {
  const Folder folder;
  const auto whole = many_session(folder / "whole.db");
  whole->run_all(two_tasks());
  const auto parts = many_session(folder / "parts.db");
  for (std::int64_t part = 1; part <= 4; ++part) {
    RunRequest request = two_tasks();
    request.shard = {part, 4};
    CHECK(parts->run_all(request).finished == (part <= 2 ? 2 : 1));
  }
  CHECK(Catalogue::open(folder / "parts.db").content_hash() == Catalogue::open(folder / "whole.db").content_hash());
  RunRequest wrong = two_tasks();
  wrong.shard = {5, 4};
  CHECK_THROWS_WITH(parts->run_all(wrong), Catch::Contains("there is no part 5/4"));
}

TEST_CASE("a sink gets every episode in order with all that happened, and no catalogue appears") {
  const Folder folder;
  for (const bool named : {false, true}) {  // a catalogue that the session has is left alone too
    std::vector<std::string> keys;
    std::weak_ptr<const EpisodeRecord> last;
    const auto session = many_session(named ? folder / "never.db" : std::string());
    RunRequest request = two_tasks();
    request.workers = 2;
    request.sink = [&](const Episode& episode) {
      CHECK(last.expired());
      last = episode.record;
      CHECK(episode.id == 0);
      CHECK(session->arrays(episode, {{"joint_positions"}}).frames == episode.frames);
      keys.push_back(episode.task + " " + episode.variation + " " + std::to_string(episode.seed));
    };
    CHECK(session->run_all(request).finished == 6);
    CHECK(keys.size() == 6);
    CHECK(std::is_sorted(keys.begin(), keys.end()));
    CHECK(last.expired());
  }
  CHECK(std::filesystem::is_empty(folder.text()));
  CHECK_THROWS_WITH(many_session()->run_all(two_tasks()), Catch::Contains("nobody would keep the episodes"));
}

TEST_CASE("a run that is stopped keeps what is finished, says so, and goes on later") {
  const Folder folder;
  const auto session = many_session(folder / "d.db");
  std::atomic<bool> stop = false;
  RunRequest request{.tasks = {"reach_target"}, .episodes = 12, .workers = 2, .stop = &stop};
  request.progress = [&](const RunProgress& now) { stop = now.done >= 2; };
  const RunTally tally = session->run_all(request);
  CHECK(tally.interrupted);
  CHECK(tally.finished >= 2);
  CHECK(tally.finished < 12);
  CHECK(stored_count(*session) == tally.finished);
  stop = false;
  request.progress = {};
  const RunTally rest = session->run_all(request);
  CHECK_FALSE(rest.interrupted);
  CHECK(rest.existing == tally.finished);
  CHECK(rest.done() == 12);

  stop = true;  // before anything has begun
  request.each.seed = 100;
  CHECK(session->run_all(request).interrupted);
  CHECK(stored_count(*session) == 12);
}

TEST_CASE("what a callback throws ends the run and reaches its caller, what is finished is kept") {
  const Folder folder;
  const auto session = many_session(folder / "d.db");
  RunRequest request{.tasks = {"reach_target"}, .episodes = 12, .workers = 2};
  int told = 0;
  request.progress = [&](const RunProgress&) {
    if (++told == 2) throw std::runtime_error("enough");
  };
  CHECK_THROWS_WITH(session->run_all(request), "enough");
  CHECK(told == 2);
  CHECK(stored_count(*session) >= 2);
  CHECK(stored_count(*session) < 12);

  int got = 0;
  request.progress = {};
  request.sink = [&](const Episode&) {
    if (++got == 2) throw 7;  // not even an exception of the standard's
  };
  CHECK_THROWS_AS(session->run_all(request), int);
  CHECK(got == 2);
  request.episodes = 1;  // the last one, when nothing is left to be finished
  request.sink = [&](const Episode&) { throw std::runtime_error("disk full"); };
  CHECK_THROWS_WITH(session->run_all(request), "disk full");
}

TEST_CASE("a run that cannot be is an error before anything runs") {
  const auto session = many_session();
  const auto sink = [](const Episode&) { FAIL("nothing was to run"); };
  const auto with = [&](RunRequest request) {
    request.sink = sink;
    return session->run_all(request);
  };
  CHECK_THROWS_WITH(with({.tasks = {"reach_targt"}}), Catch::Contains("did you mean 'reach_target'"));
  CHECK_THROWS_WITH(with({}), Catch::Contains("no task is named"));
  CHECK_THROWS_WITH(with({.tasks = {"reach_target"}, .episodes = 0}), Catch::Contains("RunRequest::episodes"));
  CHECK_THROWS_WITH(with({.tasks = {"reach_target"}, .workers = 0}), Catch::Contains("RunRequest::workers"));
  CHECK_THROWS_WITH(with({.tasks = {"reach_target"}, .each = {.variation = "colour=plaid"}}),
                    Catch::Contains("no variation"));
  CHECK_THROWS_WITH(with({.tasks = {"reach_target"}, .each = {.seed = 999'999, .set = {"fly.height=1"}}}),
                    Catch::Contains("fly"));
  CHECK_THROWS_WITH(with({.tasks = {"reach_target"}, .episodes = 2, .each = {.seed = 999'999}}),
                    Catch::Contains("test split"));
}

}  // namespace stampede::program
