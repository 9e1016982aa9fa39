// Signed margins of all atoms: what is measured of which, when, and that nothing else of an episode changes by it.
#include "engine/start/margins.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "engine/rollout/rollout.h"
#include "engine/start/start.h"
#include "tests/support/plain_task.h"

using namespace stampede;

namespace {

// `on` says its margin in m; `holding` in the unit that is asked for, and only while it holds.
class Measuring : public plain::PlainSymbols {
 public:
  PredicateTraits traits(const std::string& predicate) const override {
    PredicateTraits traits = PlainSymbols::traits(predicate);
    if (predicate == "on") traits.margin_unit = "m";
    if (predicate == "holding") traits.margin_unit = unit_of_holding;
    return traits;
  }
  Value value(const Fact& fact, const WorldView& view) override {
    if (fact.predicate == "on") {
      const WorldView::Judged judged = view.supports(fact.arguments[1], fact.arguments[0]);
      return {judged.holds, judged.margin};
    }
    if (fact.predicate == "holding") {
      const bool holds = view.grasped(fact.arguments[1]).holds;
      return {holds, holds ? std::optional(0.01) : std::nullopt};
    }
    return PlainSymbols::value(fact, view);
  }
  std::string unit_of_holding;
};

EpisodeRecord measured(std::int64_t seed, std::optional<std::vector<std::string>> channels) {
  Measuring symbols;
  plain::PlainSkills skills;
  RunOptions options;
  options.seed = seed;
  options.observation.channels = std::move(channels);
  return run_episode(plain::stack_draw(), symbols, skills, options);
}

double reading_of(const ChannelRecord& channel, const std::string& atom, std::size_t frame) {
  const auto found = std::find(channel.components.begin(), channel.components.end(), atom);
  REQUIRE(found != channel.components.end());
  return channel.values.at(frame * channel.components.size() +
                           static_cast<std::size_t>(found - channel.components.begin()));
}

}  // namespace

TEST_CASE("margins of false atoms are how far they are from holding, those of true ones by how much they do") {
  Measuring symbols;
  World world(std::make_shared<const Scene>(table_scene(2)));  // cubes of 4 cm, 10 cm apart from middle to middle
  WorldView view(world);
  for (int i = 0; i < 12; ++i) world.step();
  world.close_window();
  view.close_frame();
  const FactTracker tracker(symbols, view);
  const Margins margins(symbols, tracker.atoms(), view);
  ChannelRecord channel = margins.channel(20);
  CHECK(channel.name == "margins");
  CHECK(channel.unit == "m");
  CHECK(channel.rate_hz == 20);
  REQUIRE(channel.components ==
          std::vector<std::string>{"(on cube1 cube2)", "(on cube1 table)", "(on cube2 cube1)", "(on cube2 table)"});
  channel.values = margins.read(view);
  CHECK(reading_of(channel, "(on cube1 table)", 0) == Approx(0.25).margin(1e-3));  // from the near edge
  // 8 cm from the other's side, and its foot 4 cm below the other's top.
  CHECK(reading_of(channel, "(on cube1 cube2)", 0) == Approx(-std::hypot(0.08, 0.04)).margin(1e-3));
  CHECK(margins.read(view, {{{"on", {"cube1", "cube2"}}, {false, -0.5}}}).at(0) == -0.5);  // what is known goes first
  CHECK_FALSE(std::signbit(margins.read(view, {{{"on", {"cube1", "cube2"}}, {false, -0.0}}}).at(0)));
}

TEST_CASE("each margin has its predicate's unit, and where a predicate gives none it is not known") {
  Measuring symbols;
  symbols.unit_of_holding = "rad";
  World world(std::make_shared<const Scene>(table_scene(1)));
  const WorldView view(world);
  const Margins margins(symbols, FactTracker(symbols, view).atoms(), view);
  const ChannelRecord channel = margins.channel(20);
  REQUIRE(channel.components == std::vector<std::string>{"(holding panda.hand cube1)", "(on cube1 table)"});
  CHECK(channel.unit == "rad, m");
  const std::vector<double> values = margins.read(view);
  CHECK(std::isnan(values.at(0)));
  CHECK(std::isfinite(values.at(1)));
  plain::PlainSymbols silent;
  CHECK(Margins(silent, FactTracker(silent, view).atoms(), view).empty());
}

TEST_CASE("margins are recorded for every frame where they are asked for by name, and change nothing else") {
  const EpisodeRecord with = measured(1, {{"margins"}}), without = measured(1, {{"*"}});
  REQUIRE(with.outcome == Outcome::success);
  CHECK(without.channels.empty());
  CHECK(with.state_hash == without.state_hash);
  REQUIRE(with.channels.size() == 1);
  const ChannelRecord& channel = with.channels[0];
  REQUIRE(channel.steps.size() == with.frames.size());
  for (std::size_t frame = 0; frame < with.frames.size(); ++frame)
    CHECK(channel.steps[frame] == with.frames[frame].step);
  CHECK(channel.components.size() == 9);  // of three cubes on each other or the table
  // Facts are debounced, so a change is told apart from its surroundings by two frames.
  const auto on = [&](const std::string& atom, std::int64_t frame) {
    return std::any_of(with.labels.facts.begin(), with.labels.facts.end(), [&](const FactRecord& fact) {
      return to_text(fact.fact) == atom && fact.first_frame <= frame && frame < fact.end_frame;
    });
  };
  std::int64_t compared = 0;
  for (const std::string& atom : channel.components)
    for (std::int64_t frame = 2; frame + 2 < static_cast<std::int64_t>(with.frames.size()); ++frame) {
      const bool holds = on(atom, frame);
      if (on(atom, frame - 2) != holds || on(atom, frame + 2) != holds) continue;
      CAPTURE(atom, frame);
      CHECK((reading_of(channel, atom, static_cast<std::size_t>(frame)) >= 0) == holds);
      ++compared;
    }
  CHECK(compared > 8 * static_cast<std::int64_t>(with.frames.size()));
  // What a fact's interval says is the greatest of its frames.
  for (const FactRecord& fact : with.labels.facts) {
    if (fact.fact.predicate != "on") continue;
    double most = 0;
    for (std::int64_t frame = fact.first_frame; frame < fact.end_frame; ++frame)
      most = std::max(most, reading_of(channel, to_text(fact.fact), static_cast<std::size_t>(frame)));
    CHECK(fact.margin == Approx(most).margin(1e-12));
  }
}

TEST_CASE("margins of what is undone are gone, and replay leaves the channel out") {
  Measuring symbols;
  RunOptions options;
  const PreparedStart start = prepare_start(plain::stack_draw(2), symbols, options);
  REQUIRE(start.reason == Reason::none);
  Observation observation;
  observation.channels = {"*", "margins"};
  Rollout rollout(symbols, start, SensorReader(*start.scene, observation, RandomKey("test")), nullptr);
  const auto readings = [&] { return rollout.sensors().channels().at(0).steps; };
  const auto two_frames = [&] {
    for (int i = 0; i < 24; ++i) rollout.advance();
  };
  CHECK(readings() == std::vector<std::int64_t>{0});
  two_frames();
  const Rollout::Checkpoint here = rollout.checkpoint();
  const ChannelRecord before = rollout.sensors().channels().at(0);
  two_frames();
  CHECK(readings().size() == 5);
  rollout.restore(here);
  CHECK(readings() == before.steps);
  CHECK(rollout.sensors().channels().at(0).values == before.values);
  two_frames();
  CHECK(readings() == std::vector<std::int64_t>{0, 12, 24, 36, 48});

  const EpisodeRecord episode = measured(2, {{"margins"}});
  CHECK(replay_episode(episode).empty());
  CHECK(not_replayed(episode) == std::vector<std::string>{"margins"});
}
