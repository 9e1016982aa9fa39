// Motions that authors asked for: several grips, a search with a peg, pieces in a skill of their own.
#include <catch2/catch.hpp>

#include "tests/tasks/run_task.h"

using namespace stampede;
using namespace stampede::test;

namespace {

EpisodeRecord run_authored(const std::string& task, const std::string& variation, std::uint64_t seed) {
  RunOptions options;
  options.seed = seed;
  options.on_failure = OnFailure::stop;
  return run_task(task, variation, options, authors());
}

int motions_of(const EpisodeRecord& episode, const std::string& kind) {
  return static_cast<int>(
      std::count_if(episode.labels.segments.begin(), episode.labels.segments.end(),
                    [&](const auto& segment) { return segment.kind == SegmentKind::motion && segment.skill == kind; }));
}

}  // namespace

TEST_CASE("a valve of one and a half turns is turned by the library's own skill, with as many grips as it needs") {
  for (const std::uint64_t seed : {3, 4}) {
    const EpisodeRecord episode = run_authored("open_the_valve", "", seed);
    INFO(verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    CHECK(skills_of(episode) == std::vector<std::string>{"turn valve.wheel"});
    CHECK(motions_of(episode, "move_part") >= 2);
    CHECK(motions_of(episode, "move_part") <= 4);
    CHECK(replay_episode(episode) == "");
  }
}

TEST_CASE("a door that one grip does not open far enough is opened with several") {
  for (const std::uint64_t seed : {5, 7, 10}) {
    const EpisodeRecord episode = run_authored("open_the_wide_door", "", seed);
    INFO(verdict(episode));
    CHECK(episode.outcome == Outcome::success);
    CHECK(motions_of(episode, "move_part") > 1);
  }
}

TEST_CASE("a held rod that is taken to a place 4 mm beside its hole finds it where the slot says that it may search") {
  int with = 0, without = 0;
  for (std::uint64_t seed = 3; seed < 8; ++seed) {
    const EpisodeRecord searched = run_authored("rod_in_socket", "hole=searched", seed);
    with += searched.outcome == Outcome::success ? 1 : 0;
    if (seed == 3) CHECK(replay_episode(searched) == "");
    without += run_authored("rod_in_socket", "hole=plain", seed).outcome == Outcome::success ? 1 : 0;
  }
  CHECK(with == 5);
  CHECK(without <= 2);  // a hand that pushes hard enough now and then turns the rod in
}

TEST_CASE("a hand lets go on its way, and what it lets go falls where it was let go") {
  const EpisodeRecord episode = run_authored("drop_on_the_way", "", 3);
  INFO(verdict(episode));
  REQUIRE(episode.outcome == Outcome::success);
  CHECK(motions_of(episode, "open_hand") == 1);  // before it was picked up
  CHECK(motions_of(episode, "follow") == 1);
  const auto over = std::find_if(episode.labels.vias.begin(), episode.labels.vias.end(),
                                 [](const auto& via) { return via.name == "over"; });
  REQUIRE(over != episode.labels.vias.end());
  CHECK(over->tool_speed > 0.03);  // it did not stop
  CHECK(replay_episode(episode) == "");
}

TEST_CASE("an arc about a part goes as its joint turns") {
  for (const std::uint64_t seed : {3, 4, 5}) {
    const EpisodeRecord episode = run_authored("tap_by_arc", "", seed);
    INFO(verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    CHECK(motions_of(episode, "follow") == 1);
  }
}

TEST_CASE("a wipe in a skill holds its force at a surface that is not where it was thought to be") {
  for (const double wrong : {-0.005, 0.005}) {
    RunOptions options;
    options.seed = 3;
    options.on_failure = OnFailure::stop;
    options.set["rub"].values = {{"wrong", 0, {wrong}}};
    EpisodeScripts scripts(authors(), "rub_the_patch", "", options.seed);
    const EpisodeRecord episode = run_episode(scripts.task(), scripts.symbols(), scripts.skills(), options);
    INFO(wrong << " " << verdict(episode));
    REQUIRE(episode.outcome == Outcome::success);
    const auto follow = std::find_if(
        episode.labels.segments.begin(), episode.labels.segments.end(),
        [](const auto& segment) { return segment.kind == SegmentKind::motion && segment.skill == "follow"; });
    REQUIRE(follow != episode.labels.segments.end());
    CHECK(follow->controller == "cartesian_impedance");
    const auto press = std::find_if(episode.labels.contacts.begin(), episode.labels.contacts.end(),
                                    [](const ContactRecord& contact) { return contact.peak_force > 5; });
    REQUIRE(press != episode.labels.contacts.end());
    REQUIRE(episode.labels.vias.size() >= 3);
    CHECK(replay_episode(episode) == "");
    const EpisodeRecord again = run_episode(scripts.task(), scripts.symbols(), scripts.skills(), options);
    CHECK(again.state_hash == episode.state_hash);
  }
}

TEST_CASE("what is taken off a rod, or hung on one, does not knock against it") {
  for (const char* task : {"move_hanger", "place_hanger_on_rack", "put_toilet_roll_on_stand", "hang_frame_on_hanger"}) {
    RunOptions options;
    options.seed = 930000;
    const EpisodeRecord episode = run_task(task, first_variation(task), options);
    INFO(task << ": " << verdict(episode));
    CHECK(episode.outcome == Outcome::success);
    for (const ContactRecord& contact : episode.labels.contacts) {
      INFO(contact.object_a << " and " << contact.object_b);
      if (contact.object_a != "panda" && contact.object_b != "panda") CHECK(contact.peak_force < 10);
    }
  }
}
